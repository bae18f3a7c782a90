#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/point.h"
#include "engine/geometry/box_tree.h"

namespace ccdt {

/// The corners of a triangle; one without area stands for a segment or a point.
using TrianglePoints = std::array<Point3, 3>;

/// Finds the nearest of some triangles. Lengths are between 2^-60 and 2^60, so that their squares are numbers.
class NearestTriangle {
 public:
  explicit NearestTriangle(std::vector<TrianglePoints> triangles);

  struct Found {
    std::uint32_t number = 0;
    double squared_distance = 0;
  };

  /// The triangle nearest to a point. \pre there are triangles
  ///
  /// \param near  a triangle; the nearer it is, the faster the search
  Found nearest(const Point3& p, std::uint32_t near = 0) const;

  /// A triangle that is nearer than those across its sides, found by steps from one to the next.
  Found walk(const Point3& p, std::uint32_t near) const;

  /// No point of t is farther from the triangles than the square root of this.
  ///
  /// The distance from a convex set is a convex function. So no point of a triangle is farther from a given triangle
  /// than one of its corners is.
  double squared_bound(const TrianglePoints& t) const;

  /// The triangle across the side from corner k to the next; the triangle itself if there is none.
  std::uint32_t across(std::uint32_t number, std::size_t k) const { return neighbors_[number][k]; }

  const TrianglePoints& operator[](std::uint32_t number) const { return triangles_[number]; }
  bool empty() const { return triangles_.empty(); }

 private:
  std::vector<TrianglePoints> triangles_;
  std::vector<std::array<std::uint32_t, 3>> neighbors_;
  BoxTree tree_;
};

/// How far a surface is from another: the point of it that is farthest away.
struct FarthestPoint {
  double bound = 0;    ///< no point of the surface is farther
  double reached = 0;  ///< `at` is this far
  Point3 at;
};

struct DistancePrecision {
  double relative = 1.03;  ///< the bound is at most so many times the distance that is reached
  double absolute = 0;     ///< or this length
};

/// Bounds the distance of the points of one surface from another. This is one side of the Hausdorff distance.
///
/// A triangle is cut until each part is as near to one triangle of the other surface as the precision wants. Where the
/// two surfaces lie on each other, it is cut along the borders of those triangles; elsewhere it is halved. The bound
/// includes the rounding of the corners of parts.
///
/// \param to  not empty
FarthestPoint farthest_point(std::span<const TrianglePoints> from, const NearestTriangle& to,
                             const DistancePrecision& precision);

/// Points of a surface that are farther than a limit from another, or nearly so: at least 0.97 times the limit. One for
/// each triangle that has such points.
///
/// \param to  not empty
std::vector<Point3> points_beyond(std::span<const TrianglePoints> from, const NearestTriangle& to, double limit);

}  // namespace ccdt
