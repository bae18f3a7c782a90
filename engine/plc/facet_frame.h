#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "engine/base/index.h"
#include "engine/base/point.h"
#include "engine/geometry/grid.h"
#include "engine/geometry/integer_points.h"
#include "engine/plc/plc.h"

namespace ccdt::plc {

/// How a facet lies in space, for exact predicates in its plane.
///
/// In an exactly flat facet they are those of space with an apex above the plane. A nearly flat facet is *flattened*:
/// its vertices are projected along the axis nearest to its normal, stretched to their true distances, and rounded to
/// the grid. So they are exactly in one plane.
class FacetFrame {
 public:
  /// An apex above the plane of flattened vertices.
  static constexpr Point3 apex_of_flattened = {0, 0, 0x1p50};

  /// \param triangles  of the facet
  /// \param points     of all vertices
  FacetFrame(std::span<const std::array<VertexId, 3>> triangles, std::span<const Point3> points)
      : normal_(normalized(sum_of_normals(triangles, points))), axis_(dominant_axis(normal_)) {
    const Point3 n = turned(normal_);
    const double rise_s = -n.x / n.z, rise_t = -n.y / n.z;
    first_ = std::sqrt(1 + rise_s * rise_s);
    shear_ = rise_s * rise_t / first_;
    second_ = std::copysign(std::sqrt(1 + rise_t * rise_t - shear_ * shear_), n.z);
  }

  /// A point above the same facet, about as far away as the facet is large.
  Point3 apex(std::span<const std::array<VertexId, 3>> triangles, std::span<const Point3> points) const {
    Point3 apex = points[triangles[0][0]];
    double squared_extent = 1;
    for (const auto& t : triangles) squared_extent = std::max(squared_extent, squared_length(points[t[1]] - apex));
    int exponent = 0;
    std::frexp(std::sqrt(squared_extent), &exponent);
    const double up = std::ldexp(1.0, std::min(exponent, 50));  // differences of coordinates stay exact
    (axis_ == 0   ? apex.x
     : axis_ == 1 ? apex.y
                  : apex.z) += std::copysign(up, as_array(normal_)[static_cast<std::size_t>(axis_)]);
    return apex;
  }

  /// Maps the other two coordinates linearly, so that distances equal those in the plane. Orientations stay the same.
  Point3 flattened(const Point3& p) const {
    const Point3 s = turned(p);
    return {round_to_unit(0.25 * (first_ * s.x + shear_ * s.y)), round_to_unit(0.25 * second_ * s.y), 0};
  }

 private:
  /// Puts the axis last, and the other two in the order that keeps the orientation.
  Point3 turned(const Point3& p) const {
    if (axis_ == 0) return {p.y, p.z, p.x};
    if (axis_ == 1) return {p.z, p.x, p.y};
    return p;
  }

  Point3 normal_;
  int axis_;                       // the one nearest to the normal
  double first_, shear_, second_;  // how the other two coordinates are stretched
};

}  // namespace ccdt::plc
