#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/base/box_tree.h"
#include "engine/base/point.h"
#include "engine/plc/triangle_set.h"

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

}  // namespace ccdt
