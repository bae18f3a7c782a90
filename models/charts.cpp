#include "models/charts.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace ccdt {

Chart plane_chart(const Point3& origin, const Point3& normal) {
  const Point3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  const Point3 u = normal.z == 0 ? z : normal.y == 0 ? y : x;
  if (dot(u, normal) != 0) throw std::logic_error("a plane of a model must be parallel to an axis");
  const Point3 v = cross(normal, u);
  return {[=](const Point3& p) {
            return Point2{dot(p - origin, u), dot(p - origin, v)};
          },
          [=](const Point2& q) { return origin + q.x * u + q.y * v; }};
}

Chart cylinder_chart(Axis axis, const Point3& centre, double radius, double middle, Facing facing) {
  const double side = facing == Facing::outward ? 1 : -1;
  const Point3 origin = to_local(axis, centre);
  const double cos_middle = cosine(middle), sin_middle = sine(middle);
  const auto flatten = [=](const Point3& model) {
    const Point3 p = to_local(axis, model) - origin;
    const double along = cos_middle * p.x + sin_middle * p.y;
    const double across = cos_middle * p.y - sin_middle * p.x;
    return Point2{side * radius * std::atan2(across, along), p.z};
  };
  const auto lift = [=](const Point2& q) {
    const double angle = middle * std::numbers::pi / 180 + side * q.x / radius;
    return to_model(axis, origin + Point3{radius * std::cos(angle), radius * std::sin(angle), q.y});
  };
  return {flatten, lift};
}

}  // namespace ccdt
