#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/point.h"
#include "engine/delaunay/delaunay.h"
#include "engine/facets/facet_mesh.h"
#include "engine/folds/find_contacts.h"
#include "engine/plc/plc.h"

namespace ccdt::folds {

/// Divides nearly flat facets of a PLC into exactly flat ones, with segments between them. Each facet is divided
/// further step by step:
///
/// 1. Some of its Delaunay triangles become separate facets. A needle stays with the triangle across its longest edge,
///    since the segments around it could not be protected.
/// 2. Needles become facets, too.
/// 3. All triangles that the input has there become facets. These do not meet others of the input, but they may be
///    needles.
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
  /// \param origins   of those facets
  /// \param delaunay  of all their vertices
  /// \throw MeshError  a facet has the triangles of the input already, which is a bug
  void divide(const facets::FacetMesh& faces, std::span<const std::uint32_t> which,
              const std::vector<FacetOrigin>& origins, const delaunay::Delaunay& delaunay);

  /// Gives facets the triangles of the input where these faces are.
  void follow_input(const facets::FacetMesh& faces, std::span<const std::uint32_t> which,
                    const std::vector<FacetOrigin>& origins);

  /// Gives all nearly flat facets the triangles of the input.
  void follow_input();

  /// Gives up the divisions in the way of a segment that cannot be protected. The facets with its ends get the
  /// triangles of the input; if there are none, all divided facets do.
  ///
  /// \return  false if they already have them
  bool give_way(const std::array<VertexId, 2>& segment);

  /// Notes that these segments must be protected from now on.
  ///
  /// \param plc  `divided()`, which has them
  void make_grazeable(const plc::Plc& plc, std::span<const std::uint32_t> segments);

 private:
  using Triangle = std::array<VertexId, 3>;
  enum class Step : std::uint8_t { whole, most_triangles, needles, input };

  bool is_nearly_flat(std::uint32_t f) const { return !plc_.facets[f].exactly_flat; }
  std::array<Point3, 3> corners_of(const Triangle& t) const;
  std::span<const Triangle> triangles_of(std::uint32_t f) const;
  std::uint32_t leader(std::uint32_t i) const;
  bool touches_segment(std::uint32_t f) const;
  bool separate(std::uint32_t f, const std::array<Point3, 3>& face);
  std::uint32_t group_of(std::uint32_t f, std::uint32_t i) const;
  std::vector<std::vector<Triangle>> parts_of(std::uint32_t f) const;
  void add_segments(std::uint32_t f, plc::Plc& result) const;

  const plc::Plc& plc_;
  double least_height_;  // of triangles that are not needles
  facets::FacetMesh mesh_;
  std::vector<std::uint32_t> first_;       // of the triangles of `mesh_`, by facet
  std::vector<std::uint32_t> across_;      // of 3 * triangle + edge: a triangle of the same nearly flat facet, if any
  std::vector<std::uint8_t> is_separate_;  // by triangle
  std::vector<Step> step_;                 // by facet
  std::vector<std::uint64_t> grazeable_;   // segments, by their ends
};

}  // namespace ccdt::folds
