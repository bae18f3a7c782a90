#include "engine/plc/find_overlaps.h"

#include <algorithm>

#include "engine/base/parallel.h"
#include "engine/geometry/contacts.h"

namespace ccdt::plc {
namespace {

// The corners turned so that the given one is the first.
VertexTriple from_corner(const VertexTriple& c, VertexId v) {
  return c[0] == v ? c : c[1] == v ? VertexTriple{c[1], c[2], c[0]} : VertexTriple{c[2], c[0], c[1]};
}

std::optional<Contact> meet(std::span<const Point3> vertices, VertexTriple s, VertexTriple t) {
  const int common = put_common_first(s, t);
  if (common >= 2) return std::nullopt;
  return meet_elsewhere(points_of(vertices, s), points_of(vertices, t), common);
}

std::optional<Contact> meet_loose(std::span<const Point3> vertices, const std::array<VertexId, 2>& ends,
                                  const VertexTriple& t) {
  for (int k = 0; k < 2; ++k)
    if (has_corner(t, ends[k]))
      return meet_segment_at_corner(vertices[ends[1 - k]], points_of(vertices, from_corner(t, ends[k])));
  return meet_segment_triangle(vertices[ends[0]], vertices[ends[1]], points_of(vertices, t));
}

bool share_end(const std::array<VertexId, 2>& a, const std::array<VertexId, 2>& b) {
  return a[0] == b[0] || a[0] == b[1] || a[1] == b[0] || a[1] == b[1];
}

}  // namespace

std::vector<Overlap> find_overlaps(std::span<const Point3> vertices, const TriangleSet& triangles,
                                   const FacetPatches& facets, std::span<const TrianglePair> close, std::size_t limit) {
  const auto find_overlap = [&](const TrianglePair& pair, std::vector<Overlap>& found) {
    const auto [i, j] = pair;
    const std::uint32_t facet = facets.facet_of[i];
    if (facet == facets.facet_of[j] && !facets.exactly_flat[facet]) return;
    const VertexTriple &s = triangles.corners[i], &t = triangles.corners[j];
    if (const auto contact = meet(vertices, s, t)) {
      const bool covering = contact->coplanar && sides_of(points_of(vertices, s), points_of(vertices, t)) == Sides{};
      found.push_back({covering ? Overlap::Between::covering_facets : Overlap::Between::facets, i, j, contact->where});
    }
  };
  std::vector<Overlap> all = parallel_collect<Overlap>(
      close.size(), 1024, [&](std::size_t begin, std::size_t end, std::vector<Overlap>& found) {
        for (; begin < end && found.size() < limit; ++begin) find_overlap(close[begin], found);
      });
  if (all.size() > limit) all.erase(all.begin() + static_cast<std::ptrdiff_t>(limit), all.end());
  return all;
}

std::vector<Overlap> find_segment_overlaps(std::span<const Point3> vertices, const TriangleSet& triangles,
                                           const SegmentSet& segments, std::span<const std::uint32_t> loose,
                                           const BoxTree& tree, std::size_t limit) {
  std::vector<Overlap> found;
  const auto box = [&](std::uint32_t s) {
    return hull(box_of(vertices[segments.ends[s][0]]), box_of(vertices[segments.ends[s][1]]));
  };
  for (const std::uint32_t s : loose)
    tree.for_each_meeting(box(s), [&](std::uint32_t t) {
      if (found.size() >= limit) return;
      if (const auto contact = meet_loose(vertices, segments.ends[s], triangles.corners[t]))
        found.push_back({Overlap::Between::facet_and_segment, t, s, contact->where});
    });
  BoxTree(loose, box).for_each_pair([&](std::uint32_t i, std::uint32_t j) {
    const auto &a = segments.ends[loose[i]], &b = segments.ends[loose[j]];
    if (found.size() >= limit || share_end(a, b)) return;
    if (const auto contact = meet_segments(vertices[a[0]], vertices[a[1]], vertices[b[0]], vertices[b[1]]))
      found.push_back({Overlap::Between::segments, loose[i], loose[j], contact->where});
  });
  return found;
}

}  // namespace ccdt::plc
