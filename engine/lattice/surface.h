#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/box.h"
#include "engine/lattice/place_lattice_points.h"

namespace ccdt {

using Corners = std::array<Point3, 3>;

/// The surface that the lattice must stay clear of: views of what the caller has.
struct Surface {
  std::span<const Point3> vertices;
  std::span<const SurfaceTriangle> triangles;
  std::span<const std::array<VertexId, 2>> subsegments;

  Corners corners(std::uint32_t triangle) const {
    const auto& v = triangles[triangle].vertices;
    return {vertices[v[0]], vertices[v[1]], vertices[v[2]]};
  }
};

/// Where boxes of one size may touch a triangle: separating axes, with a margin for rounding.
class TouchingPlaces {
 public:
  /// \param half  of the sides of the boxes
  /// \param reach no coordinate of a corner is farther than this from the centre of any box that is asked for
  TouchingPlaces(const Corners& triangle, const Point3& half, double reach);

  /// False only if the triangle and the box with this centre are certainly apart though their bounding boxes overlap.
  bool hold(const Point3& centre) const {
    const Point3 from_corner = centre - corner_;
    for (const Slab& slab : slabs_) {
      const double along = dot(slab.axis, from_corner);
      if (along < slab.low || along > slab.high) return false;
    }
    return true;
  }

 private:
  struct Slab {
    Point3 axis;  // of any length
    double low, high;
  };
  Point3 corner_;
  std::array<Slab, 10> slabs_;
};

/// A point within the part of the triangle that lies in the box, up to rounding; false if there is no such part.
bool common_point(const Box& box, const Corners& triangle, Point3& point);

/// The squared distance of p and the triangle, which may be degenerate.
double squared_distance(const Corners& triangle, const Point3& p);
double squared_distance(const Point3& a, const Point3& b, const Point3& p);

}  // namespace ccdt
