#include "engine/surface/closest_point.h"

#include <algorithm>
#include <numeric>

#include "engine/plc/integer_points.h"

namespace ccdt::surface {
namespace {

constexpr std::uint32_t leaf_size = 4;

// a + v ab + w ac; where a coordinate is the same for all three, it stays so.
Foot make_foot(const Point3& p, const std::array<Point3, 3>& t, double v, double w) {
  Foot foot;
  foot.weights = {1 - v - w, v, w};
  foot.point = t[0] + (v * (t[1] - t[0]) + w * (t[2] - t[0]));
  foot.squared_distance = squared_length(p - foot.point);
  return foot;
}

}  // namespace

Foot closest_on_triangle(const Point3& p, const std::array<Point3, 3>& t) {
  const Point3 ab = t[1] - t[0], ac = t[2] - t[0], ap = p - t[0], bp = p - t[1], cp = p - t[2];
  const double d1 = dot(ab, ap), d2 = dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return make_foot(p, t, 0, 0);
  const double d3 = dot(ab, bp), d4 = dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return make_foot(p, t, 1, 0);
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return make_foot(p, t, d1 / (d1 - d3), 0);
  const double d5 = dot(ab, cp), d6 = dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return make_foot(p, t, 0, 1);
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return make_foot(p, t, 0, d2 / (d2 - d6));
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 >= d3 && d5 >= d6) {
    const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return make_foot(p, t, 1 - w, w);
  }
  const double sum = va + vb + vc;
  return make_foot(p, t, vb / sum, vc / sum);
}

ClosestPoint::ClosestPoint(const OriginalSurface& surface) : surface_(surface), items_(surface.triangles.size()) {
  std::iota(items_.begin(), items_.end(), 0u);
  std::stable_sort(items_.begin(), items_.end(),
                   [&](std::uint32_t s, std::uint32_t t) { return surface.patch_of[s] < surface.patch_of[t]; });
  nodes_.resize(surface.patch_markers.size());
  for (std::uint32_t begin = 0, end = 0; begin < items_.size(); begin = end) {
    const std::uint32_t patch = surface.patch_of[items_[begin]];
    while (end < items_.size() && surface.patch_of[items_[end]] == patch) ++end;
    build(patch, begin, end);
  }
}

void ClosestPoint::build(std::uint32_t node, std::uint32_t begin, std::uint32_t end) {
  Box box = empty_box;
  for (std::uint32_t i = begin; i < end; ++i) box = hull(box, bounding_box(corners(items_[i])));
  nodes_[node] = {box, begin, end - begin};
  if (end - begin <= leaf_size) return;
  const int axis = plc::dominant_axis(box.high - box.low);
  const auto key = [&](std::uint32_t t) {
    const std::array<Point3, 3> c = corners(t);
    return as_array(c[0])[axis] + as_array(c[1])[axis] + as_array(c[2])[axis];
  };
  const std::uint32_t middle = begin + (end - begin) / 2;
  std::nth_element(items_.begin() + begin, items_.begin() + middle, items_.begin() + end,
                   [&](std::uint32_t s, std::uint32_t t) {
                     const double a = key(s), b = key(t);
                     return a != b ? a < b : s < t;
                   });
  const auto child = static_cast<std::uint32_t>(nodes_.size());
  nodes_[node].first = child;
  nodes_[node].count = 0;
  nodes_.resize(nodes_.size() + 2);
  build(child, begin, middle);
  build(child + 1, middle, end);
}

std::array<Point3, 3> ClosestPoint::corners(std::uint32_t triangle) const {
  const auto& [a, b, c] = surface_.triangles[triangle];
  return {surface_.points[a], surface_.points[b], surface_.points[c]};
}

Foot ClosestPoint::foot_on(std::uint32_t triangle, const Point3& p) const {
  Foot foot = closest_on_triangle(p, corners(triangle));
  foot.triangle = triangle;
  return foot;
}

// The nearest point, or the first that is found within a distance that is enough.
Foot ClosestPoint::search(std::uint32_t patch, const Point3& p, std::uint32_t near, double squared_enough) const {
  Foot best = foot_on(near, p);
  std::array<std::uint32_t, 64> stack;  // deeper than any tree of 2^32 items, as each node is halved
  std::size_t size = 0;
  stack[size++] = patch;
  while (size > 0 && best.squared_distance > squared_enough) {
    const Node& node = nodes_[stack[--size]];
    if (squared_distance(node.box, p) >= best.squared_distance) continue;
    if (node.count == 0) {
      const bool first_is_nearer =
          squared_distance(nodes_[node.first].box, p) < squared_distance(nodes_[node.first + 1].box, p);
      stack[size++] = first_is_nearer ? node.first + 1 : node.first;
      stack[size++] = first_is_nearer ? node.first : node.first + 1;
      continue;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      const Foot foot = foot_on(items_[i], p);
      if (foot.squared_distance < best.squared_distance) best = foot;
    }
  }
  return best;
}

Foot ClosestPoint::on_patch(std::uint32_t patch, const Point3& p, std::uint32_t near) const {
  return search(patch, p, near, 0);
}

bool ClosestPoint::is_within(double distance, std::uint32_t patch, const Point3& p, std::uint32_t near) const {
  const double enough = distance * distance;
  return search(patch, p, near, enough).squared_distance <= enough;
}

Point3 ClosestPoint::normal_at(const Foot& foot) const {
  Point3 normal;
  for (int k = 0; k < 3; ++k)
    normal = normal + foot.weights[k] * surface_.wedge_normals[surface_.wedges[foot.triangle][k]];
  const double l = length(normal);
  return l > 1e-3 ? (1 / l) * normal : surface_.triangle_normals[foot.triangle];
}

}  // namespace ccdt::surface
