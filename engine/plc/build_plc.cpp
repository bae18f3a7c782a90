#include "engine/plc/build_plc.h"

#include <algorithm>

#include "engine/base/box_tree.h"
#include "engine/base/errors.h"
#include "engine/plc/edge_table.h"
#include "engine/plc/find_facets.h"
#include "engine/plc/find_overlaps.h"
#include "engine/plc/find_regions.h"
#include "engine/plc/find_segments.h"
#include "engine/plc/refusals.h"
#include "engine/plc/snap_vertices.h"
#include "engine/plc/sort_around_edges.h"
#include "engine/plc/split_at_vertices.h"
#include "engine/plc/triangulate_polygons.h"
#include "engine/plc/vertical_ray.h"

namespace ccdt {

namespace {

constexpr std::size_t most_overlaps_told = 1000;

double box_size(std::span<const Point3> vertices) {
  Box box = box_of(vertices.front());
  for (const Point3& p : vertices) box = hull(box, box_of(p));
  const Point3 size = box.high - box.low;
  return std::max({size.x, size.y, size.z});
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

void refuse_no_facets(const InputPlc& input) {
  if (input.facet_count() > 0 && !input.vertices.empty()) return;
  Place place;
  place.file = input.name;
  throw InputError("there are no facets", place, "give a surface, or a .poly or .smesh with facets");
}

// Edges that the input names segments, and the segments that are no edge.
struct SegmentMatch {
  std::vector<std::uint32_t> segment_of;  // of each edge
  std::vector<char> is_segment;           // of each edge
  std::vector<std::uint32_t> loose;
};

SegmentMatch match_segments(const SegmentSet& segments, const EdgeTable& edges) {
  SegmentMatch match;
  match.segment_of.assign(edges.size(), EdgeTable::none);
  match.is_segment.assign(edges.size(), 0);
  for (std::uint32_t s = 0; s < segments.size(); ++s) {
    const std::uint32_t e = edges.find(segments.ends[s][0], segments.ends[s][1]);
    if (e == EdgeTable::none) {
      match.loose.push_back(s);
      continue;
    }
    match.segment_of[e] = s;
    match.is_segment[e] = 1;
  }
  return match;
}

void refuse_if_any(const Plc& plc, const TriangleSet& triangles, const SegmentSet& segments,
                   const std::vector<Overlap>& overlaps) {
  if (!overlaps.empty()) refuse_overlaps(plc, triangles, segments, overlaps, overlaps.size() == most_overlaps_told);
}

std::vector<Facet> collect_facets(const TriangleSet& triangles, const FacetPatches& patches, const RegionMap& map) {
  std::vector<std::uint32_t> sizes(patches.count(), 0);
  for (const std::uint32_t f : patches.facet_of) ++sizes[f];
  std::vector<Facet> facets(patches.count());
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    const std::uint32_t f = patches.facet_of[t];
    Facet& facet = facets[f];
    if (facet.triangles.empty()) {
      facet.triangles.reserve(sizes[f]);
      facet.exactly_flat = patches.exactly_flat[f];
      facet.marker = triangles.markers[t];
      facet.number = triangles.numbers[t];
      facet.above = map.of(t, true);
      facet.below = map.of(t, false);
    }
    facet.triangles.push_back(triangles.corners[t]);
  }
  return facets;
}

}  // namespace

Plc build_plc(const InputPlc& input, const PlcOptions& options, const Progress& progress) {
  constexpr std::uint64_t steps = 5;
  report(progress, "plc", 0, steps);
  refuse_no_facets(input);
  Plc plc;
  plc.name = input.name;
  snap_vertices(input, plc);
  TriangleSet triangles = gather_triangles(input, plc);
  SegmentSet segments = gather_segments(input, plc);
  const double tolerance = options.flatness * box_size(plc.vertices);
  triangulate_polygons(input, plc, tolerance, triangles, segments);
  refuse_degenerate_triangles(plc, triangles);
  refuse_duplicate_triangles(plc, triangles);

  report(progress, "plc", 1, steps);
  BoxTree tree(boxes_of(plc.vertices, triangles));
  if (split_triangles_at_vertices(plc.vertices, tree, triangles)) tree = BoxTree(boxes_of(plc.vertices, triangles));
  split_segments_at_vertices(plc.vertices, segments);
  EdgeTable edges = make_edge_table(triangles.corners);
  const SegmentMatch match = match_segments(segments, edges);

  report(progress, "plc", 2, steps);
  const FacetPatches patches = find_facets(plc.vertices, triangles, edges, match.is_segment, tolerance);

  report(progress, "plc", 3, steps);
  if (const auto covering = sort_around_edges(plc.vertices, triangles, patches.is_inner_edge, tolerance, edges))
    refuse_overlaps(plc, triangles, segments, {&*covering, 1}, false);
  refuse_if_any(plc, triangles, segments, find_overlaps(plc.vertices, triangles, patches, tree, most_overlaps_told));
  refuse_if_any(plc, triangles, segments,
                find_segment_overlaps(plc.vertices, triangles, segments, match.loose, tree, most_overlaps_told));

  report(progress, "plc", 4, steps);
  const VerticalRays rays(plc.vertices, triangles, tree);
  RegionMap map = find_regions(triangles, plc.vertices, edges, patches, rays);
  mark_inside(input, plc, triangles, edges, rays, map);
  plc.segments =
      find_segments(plc.vertices, triangles, edges, patches, segments, match.segment_of, match.loose, map, rays);
  plc.facets = collect_facets(triangles, patches, map);
  plc.regions = std::move(map.regions);
  report(progress, "plc", steps, steps);
  return plc;
}

}  // namespace ccdt
