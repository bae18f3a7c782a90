#include "engine/plc/build_plc.h"

#include "engine/base/box_tree.h"
#include "engine/base/errors.h"
#include "engine/plc/edge_table.h"
#include "engine/plc/find_facets.h"
#include "engine/plc/find_overlaps.h"
#include "engine/plc/find_regions.h"
#include "engine/plc/gather_parts.h"
#include "engine/plc/input_faults.h"
#include "engine/plc/triangulate_polygons.h"

namespace ccdt::plc {

namespace {

constexpr std::size_t most_overlaps = 1000;

void check_facets_exist(const InputPlc& input) {
  if (input.facet_count() > 0 && !input.vertices.empty()) return;
  throw InputError("there are no facets", {.file = input.name}, "give a surface, or a .poly or .smesh with facets");
}

void check_overlaps(const Plc& plc, const PlcParts& parts, const std::vector<Overlap>& overlaps) {
  if (!overlaps.empty())
    throw_overlaps(plc, parts.triangles, parts.segments, overlaps, overlaps.size() == most_overlaps);
}

// Is a sector of the domain of 180 degrees or more around the edge?
bool is_grazeable(std::span<const Point3> vertices, const PlcParts& parts, const RegionMap& map, std::uint32_t e) {
  const auto [a, b] = parts.edges.ends[e];
  const auto around = parts.edges.around(e);
  for (std::size_t i = 0; i < around.size(); ++i) {
    const VertexTriple& s = parts.triangles.corners[around[i]];
    const VertexTriple& t = parts.triangles.corners[around[(i + 1) % around.size()]];
    const RegionId sector = map.of(around[i], runs_along(s, a, b));
    if (!map.regions[sector].inside) continue;
    const Turn angle = around.size() == 1 ? Turn::above_180
                                          : turn_about(vertices[a], vertices[b], vertices[apex_over(s, a, b)],
                                                       vertices[apex_over(t, a, b)]);
    if (angle == Turn::exactly_180 || angle == Turn::above_180) return true;
  }
  return false;
}

// The edges that do not lie within one facet, and the segments of the input that are no edge.
std::vector<Segment> collect_segments(std::span<const Point3> vertices, const PlcParts& parts, const RegionMap& map) {
  std::vector<Segment> segments;
  for (std::uint32_t e = 0; e < parts.edges.size(); ++e) {
    if (parts.patches.is_inner_edge[e]) continue;
    const std::uint32_t s = parts.match.segment_of[e];
    const int marker = s == EdgeTable::none ? 0 : parts.segments.markers[s];
    segments.push_back({parts.edges.ends[e], marker, is_grazeable(vertices, parts, map, e)});
  }
  for (std::size_t i = 0; i < map.of_loose.size(); ++i) {
    const std::uint32_t s = parts.match.loose[i];
    segments.push_back({parts.segments.ends[s], parts.segments.markers[s], map.regions[map.of_loose[i]].inside});
  }
  return segments;
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
  check_facets_exist(input);
  Plc plc;
  plc.name = input.name;
  snap_vertices(input, plc);
  PlcParts parts;
  auto& [triangles, segments, edges, match, patches] = parts;
  triangles = gather_triangles(input, plc);
  segments = gather_segments(input, plc);
  const double tolerance = tolerance_of(plc, options.flatness);
  triangulate_polygons(input, plc, tolerance, triangles, segments);
  check_degenerate_triangles(plc, triangles);
  check_duplicate_triangles(plc, triangles);

  report(progress, "plc", 1, steps);
  BoxTree tree(boxes_of(plc.vertices, triangles));
  if (split_triangles_at_vertices(plc.vertices, tree, triangles)) tree = BoxTree(boxes_of(plc.vertices, triangles));
  split_segments_at_vertices(plc.vertices, segments);
  edges = make_edge_table(triangles.corners);
  match = match_segments(segments, edges);

  report(progress, "plc", 2, steps);
  patches = find_facets(plc.vertices, triangles, edges, match.segment_of, tolerance);

  report(progress, "plc", 3, steps);
  if (const auto covering = sort_around_edges(plc.vertices, triangles, patches.is_inner_edge, tolerance, edges))
    throw_overlaps(plc, triangles, segments, {&*covering, 1}, false);
  check_overlaps(plc, parts, find_overlaps(plc.vertices, triangles, patches, tree, most_overlaps));
  check_overlaps(plc, parts,
                 find_segment_overlaps(plc.vertices, triangles, segments, match.loose, tree, most_overlaps));

  report(progress, "plc", 4, steps);
  RegionMap map = find_regions(input, plc, parts, tree);
  plc.segments = collect_segments(plc.vertices, parts, map);
  plc.facets = collect_facets(triangles, patches, map);
  plc.regions = std::move(map.regions);
  report(progress, "plc", steps, steps);
  return plc;
}

}  // namespace ccdt::plc
