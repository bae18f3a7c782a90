#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/enum_names.h"
#include "engine/base/flatness.h"
#include "engine/base/progress.h"
#include "engine/mesh/tet_mesh.h"
#include "engine/plc/input.h"
#include "engine/plc/periodicity.h"

namespace ccdt::verify {

struct VerifyOptions {
  /// The tolerance of flatness, as a fraction of the input's bounding box. Four times this counts as flat, because a
  /// mesher may measure against another plane and the next power of two. If exact coordinates do not match, a tenth of
  /// it counts as the same place. If facets do not match, smaller tolerances are tried as well.
  double flatness = usual_flatness;
  /// Must every unconstrained inner face be locally Delaunay? `claimed`: if the mesh claims it.
  enum class Delaunay { claimed, yes, no } delaunay = Delaunay::claimed;
  /// What may have happened to the input's vertices inside flat facets and straight chains of edges or segments?
  /// `keep`: they are vertices of the mesh. `slide`: they may have moved in their facet or chain, or be missing.
  enum class Boundary { keep, slide } boundary = Boundary::keep;
  /// Whose surface must the mesh have? `same`: the input's; its facets, segments and vertices are there. `own`: the
  /// mesher made another one, which must enclose the tetrahedra once; the input does not matter, unless `within` is
  /// given.
  enum class Surface { same, own } surface = Surface::same;
  /// How far the mesher's own surface may be from that of the input, in units of the input; see `check_within`.
  std::optional<double> within = {};
  /// Along which axes must opposite sides of the mesh be equal?
  plc::Periodicity periodic = plc::Periodicity::none;
  /// What must the mesh list? `all`: the faces on facets, and the edges on segments with markers. `tetrahedra`: these
  /// alone. Other elements that it lists must be right, and complete.
  enum class Lists { all, tetrahedra } lists = Lists::all;
};

constexpr auto names_of(VerifyOptions::Delaunay) {
  using enum VerifyOptions::Delaunay;
  return std::to_array<NamedValue<VerifyOptions::Delaunay>>(
      {{claimed, "claimed", "if the mesh claims it"}, {yes, "yes", "it must"}, {no, "no", "it need not"}});
}

constexpr auto names_of(VerifyOptions::Boundary) {
  using enum VerifyOptions::Boundary;
  return std::to_array<NamedValue<VerifyOptions::Boundary>>(
      {{keep, "keep", "where they were"},
       {slide, "slide", "as above, but those inside flat facets and straight segments may have slid along them"}});
}

constexpr auto names_of(VerifyOptions::Surface) {
  using enum VerifyOptions::Surface;
  return std::to_array<NamedValue<VerifyOptions::Surface>>(
      {{same, "same", "that of the input, with all its facets, segments and vertices"},
       {own, "own", "any surface that encloses the tetrahedra once, for meshers that make their own surface"}});
}

constexpr auto names_of(VerifyOptions::Lists) {
  using enum VerifyOptions::Lists;
  return std::to_array<NamedValue<VerifyOptions::Lists>>(
      {{all, "all", "the faces on facets and the edges on segments with markers, too"},
       {tetrahedra, "tetrahedra", "these alone; other elements, if there are any, must still be right and complete"}});
}

/// One property that was checked.
struct Check {
  std::string name;                        ///< e.g. "positive orientation"
  std::uint64_t checked = 0;               ///< number of checked items
  std::uint64_t failed = 0;                ///< number of wrong ones
  bool required = true;                    ///< does a failure make the mesh wrong?
  std::vector<std::string> examples = {};  ///< the first few failures, with coordinates
  std::string not_compared = {};           ///< why there was nothing to check, although the input asks for it
};

/// How far the facets of a mesh are from those of the input, in units of the input: upper bounds, at most 3% too large
/// or a thousandth of the limit.
struct Distances {
  double limit = 0;       ///< `VerifyOptions::within`
  double to_input = 0;    ///< no point of the mesh's facets is farther from the input's
  double from_input = 0;  ///< no point of the input's facets is farther from the mesh's
};

struct Verification {
  std::vector<Check> checks;
  double mesh_volume = 0, input_volume = 0;
  std::optional<Distances> distances = {};  ///< if they were limited, and the mesh encloses its tetrahedra once
  bool ok() const {
    for (const Check& c : checks)
      if (c.required && c.failed > 0) return false;
    return true;
  }
};

/// Checks a mesh exactly against its input, by CGAL's exact kernel. It shares no predicate with the engine and works on
/// any mesher's output.
///
/// \param input  its polygons must be planar; see `plc::triangulate_warped_facets`
/// \throw InputError  see `plc::check_extent`
Verification verify(const plc::InputPlc& input, const mesh::TetMesh& mesh, const VerifyOptions& options = {},
                    const Progress& progress = {});

}  // namespace ccdt::verify
