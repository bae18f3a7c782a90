#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/base/box_tree.h"
#include "engine/surface/original_surface.h"

namespace ccdt::surface {

/// A point of the original surface.
struct Foot {
  std::uint32_t triangle = 0;
  std::array<double, 3> weights{};  ///< of the corners of the triangle; they sum to one
  Point3 point;                     ///< exactly in the triangle's plane where that is parallel to two axes
  double squared_distance = 0;
};

/// The point of a triangle that is nearest to another (Ericson, "Real-Time Collision Detection", 5.1.5).
Foot closest_on_triangle(const Point3& p, const std::array<Point3, 3>& triangle);

/// Finds the nearest point of a patch of the original surface: a hierarchy of boxes for each patch.
class ClosestPoint {
 public:
  explicit ClosestPoint(const OriginalSurface& surface);

  /// \param near  a triangle of the patch; the nearer it is, the faster
  Foot on_patch(std::uint32_t patch, const Point3& p, std::uint32_t near) const;

  /// Is the patch as near as that to a point? Faster than to find where.
  bool is_within(double distance, std::uint32_t patch, const Point3& p, std::uint32_t near) const;

  /// The normal of the surface at a foot, interpolated from those of the wedges; of length one.
  Point3 normal_at(const Foot& foot) const;

 private:
  // The children of an inner node are `first` and `first` + 1; a leaf has the `count` items from `first`.
  struct Node {
    Box box;
    std::uint32_t first = 0, count = 0;
  };
  Foot search(std::uint32_t patch, const Point3& p, std::uint32_t near, double squared_enough) const;
  void build(std::uint32_t node, std::uint32_t begin, std::uint32_t end);
  std::array<Point3, 3> corners(std::uint32_t triangle) const;
  Foot foot_on(std::uint32_t triangle, const Point3& p) const;

  const OriginalSurface& surface_;
  std::vector<std::uint32_t> items_;  // triangles
  std::vector<Node> nodes_;           // the root of patch p is node p
};

}  // namespace ccdt::surface
