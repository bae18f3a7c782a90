#pragma once

#include <functional>

#include "engine/planar/points.h"
#include "models/curves.h"

namespace ccdt {

/// A developable patch laid out in the plane without distortion. Counterclockwise in the plane is counterclockwise seen
/// from outside.
struct Chart {
  std::function<Point2(const Point3&)> flatten;
  std::function<Point3(const Point2&)> lift;  ///< the inverse, onto the true surface
};

enum class Facing { outward, inward };  ///< where the outer side of a cylinder is: away from its axis, or towards it

/// The plane through `origin` with that unit normal towards the outer side. Where the normal is along an axis, the
/// points of the plane have exactly the origin's coordinate there.
Chart plane_chart(const Point3& origin, const Point3& normal);

/// The cylinder unrolled. The patch must lie within 180 degrees on both sides of the angle `middle`.
Chart cylinder_chart(Axis axis, const Point3& centre, double radius, double middle, Facing facing);

}  // namespace ccdt
