#include "engine/plc/split_at_vertices.h"

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

#include "engine/plc/intersect_triangles.h"
#include "engine/plc/quanta.h"

namespace ccdt {

namespace {

// An axis that the plane of the triangle is not parallel to.
int axis_of(std::span<const Point3> vertices, const Corners& t) {
  return dominant_axis(rounded_normal(vertices[t[0]], vertices[t[1]], vertices[t[2]]));
}

// One vertex after the other splits the triangle that holds it into three, or two if it is on an edge.
class TriangleSplitter {
 public:
  TriangleSplitter(std::span<const Point3> vertices, const Corners& t)
      : vertices_(vertices), axis_(axis_of(vertices, t)), sense_(orient(t[0], t[1], t[2])) {}

  void split(const Corners& t, const std::vector<VertexId>& inner, std::vector<Corners>& parts) const {
    if (inner.empty()) {
      parts.push_back(t);
      return;
    }
    const std::size_t middle = inner.size() / 2;  // vertices in a row have their ids in a row: halves, not crumbs
    const VertexId v = inner[middle];
    for (int k = 0; k < 3; ++k) {
      const Corners part = {t[k], t[(k + 1) % 3], v};
      if (orient(part[0], part[1], part[2]) == 0) continue;
      std::vector<VertexId> left;
      for (std::size_t i = 0; i < inner.size(); ++i)
        if (i != middle && holds(part, inner[i])) left.push_back(inner[i]);
      split(part, left, parts);
    }
  }

 private:
  int orient(VertexId a, VertexId b, VertexId c) const {
    return orient_along(axis_, to_quanta(vertices_[a]), to_quanta(vertices_[b]), to_quanta(vertices_[c]));
  }
  bool holds(const Corners& t, VertexId v) const {
    for (int k = 0; k < 3; ++k)
      if (orient(t[k], t[(k + 1) % 3], v) == -sense_) return false;
    return true;
  }

  std::span<const Point3> vertices_;
  int axis_;
  int sense_;
};

bool has(const Corners& c, VertexId v) {
  return c[0] == v || c[1] == v || c[2] == v;
}

}  // namespace

bool split_triangles_at_vertices(std::span<const Point3> vertices, const BoxTree& tree, TriangleSet& triangles) {
  std::vector<char> axes(triangles.size());
  for (std::uint32_t t = 0; t < triangles.size(); ++t)
    axes[t] = static_cast<char>(axis_of(vertices, triangles.corners[t]));
  std::vector<std::pair<std::uint32_t, VertexId>> found;  // triangle and a vertex on it
  for (std::uint32_t i = 0; i < vertices.size(); ++i) {
    const VertexId v(i);
    tree.for_each_meeting(box_of(vertices[v]), [&](std::uint32_t t) {
      const Corners& c = triangles.corners[t];
      if (!has(c, v) && is_on_triangle(axes[t], vertices[v], {vertices[c[0]], vertices[c[1]], vertices[c[2]]}))
        found.emplace_back(t, v);
    });
  }
  if (found.empty()) return false;
  std::sort(found.begin(), found.end());

  TriangleSet result;
  std::vector<VertexId> inner;
  std::vector<Corners> parts;
  auto next = found.begin();
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    inner.clear();
    parts.clear();
    for (; next != found.end() && next->first == t; ++next) inner.push_back(next->second);
    TriangleSplitter(vertices, triangles.corners[t]).split(triangles.corners[t], inner, parts);
    for (const Corners& part : parts) result.add(part, triangles.markers[t], triangles.numbers[t]);
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

}  // namespace ccdt
