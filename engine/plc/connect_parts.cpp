#include "engine/plc/connect_parts.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "engine/base/parallel.h"
#include "engine/plc/find_facets.h"
#include "engine/plc/find_overlaps.h"
#include "engine/plc/gather_parts.h"

namespace ccdt::plc {

namespace {

// By triangle: is it not known to be a face of the complex? Empty if none is known to be one.
std::vector<std::uint8_t> find_doubtful(const TriangleSet& triangles) {
  std::vector<std::uint8_t> is_doubtful;
  if (std::ranges::all_of(triangles.faces, [](std::uint32_t face) { return face == no_face; })) return is_doubtful;
  is_doubtful.resize(triangles.size());
  parallel_for(triangles.size(), 4096, [&](std::size_t t) { is_doubtful[t] = triangles.faces[t] == no_face; });
  return is_doubtful;
}

}  // namespace

std::vector<TrianglePair> make_conforming(std::span<const Point3> vertices, TriangleSet& triangles) {
  const std::vector<std::uint8_t> is_doubtful = find_doubtful(triangles);
  if (!is_doubtful.empty() && std::ranges::find(is_doubtful, 1) == is_doubtful.end()) return {};
  std::vector<TrianglePair> close = find_close_triangles(vertices, triangles, is_doubtful);
  if (split_triangles_at_vertices(vertices, close, triangles)) close = find_close_triangles(vertices, triangles);
  return close;
}

ConnectedParts connect_parts(const Plc& plc, TriangleSet given_triangles, SegmentSet given_segments,
                             std::span<const TrianglePair> close, const PlcOptions& options, std::size_t limit) {
  ConnectedParts connected{{std::move(given_triangles), std::move(given_segments), {}, {}, {}}, {}, {}};
  auto& [parts, overlaps, tree] = connected;
  auto& [triangles, segments, edges, match, patches] = parts;
  edges = make_edge_table(triangles.corners);
  match = match_segments(segments, edges);
  const double tolerance = tolerance_of(plc, options.flatness);
  const std::vector<double> tolerances(triangles.size(), tolerance);
  patches = find_facets(plc.vertices, triangles, edges, match.segment_of, tolerances);
  overlaps.covering = sort_around_edges(plc.vertices, triangles, patches.is_inner_edge, tolerance, edges, limit);
  overlaps.crossing = find_overlaps(plc.vertices, triangles, patches, close, limit);
  if (!match.loose.empty()) {
    tree = tree_of(plc.vertices, triangles);
    overlaps.of_segments = find_segment_overlaps(plc.vertices, triangles, segments, match.loose, *tree, limit);
  }
  return connected;
}

}  // namespace ccdt::plc
