#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/base/enum_names.h"
#include "engine/base/progress.h"
#include "engine/mesh/tet_mesh.h"
#include "engine/plc/input.h"

namespace ccdt::verify {

struct VerifyOptions {
  /// What counts as flat, as a fraction of the input's bounding box: four times this, because a mesher may measure
  /// against another plane and the next power of two. A tenth of it counts as the same place: where exact coordinates
  /// do not match. Where facets do not match, smaller ones are
  /// tried as well.
  double flatness = 1e-8;
  /// Must every unconstrained inner face be locally Delaunay? `claimed`: if the mesh says so of itself.
  enum class Delaunay { claimed, yes, no } delaunay = Delaunay::claimed;
  /// What may have become of the input's vertices inside flat facets and inside straight chains of edges or segments?
  /// `keep`: they are vertices of the mesh. `slide`: they may be elsewhere in their facet or chain, or nowhere.
  enum class Boundary { keep, slide } boundary = Boundary::keep;
  /// Whose surface must the mesh have? `same`: the input's; its facets, segments and vertices are there. `own`: its
  /// mesher made another one; that has to enclose the tetrahedra once, and the input does not matter.
  enum class Surface { same, own } surface = Surface::same;
};

constexpr auto names_of(VerifyOptions::Delaunay) {
  using enum VerifyOptions::Delaunay;
  return std::to_array<NamedValue<VerifyOptions::Delaunay>>(
      {{claimed, "claimed", "if the mesh says so"}, {yes, "yes", "it must"}, {no, "no", "it need not"}});
}

constexpr auto names_of(VerifyOptions::Boundary) {
  using enum VerifyOptions::Boundary;
  return std::to_array<NamedValue<VerifyOptions::Boundary>>(
      {{keep, "keep", "where they were"},
       {slide, "slide", "the same, but those inside flat facets and straight segments may have slid in these"}});
}

constexpr auto names_of(VerifyOptions::Surface) {
  using enum VerifyOptions::Surface;
  return std::to_array<NamedValue<VerifyOptions::Surface>>(
      {{same, "same", "that of the input, with all its facets, segments and vertices"},
       {own, "own", "any that encloses the tetrahedra once, as of meshers that make a surface of their own"}});
}

/// One property that was checked.
struct Check {
  std::string name;                        ///< e.g. "positive orientation"
  std::uint64_t checked = 0;               ///< how many things were looked at
  std::uint64_t failed = 0;                ///< how many of them are wrong
  bool required = true;                    ///< does a failure make the mesh wrong?
  std::vector<std::string> examples = {};  ///< the first few failures, with coordinates
};

struct Verification {
  std::vector<Check> checks;
  double mesh_volume = 0, input_volume = 0;
  bool ok() const {
    for (const Check& c : checks)
      if (c.required && c.failed > 0) return false;
    return true;
  }
};

/// An exact check of a mesh against its input, by CGAL's exact kernel; shares no predicate with the engine. Works on
/// any mesher's output.
///
/// \param input  its polygons are taken for planar; `plc::triangulate_bent_facets` sees to that
Verification verify(const plc::InputPlc& input, const mesh::TetMesh& mesh, const VerifyOptions& options = {},
                    const Progress& progress = {});

/// A verification as lines for a terminal: one a check with its name and how many things were checked and failed, below
/// it the first failures; then the volumes and the verdict.
std::vector<std::string> describe(const Verification& verification);

}  // namespace ccdt::verify
