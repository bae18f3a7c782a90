#include "engine/plc/gather_parts.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "engine/base/errors.h"
#include "engine/plc/find_overlaps.h"
#include "engine/plc/integer_points.h"

namespace ccdt::plc {
namespace {

void check_coordinates(const InputPlc& input) {
  for (std::size_t i = 0; i < input.vertices.size(); ++i) {
    const auto [x, y, z] = input.vertices[i];
    if (std::isfinite(x) && std::isfinite(y) && std::isfinite(z)) continue;
    throw InputError("vertex " + std::to_string(i) + " (counted from 0) has a coordinate that is not a finite number",
                     {.file = input.name},
                     "export the model again, or correct or remove this vertex and the facets that use it");
  }
}

double largest_difference(const Point3& a, const Point3& b) {
  return std::max({std::fabs(a.x - b.x), std::fabs(a.y - b.y), std::fabs(a.z - b.z)});
}

// One vertex after the other splits the triangle that holds it into three, or two if it is on an edge.
class TriangleSplitter {
 public:
  TriangleSplitter(std::span<const Point3> vertices, const VertexTriple& t)
      : vertices_(vertices), axis_(dominant_axis(points_of(vertices, t))), sense_(orient(t[0], t[1], t[2])) {}

  void split(const VertexTriple& t, const std::vector<VertexId>& inner, std::vector<VertexTriple>& parts) const {
    if (inner.empty()) {
      parts.push_back(t);
      return;
    }
    const std::size_t middle = inner.size() / 2;  // vertices in a row have their ids in a row: so the list is halved
    const VertexId v = inner[middle];
    for (int k = 0; k < 3; ++k) {
      const VertexTriple part = {t[k], t[(k + 1) % 3], v};
      if (orient(part[0], part[1], part[2]) == 0) continue;
      std::vector<VertexId> left;
      for (std::size_t i = 0; i < inner.size(); ++i)
        if (i != middle && holds(part, inner[i])) left.push_back(inner[i]);
      split(part, left, parts);
    }
  }

 private:
  int orient(VertexId a, VertexId b, VertexId c) const {
    return orient_along(axis_, vertices_[a], vertices_[b], vertices_[c]);
  }
  bool holds(const VertexTriple& t, VertexId v) const {
    for (int k = 0; k < 3; ++k)
      if (orient(t[k], t[(k + 1) % 3], v) == -sense_) return false;
    return true;
  }

  std::span<const Point3> vertices_;
  int axis_;
  int sense_;
};

}  // namespace

void snap_vertices(const InputPlc& input, Plc& plc) {
  check_coordinates(input);
  plc.grid = numbers::make_grid(input.vertices);
  const auto count = static_cast<std::uint32_t>(input.vertices.size());
  std::vector<Point3> snapped(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    snapped[i] = plc.grid.snap(input.vertices[i]);
    plc.largest_rounding =
        std::max(plc.largest_rounding, largest_difference(plc.grid.to_world(snapped[i]), input.vertices[i]));
  }

  // Equal points become neighbors in sorted order; the first of them in the input stands for all.
  std::vector<std::uint32_t> order(count);
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t j) {
    const Point3 &a = snapped[i], &b = snapped[j];
    if (a.x != b.x) return a.x < b.x;
    if (a.y != b.y) return a.y < b.y;
    if (a.z != b.z) return a.z < b.z;
    return i < j;
  });
  std::vector<std::uint32_t> first_equal(count);
  for (std::uint32_t k = 0; k < count; ++k) {
    const bool same = k > 0 && snapped[order[k]] == snapped[order[k - 1]];
    first_equal[order[k]] = same ? first_equal[order[k - 1]] : order[k];
  }

  plc.vertex_of_input.resize(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    if (first_equal[i] != i) {
      plc.vertex_of_input[i] = plc.vertex_of_input[first_equal[i]];
      continue;
    }
    plc.vertex_of_input[i] = VertexId(plc.vertices.size());
    plc.vertices.push_back(snapped[i]);
    plc.world.push_back(input.vertices[i]);
  }
}

double tolerance_of(const Plc& plc, double flatness) {
  const Box box = bounding_box(plc.vertices);
  const Point3 size = box.high - box.low;
  return flatness * std::max({size.x, size.y, size.z});
}

