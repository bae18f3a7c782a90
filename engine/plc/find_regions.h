#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/base/box_tree.h"
#include "engine/plc/edge_table.h"
#include "engine/plc/find_facets.h"
#include "engine/plc/input.h"
#include "engine/plc/plc.h"

namespace ccdt {

/// A point that rays start from: the mean of up to three vertices, held exactly as six times its quanta.
struct RayStart {
  std::array<std::int64_t, 3> sixfold;

  static RayStart at(const Point3& p);
  static RayStart middle_of(const Point3& a, const Point3& b);
  static RayStart centroid_of(const Point3& a, const Point3& b, const Point3& c);
};

/// A triangle that the ray passes, and the side that it meets first.
struct RayHit {
  std::uint32_t triangle;
  bool enters_above;  ///< the ray comes from the side that the triangle's normal points to
};

/// Shoots rays straight up (+z) through a set of triangles that do not cross each other, exactly. A ray is moved aside
/// by an infinitesimal step in x and an infinitely smaller one in y, so that it passes no edge, no vertex and no
/// upright triangle.
class VerticalRays {
 public:
  /// \param tree  over the boxes of the triangles; all three must outlive this
  VerticalRays(std::span<const Point3> vertices, const TriangleSet& triangles, const BoxTree& tree)
      : vertices_(vertices), triangles_(triangles), tree_(tree) {}

  /// All triangles above the point from the lowest to the highest, except `own`.
  std::vector<RayHit> shoot(const RayStart& start, std::optional<std::uint32_t> own = std::nullopt) const;

  /// Is the start of a ray, once moved aside (or, where the triangle is not upright, raised), above this triangle that
  /// holds it?
  bool leaves_above(std::uint32_t triangle) const;

  /// A triangle that the point is on.
  std::optional<std::uint32_t> triangle_at(const RayStart& start) const;

 private:
  std::span<const Point3> vertices_;
  const TriangleSet& triangles_;
  const BoxTree& tree_;
};

/// How the triangles divide space.
struct RegionMap {
  /// Of each side of each triangle: entry 2t is the side that the normal points to, 2t+1 the other.
  std::vector<RegionId> of_side;
  std::vector<Region> regions;   ///< number 0 reaches infinity; the others follow in the order of their first side
  std::vector<RegionId> around;  ///< of each region but 0, the one that holds the connected facets that enclose it

  RegionId of(std::uint32_t triangle, bool above) const { return of_side[2 * triangle + (above ? 0 : 1)]; }
};

/// Finds the regions: joins the sides of triangles that see each other through the sectors around each edge, then, as
/// facets that are connected by edges may be nested in others, through rays from one component to the next. No region
/// is marked inside yet.
///
/// \param edges  with the triangles sorted around each edge (`sort_around_edges`)
RegionMap find_regions(const TriangleSet& triangles, std::span<const Point3> vertices, const EdgeTable& edges,
                       const FacetPatches& facets, const VerticalRays& rays);

/// The region of a point that is on no triangle.
RegionId region_at(const RegionMap& map, const VerticalRays& rays, const RayStart& point);

/// Marks what is inside, as the input's kind says, and gives the regions the attributes of their seeds.
///
/// \throw InputError  a seed of a hole or region is outside or on a facet; or nothing is enclosed, or nothing is left
/// by the holes
void mark_inside(const InputPlc& input, const Plc& plc, const TriangleSet& triangles, const EdgeTable& edges,
                 const VerticalRays& rays, RegionMap& map);

}  // namespace ccdt
