#include "engine/surface/surface_change.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/base/box.h"
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
