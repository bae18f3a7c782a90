#include "engine/plc/find_overlaps.h"

#include <algorithm>
#include <optional>

#include "engine/numbers/predicates.h"
#include "engine/plc/intersect_triangles.h"
#include "engine/plc/quanta.h"

namespace ccdt {

namespace {

using Between = Overlap::Between;

std::array<Point3, 3> points_of(std::span<const Point3> vertices, const Corners& c) {
  return {vertices[c[0]], vertices[c[1]], vertices[c[2]]};
}

bool has(const Corners& c, VertexId v) {
  return c[0] == v || c[1] == v || c[2] == v;
}

// The corners turned so that the given one is the first.
Corners from_corner(const Corners& c, VertexId v) {
  return c[0] == v ? c : c[1] == v ? Corners{c[1], c[2], c[0]} : Corners{c[2], c[0], c[1]};
}

// For triangles of one exactly flat facet the axis is one that its plane is not parallel to, and otherwise negative.
std::optional<Contact> meet(std::span<const Point3> vertices, const Corners& s, const Corners& t, int axis) {
  int common = 0;
  VertexId corner = s[0];
  for (const VertexId v : s)
    if (has(t, v)) {
      ++common;
      corner = v;
    }
  if (common >= 2) return std::nullopt;
  const std::array<Point3, 3> p = points_of(vertices, common == 1 ? from_corner(s, corner) : s);
  const std::array<Point3, 3> q = points_of(vertices, common == 1 ? from_corner(t, corner) : t);
  if (axis >= 0 && are_apart_in_plane(axis, p, q, common)) return std::nullopt;
  return common == 1 ? meet_triangles_at_corner(p, q) : meet_triangles(p, q);
}

bool are_coplanar(const std::array<Point3, 3>& s, const std::array<Point3, 3>& t) {
  return std::all_of(t.begin(), t.end(), [&](const Point3& p) { return orient3d(s[0], s[1], s[2], p) == 0; });
}

Box box_of_segment(const Point3& a, const Point3& b) {
  return hull(box_of(a), box_of(b));
}

std::optional<Contact> meet_loose(std::span<const Point3> vertices, const std::array<VertexId, 2>& ends,
                                  const Corners& t) {
  for (int k = 0; k < 2; ++k)
    if (has(t, ends[k]))
      return meet_segment_at_corner(vertices[ends[1 - k]], points_of(vertices, from_corner(t, ends[k])));
  return meet_segment_triangle(vertices[ends[0]], vertices[ends[1]], points_of(vertices, t));
}

bool share_end(const std::array<VertexId, 2>& a, const std::array<VertexId, 2>& b) {
  return a[0] == b[0] || a[0] == b[1] || a[1] == b[0] || a[1] == b[1];
}

}  // namespace

std::vector<Box> boxes_of(std::span<const Point3> vertices, const TriangleSet& triangles) {
  std::vector<Box> boxes;
  boxes.reserve(triangles.size());
  for (const auto& [a, b, c] : triangles.corners)
    boxes.push_back(hull(hull(box_of(vertices[a]), box_of(vertices[b])), box_of(vertices[c])));
  return boxes;
}

std::vector<Overlap> find_overlaps(std::span<const Point3> vertices, const TriangleSet& triangles,
                                   const FacetPatches& facets, const BoxTree& tree, std::size_t limit) {
  std::vector<int> axes(facets.count());
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    const auto [a, b, c] = triangles.corners[t];
    axes[facets.facet_of[t]] = dominant_axis(rounded_normal(vertices[a], vertices[b], vertices[c]));
  }
  std::vector<Overlap> found;
  tree.for_each_pair([&](std::uint32_t i, std::uint32_t j) {
    if (found.size() >= limit) return;
    const std::uint32_t facet = facets.facet_of[i];
    const bool one_facet = facet == facets.facet_of[j];
    if (one_facet && !facets.exactly_flat[facet]) return;
    const Corners &s = triangles.corners[i], &t = triangles.corners[j];
    if (const auto contact = meet(vertices, s, t, one_facet ? axes[facet] : -1)) {
      const bool covering = contact->coplanar && are_coplanar(points_of(vertices, s), points_of(vertices, t));
      found.push_back({covering ? Between::covering_facets : Between::facets, i, j, contact->where});
    }
  });
  return found;
}

std::vector<Overlap> find_segment_overlaps(std::span<const Point3> vertices, const TriangleSet& triangles,
                                           const SegmentSet& segments, std::span<const std::uint32_t> loose,
                                           const BoxTree& tree, std::size_t limit) {
  std::vector<Overlap> found;
  std::vector<Box> boxes;
  for (const std::uint32_t s : loose) {
    const auto& ends = segments.ends[s];
    boxes.push_back(box_of_segment(vertices[ends[0]], vertices[ends[1]]));
    tree.for_each_meeting(boxes.back(), [&](std::uint32_t t) {
      if (found.size() >= limit) return;
      if (const auto contact = meet_loose(vertices, ends, triangles.corners[t]))
        found.push_back({Between::facet_and_segment, t, s, contact->where});
    });
  }
  BoxTree(std::move(boxes)).for_each_pair([&](std::uint32_t i, std::uint32_t j) {
    const auto &a = segments.ends[loose[i]], &b = segments.ends[loose[j]];
    if (found.size() >= limit || share_end(a, b)) return;
    if (const auto contact = meet_segments(vertices[a[0]], vertices[a[1]], vertices[b[0]], vertices[b[1]]))
      found.push_back({Between::segments, loose[i], loose[j], contact->where});
  });
  return found;
}

}  // namespace ccdt