TriangleSet gather_triangles(const InputPlc& input, const Plc& plc) {
  TriangleSet triangles;
  for (std::uint32_t t = 0; t < input.triangles.size(); ++t) {
    const auto [a, b, c] = input.triangles[t];
    triangles.add({plc.vertex_of_input[a], plc.vertex_of_input[b], plc.vertex_of_input[c]},
                  input.triangle_markers.empty() ? 0 : input.triangle_markers[t],
                  input.triangle_numbers.empty() ? t : input.triangle_numbers[t]);
  }
  return triangles;
}

SegmentSet gather_segments(const InputPlc& input, const Plc& plc) {
  SegmentSet segments;
  for (std::uint32_t s = 0; s < input.segments.size(); ++s)
    segments.add(plc.vertex_of_input[input.segments[s][0]], plc.vertex_of_input[input.segments[s][1]],
                 input.segment_markers.empty() ? 0 : input.segment_markers[s]);
  return segments;
}

bool split_triangles_at_vertices(std::span<const Point3> vertices, const BoxTree& tree, TriangleSet& triangles) {
  std::vector<char> axes(triangles.size());
  for (std::uint32_t t = 0; t < triangles.size(); ++t)
    axes[t] = static_cast<char>(dominant_axis(points_of(vertices, triangles.corners[t])));
  std::vector<std::pair<std::uint32_t, VertexId>> found;  // triangle and a vertex on it
  for (std::uint32_t i = 0; i < vertices.size(); ++i) {
    const VertexId v(i);
    tree.for_each_meeting(box_of(vertices[v]), [&](std::uint32_t t) {
      const VertexTriple& c = triangles.corners[t];
      if (!has_corner(c, v) && is_on_triangle(axes[t], vertices[v], points_of(vertices, c))) found.emplace_back(t, v);
    });
  }
  if (found.empty()) return false;
  std::sort(found.begin(), found.end());

  TriangleSet result;
  std::vector<VertexId> inner;
  std::vector<VertexTriple> parts;
  auto next = found.begin();
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    inner.clear();
    parts.clear();
    for (; next != found.end() && next->first == t; ++next) inner.push_back(next->second);
    TriangleSplitter(vertices, triangles.corners[t]).split(triangles.corners[t], inner, parts);
    for (const VertexTriple& part : parts) result.add(part, triangles.markers[t], triangles.numbers[t]);
  }
  triangles = std::move(result);
  return true;
}

void split_segments_at_vertices(std::span<const Point3> vertices, SegmentSet& segments) {
  if (segments.ends.empty()) return;
  std::vector<Box> boxes;
  for (const auto& [a, b] : segments.ends) boxes.push_back(hull(box_of(vertices[a]), box_of(vertices[b])));
  const BoxTree tree(std::move(boxes));
  std::vector<std::pair<std::uint32_t, VertexId>> found;  // segment and a vertex on it
  for (std::uint32_t i = 0; i < vertices.size(); ++i)
    tree.for_each_meeting(box_of(vertices[i]), [&](std::uint32_t s) {
      const auto& [a, b] = segments.ends[s];
      if (a != b && is_within_segment(vertices[i], vertices[a], vertices[b])) found.emplace_back(s, VertexId(i));
    });
  std::sort(found.begin(), found.end());

  SegmentSet result;
  std::set<std::pair<VertexId, VertexId>> known;
  const auto add = [&](VertexId a, VertexId b, int marker) {
    if (a != b && known.insert(std::minmax(a, b)).second) result.add(a, b, marker);
  };
  std::vector<VertexId> chain;
  auto next = found.begin();
  for (std::uint32_t s = 0; s < segments.size(); ++s) {
    const auto [a, b] = segments.ends[s];
    chain.assign(1, a);
    for (; next != found.end() && next->first == s; ++next) chain.push_back(next->second);
    const Point3 along = vertices[b] - vertices[a];
    const int axis = dominant_axis(along);
    const double sense = as_array(along)[axis] < 0 ? -1 : 1;
    std::sort(chain.begin() + 1, chain.end(), [&](VertexId u, VertexId v) {
      return sense * as_array(vertices[u])[axis] < sense * as_array(vertices[v])[axis];
    });
    chain.push_back(b);
    for (std::size_t k = 0; k + 1 < chain.size(); ++k) add(chain[k], chain[k + 1], segments.markers[s]);
  }
  segments = std::move(result);
}

}  // namespace ccdt::plc
