#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/hash_table.h"
#include "engine/base/point.h"
#include "engine/delaunay/delaunay.h"
#include "engine/facets/facet_mesh.h"
#include "engine/folds/find_contacts.h"
#include "engine/plc/plc.h"

namespace ccdt::folds {

/// Divides bent facets of a PLC into flat ones, with segments between them. Each facet is divided further step by step:
///
/// 1. Some of its Delaunay triangles become facets of their own. A needle stays with the triangle at its longest edge:
///    nothing could protect the segments around it.
/// 2. Needles become facets, too.
/// 3. All triangles that the input has there become facets. These do not meet others of the input, but they may be
///    needles.
/// 4. Where not even these can be protected, the facet is *given up*: it stays whole, and its folds unprotected.
class FacetDivider {
 public:
  /// \param plc        must outlive this
  /// \param delaunay   of its vertices
  /// \param tolerance  of flatness, in grid units
  FacetDivider(const plc::Plc& plc, const delaunay::Delaunay& delaunay, double tolerance);

  /// The PLC with all divisions so far.
  plc::Plc divided() const;
  /// Of the facets of `divided()`.
  std::vector<FacetOrigin> origins() const;

  /// Divides facets further where these faces are.
  ///
  /// \param faces     of the facets of `divided()`
  /// \param origins   of those
  /// \param delaunay  of all their vertices
  /// \return  false if all of them are given up
  bool divide(const facets::FacetMesh& faces, std::span<const std::uint32_t> which,
              const std::vector<FacetOrigin>& origins, const delaunay::Delaunay& delaunay);

  /// Gives facets the triangles of the input where these faces are.
  ///
  /// \return           false if there are none
  /// \throw MeshError  one of them is given up
  bool follow_input(const facets::FacetMesh& faces, std::span<const std::uint32_t> which,
                    const std::vector<FacetOrigin>& origins);

  /// These segments must be protected from now on.
  ///
  /// \param plc  `divided()`, which has them
  /// \return  false if all of them are given up
  bool make_grazeable(const plc::Plc& plc, std::span<const std::uint32_t> segments);

  /// Gives up what is in the way of a segment that cannot be protected: its own protection, if the input does not ask
  /// for it; or the facets with its ends, or if there are none all divided facets, go on to the triangles of the input
  /// or, if they have them, are given up.
  ///
  /// \return  false if nothing is left to give up
  bool give_way(const std::array<VertexId, 2>& segment);

 private:
  using Triangle = std::array<VertexId, 3>;
  enum class Step : std::uint8_t { whole, most_triangles, needles, input, given_up };

  bool is_bent(std::uint32_t facet) const { return !plc_.facets[facet].exactly_flat; }
  bool is_whole(std::uint32_t facet) const { return step_[facet] == Step::whole || step_[facet] == Step::given_up; }
  std::array<Point3, 3> corners_of(const Triangle& t) const;
  std::span<const Triangle> triangles_of(std::uint32_t facet) const;
  std::uint32_t leader(std::uint32_t triangle) const;
  bool touches_segment(std::uint32_t facet) const;
  bool separate(std::uint32_t facet, const std::array<Point3, 3>& face);
  std::uint32_t group_of(std::uint32_t facet, std::uint32_t triangle) const;
  std::vector<std::vector<Triangle>> parts_of(std::uint32_t facet) const;
  void add_segments(std::uint32_t facet, plc::Plc& result) const;

  const plc::Plc& plc_;
  double least_height_;  // of triangles that are not needles
  facets::FacetMesh mesh_;
  std::vector<std::uint32_t> first_;          // of the triangles of `mesh_`, by facet
  std::vector<std::uint32_t> across_;         // of 3 * triangle + edge: a triangle of the same bent facet, if any
  std::vector<std::uint8_t> is_separate_;     // by triangle
  std::vector<Step> step_;                    // by facet
  HashTable<std::uint64_t, bool> grazeable_;  // segments, by their ends; false: given up
};

}  // namespace ccdt::folds
