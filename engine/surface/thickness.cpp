#include "engine/surface/thickness.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace ccdt::surface {
namespace {

constexpr double thickness_ratio = 2;  // of edges to the distance through a solid

// The same through a gap between bent sheets: their edges are chords and must not cross.
constexpr double gap_ratio = 4;

// As fractions of the usual length: the shortest edges because of thickness, and the thickness below which nothing is
// requested, because no reasonable number of edges would fit.
constexpr double least_length = 0.15, least_thickness = 0.01;

// A wedge that opens faster than edges may grow (`length_growth`) is not a thin place: the sine of that slope's angle
// is 0.287.
constexpr double least_cosine = 0.958;

// Nearer hits, as a fraction of the reach, are the sheet itself.
constexpr double least_distance = 1e-6;

std::array<Point3, 3> corners_of(const OriginalSurface& surface, std::uint32_t t) {
  const auto& [a, b, c] = surface.triangles[t];
  return {surface.points[a], surface.points[b], surface.points[c]};
}

RawVector<Box> boxes_of(const OriginalSurface& surface) {
  RawVector<Box> boxes;
  for (std::uint32_t t = 0; t < surface.triangles.size(); ++t) boxes.push_back(bounding_box(corners_of(surface, t)));
  return boxes;
}

// Where a line meets a triangle, in units of `along` (Moeller and Trumbore 1997); infinite if it passes by.
double hit(const Point3& from, const Point3& along, const std::array<Point3, 3>& t) {
  constexpr double slack = 1e-9;  // lines through a common edge of two triangles hit both
  const Point3 ab = t[1] - t[0], ac = t[2] - t[0], p = cross(along, ac);
  const double determinant = dot(ab, p);
  if (determinant == 0) return HUGE_VAL;
  const Point3 to = from - t[0], q = cross(to, ab);
  const double v = dot(to, p) / determinant, w = dot(along, q) / determinant;
  return v >= -slack && w >= -slack && v + w <= 1 + slack ? dot(ac, q) / determinant : HUGE_VAL;
}

}  // namespace

Thickness::Thickness(const OriginalSurface& surface, double usual)
    : surface_(surface), usual_(usual), tree_(boxes_of(surface)), of_small_triangles_(surface.triangles.size(), -1) {}

double Thickness::least_wanted() const {
  return least_length * usual_;
}

double Thickness::wanted_at(const Foot& foot, double most) const {
  constexpr double small = 0.5;  // edges, as a part of the usual length
  const std::array<Point3, 3> corners = corners_of(surface_, foot.triangle);
  for (int k = 0; k < 3; ++k)
    if (squared_length(corners[(k + 1) % 3] - corners[k]) > small * usual_ * small * usual_) return measure(foot, most);
  double& known = of_small_triangles_[foot.triangle];
  if (known < 0) {
    Foot center = foot;
    center.point = (1.0 / 3) * (corners[0] + corners[1] + corners[2]);
    known = measure(center, usual_);
  }
  return known;
}

double Thickness::measure(const Foot& foot, double most) const {
  const Point3& normal = surface_.triangle_normals[foot.triangle];
  const std::uint32_t patch = surface_.patch_of[foot.triangle];
  double wanted = most;
  for (const int side : {0, 1}) {
    const bool is_solid = surface_.patch_bounds_inside[patch][side];
    if (!is_solid && surface_.patch_is_flat[patch]) continue;
    const double ratio = is_solid ? thickness_ratio : gap_ratio;
    const double d = distance(foot, (side == 0 ? 1.0 : -1.0) * normal, wanted / ratio);
    if (d > least_thickness * usual_) wanted = std::min(wanted, ratio * d);
  }
  return std::max(wanted, least_wanted());
}

// The distance to the first sheet in a direction; infinite if there is none within reach, or if that one is slanted.
double Thickness::distance(const Foot& foot, const Point3& direction, double reach) const {
  double nearest = HUGE_VAL;
  bool is_slanted = false;
  tree_.for_each_meeting(LineSegment{foot.point, reach * direction}, [&](std::uint32_t t) {
    const double at = hit(foot.point, reach * direction, corners_of(surface_, t));
    if (t == foot.triangle || !(at > least_distance) || at > 1 || at >= nearest) return;
    nearest = at;
    is_slanted = std::fabs(dot(surface_.triangle_normals[t], direction)) < least_cosine;
  });
  return is_slanted ? HUGE_VAL : nearest * reach;
}

}  // namespace ccdt::surface
