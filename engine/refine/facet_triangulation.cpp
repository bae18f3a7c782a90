#include "engine/refine/facet_triangulation.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "engine/geometry/predicates.h"

namespace ccdt::refine {
namespace {

using planar::Side;

std::array<Point3, 3> corners_of(const std::array<VertexId, 3>& t, const std::vector<Point3>& points) {
  return {points[t[0]], points[t[1]], points[t[2]]};
}

/// The least barycentric coordinate of a point in a triangle, seen along its normal.
double least_weight(const std::array<Point3, 3>& t, const Point3& p) {
  const Point3 normal = area_vector(t);
  double least = HUGE_VAL;
  for (int i = 0; i < 3; ++i) least = std::min(least, dot(cross(t[(i + 1) % 3] - t[i], p - t[i]), normal));
  return least / squared_length(normal);
}

/// The point base + i u + j v near p: i and j are rounded to integers.
/// \return  none if the plane has so few integer points that i or j is too large
std::optional<Point3> nearest_in_plane(const plc::PlaneSteps& steps, const Point3& p) {
  const auto& [base, u, v] = steps;
  const Point3 offset = p - base;
  const double uu = squared_length(u), uv = dot(u, v), vv = squared_length(v), pu = dot(offset, u), pv = dot(offset, v);
  const double determinant = uu * vv - uv * uv;
  const double i = std::nearbyint((pu * vv - pv * uv) / determinant);
  const double j = std::nearbyint((pv * uu - pu * uv) / determinant);
  const auto fits = [](double count) { return std::fabs(count) < 0x1p60; };
  if (!fits(i) || !fits(j)) return std::nullopt;
  // Exact, in integers: the products may have more bits than a double, and more than 64 before they cancel.
  const auto combine = [&](double o, double s, double t) {
    return o + static_cast<double>(static_cast<Int128>(i) * static_cast<Int128>(s) +
                                   static_cast<Int128>(j) * static_cast<Int128>(t));
  };
  return Point3{combine(base.x, u.x, v.x), combine(base.y, u.y, v.y), combine(base.z, u.z, v.z)};
}

}  // namespace

FacetPlane::FacetPlane(std::span<const std::array<VertexId, 3>> triangles, bool exactly_flat,
                       const std::vector<Point3>& points)
    : points_(points),
      exactly_flat_(exactly_flat),
      frame_(triangles, points),
      apex_(exactly_flat ? frame_.apex(triangles, points) : plc::FacetFrame::apex_of_flattened) {}

int FacetPlane::orient(VertexId a, VertexId b, VertexId c) const {
  return orient3d(at(a), at(b), at(c), apex_);
}

int FacetPlane::incircle(VertexId a, VertexId b, VertexId c, VertexId d) const {
  return incircle_perturbed(at(a), at(b), at(c), apex_, at(d), {a, b, c, d});
}

FacetTriangulation::FacetTriangulation(std::span<const std::array<VertexId, 3>> triangles, bool exactly_flat,
                                       const std::vector<planar::Edge>& segments, const std::vector<Point3>& points)
    : plane_(triangles, exactly_flat, points), t_(planar::from_triangles(triangles, segments)) {
  planar::legalize(t_, plane_);
  if (exactly_flat) {
    if (const auto steps = plc::steps_of_facet(triangles, points)) patches_.push_back({{}, *steps});
    return;
  }
  for (const auto& t : triangles) {
    const auto corners = corners_of(t, points);
    patches_.push_back({corners, plc::steps_in_plane(corners[0], corners[1], corners[2])});
  }
}

std::optional<Point3> FacetTriangulation::snap(const Point3& p, double farthest) const {
  if (patches_.empty()) return std::nullopt;
  const Patch* patch = patches_.data();
  if (patches_.size() > 1) {
    double greatest = -HUGE_VAL;
    for (const Patch& other : patches_) {
      const double weight = least_weight(other.corners, p);
      if (weight <= greatest) continue;
      greatest = weight;
      patch = &other;
    }
  }
  const std::optional<Point3> snapped = nearest_in_plane(patch->steps, p);
  if (!snapped || !(squared_length(*snapped - p) <= farthest * farthest)) return std::nullopt;
  return snapped;
}

WalkEnd FacetTriangulation::walk(std::uint32_t from, VertexId to) const {
  constexpr int most_steps = 1000;
  std::uint32_t triangle = from;
  for (int steps = 0; steps < most_steps; ++steps) {
    const std::array<int, 3> signs = planar::signs_at_edges(t_, triangle, to, plane_);
    if (planar::is_within(signs)) return {triangle, {}};
    // Each step begins with a different edge, so that the walk cannot go in circles for long. A wall in the way ends
    // it.
    std::optional<Side> exit;
    for (int i = 0; i < 3; ++i) {
      const Side side{triangle, static_cast<std::uint32_t>(i + steps) % 3};
      if (signs[side.corner] >= 0) continue;
      const bool is_wall = planar::is_constrained(t_, side) || planar::neighbor(t_, side) == none;
      if (is_wall) return {triangle, side};
      if (!exit) exit = side;
    }
    triangle = planar::neighbor(t_, *exit);
  }
  return {};
}

bool FacetTriangulation::insert(VertexId v, std::uint32_t triangle) {
  const std::array<int, 3> signs = planar::signs_at_edges(t_, triangle, v, plane_);
  const auto zeros = std::ranges::count(signs, 0);
  if (zeros > 1) return false;
  if (zeros == 1) {
    const Side side{triangle, static_cast<std::uint32_t>(std::ranges::find(signs, 0) - signs.begin())};
    if (planar::is_constrained(t_, side) || planar::neighbor(t_, side) == none) return false;
    planar::split_side(t_, side, v, plane_);
    return true;
  }
  const auto [a, b, c] = t_.triangles[triangle];
  const planar::Adjacency bc = planar::adjacency_at(t_, {triangle, 0}), ca = planar::adjacency_at(t_, {triangle, 1}),
                          ab = planar::adjacency_at(t_, {triangle, 2});
  const std::uint32_t second = planar::append_triangle(t_, b, c, v), third = planar::append_triangle(t_, c, a, v);
  planar::set_corners(t_, triangle, a, b, v);
  planar::attach(t_, {triangle, 2}, ab);
  planar::attach(t_, {second, 2}, bc);
  planar::attach(t_, {third, 2}, ca);
  planar::join(t_, {triangle, 0}, {second, 1}, false);
  planar::join(t_, {second, 0}, {third, 1}, false);
  planar::join(t_, {third, 0}, {triangle, 1}, false);
  std::vector<std::uint32_t> stack = {planar::pack({triangle, 2}), planar::pack({second, 2}), planar::pack({third, 2})};
  planar::legalize_from(t_, stack, plane_);
  return true;
}

}  // namespace ccdt::refine
