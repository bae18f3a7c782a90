#include "engine/surface/surface_change.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/base/box.h"
#include "engine/base/hash_table.h"
#include "engine/geometry/closest_point.h"
#include "engine/geometry/surface_distance.h"
#include "engine/plc/facet_triangles.h"
#include "engine/plc/warped_facets.h"

namespace ccdt::surface {
namespace {

std::vector<TrianglePoints> scaled_triangles(const plc::InputPlc& input, double scale) {
  const auto flat = plc::triangulate_warped_facets(input);
  std::vector<TrianglePoints> triangles = plc::facet_triangles(flat ? *flat : input).corners;
  for (TrianglePoints& t : triangles)
    for (Point3& p : t) p = scale * p;
  return triangles;
}

double sum_of_areas(const std::vector<TrianglePoints>& triangles) {
  double sum = 0;
  for (const TrianglePoints& t : triangles) sum += 0.5 * length(area_vector(t));
  return sum;
}

/// The volume that a closed surface encloses; nothing if it is open, or if its triangles do not all face outward or all
/// inward. Then the edges, as arrows, do not cancel in pairs, and neither do their hashes.
std::optional<double> enclosed_volume(const std::vector<TrianglePoints>& triangles) {
  const auto hash_of = [](const Point3& p) {
    const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x + 0.0); };  // there are two zeros
    return HashTraits<std::array<std::uint64_t, 3>>::hash({bits(p.x), bits(p.y), bits(p.z)});
  };
  std::uint64_t arrows = 0;
  double sum = 0;
  for (const TrianglePoints& t : triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::array<std::size_t, 2> ends = {hash_of(t[i]), hash_of(t[(i + 1) % 3])};
      const auto arrow = [&](std::size_t from) {
        return HashTraits<std::array<std::uint64_t, 2>>::hash({ends[from], ends[1 - from]});
      };
      arrows += arrow(0) - arrow(1);
    }
    const Point3& origin = triangles[0][0];
    sum += dot(t[0] - origin, area_vector({origin, t[1], t[2]})) / 6;
  }
  return arrows == 0 ? std::optional(std::fabs(sum)) : std::nullopt;
}

/// A power of two changes no digit, and squares of lengths neither overflow nor vanish.
int exponent_of(const plc::InputPlc& input) {
  const double extent = largest_extent(input.vertices);
  return extent > 0 ? std::ilogb(extent) : 0;
}

}  // namespace

SurfaceChange measure_change(const plc::InputPlc& before, const plc::InputPlc& after, double deviation) {
  const int exponent = exponent_of(before);
  const double scale = std::ldexp(1, -exponent);
  const std::vector<TrianglePoints> old_ones = scaled_triangles(before, scale),
                                    new_ones = scaled_triangles(after, scale);
  SurfaceChange change;
  if (old_ones.empty() || new_ones.empty()) return change;
  DistancePrecision precision{.absolute = 1e-6};
  if (deviation > 0) precision.absolute = std::min(precision.absolute, 0.5 * scale * deviation);
  const FarthestPoint to = farthest_point(new_ones, NearestTriangle(old_ones), precision);
  const FarthestPoint from = farthest_point(old_ones, NearestTriangle(new_ones), precision);
  change.to_input = std::ldexp(to.bound, exponent);
  change.from_input = std::ldexp(from.bound, exponent);
  change.distance = std::max(change.to_input, change.from_input);
  change.farthest = as_array((1 / scale) * (to.bound > from.bound ? to : from).at);
  const std::optional<double> volume_before = enclosed_volume(old_ones), volume_after = enclosed_volume(new_ones);
  if (volume_before && volume_after) change.volume_change = std::ldexp(*volume_after - *volume_before, 3 * exponent);
  change.area_change = std::ldexp(sum_of_areas(new_ones) - sum_of_areas(old_ones), 2 * exponent);
  return change;
}

std::vector<Point3> points_beyond(const plc::InputPlc& before, const plc::InputPlc& after, double distance) {
  const double scale = std::ldexp(1, -exponent_of(before));
  const std::vector<TrianglePoints> old_ones = scaled_triangles(before, scale),
                                    new_ones = scaled_triangles(after, scale);
  if (old_ones.empty() || new_ones.empty()) return {};
  std::vector<Point3> points = ccdt::points_beyond(new_ones, NearestTriangle(old_ones), scale * distance);
  const NearestTriangle nearest(new_ones);
  for (const Point3& p : ccdt::points_beyond(old_ones, nearest, scale * distance)) {
    const TrianglePoints& t = nearest[nearest.nearest(p).number];
    points.push_back(weighted_point(closest_on_triangle(p, t), t));
  }
  for (Point3& p : points) p = (1 / scale) * p;
  return points;
}

}  // namespace ccdt::surface
