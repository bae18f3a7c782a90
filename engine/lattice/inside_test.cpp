#include "engine/lattice/inside_test.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/base/count_work.h"
#include "engine/geometry/predicates.h"

namespace ccdt::lattice {

namespace {

using Vector = std::array<double, 3>;

/// A triangle has at most nine corners after six cuts.
struct Polygon {
  std::array<Vector, 9> corners;
  std::size_t count = 0;

  void add(const Vector& v) { corners[count++] = v; }
};

/// The part of a convex polygon where sign * (coordinate - bound) >= 0.
Polygon clip(const Polygon& polygon, int axis, double bound, double sign) {
  Polygon part;
  for (std::size_t i = 0; i < polygon.count; ++i) {
    const Vector& a = polygon.corners[i];
    const Vector& b = polygon.corners[i + 1 < polygon.count ? i + 1 : 0];
    const double inside_a = sign * (a[axis] - bound), inside_b = sign * (b[axis] - bound);
    if (inside_a >= 0) part.add(a);
    if ((inside_a > 0 && inside_b < 0) || (inside_a < 0 && inside_b > 0)) {
      const double t = inside_a / (inside_a - inside_b);
      Vector crossing;
      for (int k = 0; k < 3; ++k) crossing[k] = a[k] + t * (b[k] - a[k]);
      crossing[axis] = bound;
      part.add(crossing);
    }
  }
  return part;
}

/// The part of a ray that is in the box: all triangles that it hits are known.
struct Ray {
  Point3 start, end;
};

/// Where a ray hits a triangle, as a fraction of the ray, and the error bound of this number.
struct Hit {
  double fraction = 0, error = 0;
  bool inside = false;  ///< the flag of the side that faces the start
};

enum class RayMeetsTriangle { none, hit, start_on_triangle, unclear };

double clamp_round(double x, double low, double high) {
  return std::clamp(std::round(x), low, high);
}

/// The ray to twice the target's distance, or to the border of the box.
Ray ray_through(const Point3& start, const Point3& target, const Box& box) {
  const Point3 d = target - start;
  double t = 2;
  const auto limit = [&t](double from, double step, double low, double high) {
    if (step > 0) t = std::min(t, (high - from) / step);
    if (step < 0) t = std::min(t, (low - from) / step);
  };
  limit(start.x, d.x, box.low.x, box.high.x);
  limit(start.y, d.y, box.low.y, box.high.y);
  limit(start.z, d.z, box.low.z, box.high.z);
  const Point3 end = start + t * d;
  return {start,
          {clamp_round(end.x, box.low.x, box.high.x), clamp_round(end.y, box.low.y, box.high.y),
           clamp_round(end.z, box.low.z, box.high.z)}};
}

bool boxes_apart(const Box& ray, const TrianglePoints& t) {
  const auto apart = [](double low, double high, double a, double b, double c) {
    return (a < low && b < low && c < low) || (a > high && b > high && c > high);
  };
  return apart(ray.low.x, ray.high.x, t[0].x, t[1].x, t[2].x) || apart(ray.low.y, ray.high.y, t[0].y, t[1].y, t[2].y) ||
         apart(ray.low.z, ray.high.z, t[0].z, t[1].z, t[2].z);
}

/// Six times the volume of a, b, c, p in doubles and a bound of its error.
struct RoundedVolume {
  double value, error;
};

RoundedVolume rounded_volume(const TrianglePoints& t, const Point3& p) {
  const Point3 u = t[1] - t[0], v = t[2] - t[0], w = p - t[0];
  const Point3 size{std::abs(w.x) * (std::abs(u.y * v.z) + std::abs(u.z * v.y)),
                    std::abs(w.y) * (std::abs(u.z * v.x) + std::abs(u.x * v.z)),
                    std::abs(w.z) * (std::abs(u.x * v.y) + std::abs(u.y * v.x))};
  return {dot(cross(u, v), w), 1e-15 * (size.x + size.y + size.z)};
}

Hit locate_hit(const Ray& ray, const TrianglePoints& corners, const SurfaceTriangle& triangle, int start_side) {
  const RoundedVolume at_start = rounded_volume(corners, ray.start), at_end = rounded_volume(corners, ray.end);
  const double span = std::abs(at_start.value - at_end.value), error = at_start.error + at_end.error;
  Hit hit;
  hit.inside = start_side > 0 ? triangle.inside_above : triangle.inside_below;
  hit.fraction = span > 0 ? std::abs(at_start.value) / span : 0;
  hit.error = span > 2 * error ? 4 * error / span : 1;
  return hit;
}

RayMeetsTriangle meet(const Ray& ray, const TrianglePoints& corners, const SurfaceTriangle& triangle, Hit& hit) {
  const auto& [a, b, c] = corners;
  const int start_side = orient3d(a, b, c, ray.start), end_side = orient3d(a, b, c, ray.end);
  if (start_side == 0 && end_side == 0) return RayMeetsTriangle::unclear;
  if (start_side == end_side) return RayMeetsTriangle::none;
  const int turns[] = {orient3d(ray.start, ray.end, a, b), orient3d(ray.start, ray.end, b, c),
                       orient3d(ray.start, ray.end, c, a)};
  const auto [least, most] = std::minmax({turns[0], turns[1], turns[2]});
  if (least < 0 && most > 0) return RayMeetsTriangle::none;
  if (start_side == 0) return RayMeetsTriangle::start_on_triangle;
  if (least * most == 0) return RayMeetsTriangle::unclear;
  hit = locate_hit(ray, corners, triangle, start_side);
  return RayMeetsTriangle::hit;
}

/// The answer of one ray; nothing if it is unclear or hits nothing.
std::optional<bool> cast(const Ray& ray, const DomainSurface& surface, std::span<const std::uint32_t> nearby,
                         std::vector<Hit>& hits) {
  const Box around = bounding_box(std::array{ray.start, ray.end});
  hits.clear();
  ++work_done.rays_cast;
  for (std::uint32_t t : nearby) {
    ++work_done.ray_triangles;
    const TrianglePoints corners = surface.corners(t);
    if (boxes_apart(around, corners)) continue;
    Hit hit;
    switch (meet(ray, corners, surface.triangles[t], hit)) {
      case RayMeetsTriangle::none:
        break;
      case RayMeetsTriangle::start_on_triangle:
        return false;
      case RayMeetsTriangle::unclear:
        return std::nullopt;
      case RayMeetsTriangle::hit:
        hits.push_back(hit);
        break;
    }
  }
  if (hits.empty()) return std::nullopt;
  const Hit first = *std::ranges::min_element(hits, {}, &Hit::fraction);
  for (const Hit& hit : hits) {
    if (hit.inside != first.inside && hit.fraction - hit.error <= first.fraction + first.error) return std::nullopt;
  }
  return first.inside;
}

}  // namespace

bool common_point(const Box& box, const TrianglePoints& triangle, Point3& point) {
  Polygon polygon;
  for (const Point3& p : triangle) polygon.add(as_array(p));
  const Vector low = as_array(box.low), high = as_array(box.high);
  for (int axis = 0; axis < 3; ++axis) {
    polygon = clip(polygon, axis, low[axis], 1);
    polygon = clip(polygon, axis, high[axis], -1);
  }
  if (polygon.count == 0) return false;
  Point3 sum;
  for (std::size_t i = 0; i < polygon.count; ++i)
    sum = sum + Point3{polygon.corners[i][0], polygon.corners[i][1], polygon.corners[i][2]};
  point = (1.0 / static_cast<double>(polygon.count)) * sum;
  return true;
}

std::optional<bool> is_inside_by_rays(const Point3& p, const Box& box, const DomainSurface& surface,
                                      std::span<const std::uint32_t> nearby) {
  // Further rounds aim slightly off each target.
  constexpr double aside[] = {0, 0.11, 0.23};
  constexpr std::size_t most_targets = 40;
  std::vector<Hit> hits;
  const std::size_t targets = std::min(nearby.size(), most_targets);
  for (double shift : aside) {
    for (std::size_t i = 0; i < targets; ++i) {
      const TrianglePoints corners = surface.corners(nearby[i * nearby.size() / targets]);
      Point3 target;
      if (!common_point(box, corners, target)) continue;
      if (shift > 0 && !common_point(box, {corners[0], corners[1], target + shift * (corners[2] - target)}, target))
        continue;
      const Ray ray = ray_through(p, target, box);
      if (ray.end == p) continue;
      if (const auto answer = cast(ray, surface, nearby, hits)) return answer;
    }
  }
  return std::nullopt;
}

}  // namespace ccdt::lattice
