#include "engine/surface/find_crossings.h"

#include <algorithm>

#include "engine/plc/edge_table.h"
#include "engine/plc/find_facets.h"
#include "engine/plc/find_overlaps.h"
#include "engine/plc/plc.h"
#include "engine/plc/quanta.h"
#include "engine/plc/snap_vertices.h"
#include "engine/plc/sort_around_edges.h"

namespace ccdt {
namespace {

constexpr std::size_t most_places = 4000;

bool has_no_area(const Plc& plc, const Corners& c) {
  return rounded_normal(plc.vertices[c[0]], plc.vertices[c[1]], plc.vertices[c[2]]) == Point3{};
}

TriangleSet gather_triangles(const InputPlc& surface, const Plc& plc) {
  TriangleSet triangles;
  for (std::uint32_t t = 0; t < surface.triangles.size(); ++t) {
    const auto [a, b, c] = surface.triangles[t];
    triangles.add({plc.vertex_of_input[a], plc.vertex_of_input[b], plc.vertex_of_input[c]}, surface.triangle_markers[t],
                  t);
  }
  return triangles;
}

double box_size(const std::vector<Point3>& vertices) {
  Box box = box_of(vertices.front());
  for (const Point3& p : vertices) box = hull(box, box_of(p));
  const Point3 size = box.high - box.low;
  return std::max({size.x, size.y, size.z});
}

}  // namespace

std::vector<Point3> find_crossings(const InputPlc& surface, double flatness) {
  Plc plc;
  snap_vertices(surface, plc);
  TriangleSet triangles = gather_triangles(surface, plc);
  std::vector<Point3> places;
  for (const Corners& c : triangles.corners)
    if (has_no_area(plc, c)) places.push_back(plc.world[c[0]]);
  if (!places.empty()) return places;

  EdgeTable edges = make_edge_table(triangles.corners);
  SegmentSet segments;
  std::vector<char> is_segment(edges.size(), 0);
  std::vector<std::uint32_t> loose;
  for (std::uint32_t s = 0; s < surface.segments.size(); ++s) {
    const auto [a, b] = surface.segments[s];
    segments.add(plc.vertex_of_input[a], plc.vertex_of_input[b], surface.segment_markers[s]);
    const std::uint32_t e = edges.find(segments.ends[s][0], segments.ends[s][1]);
    if (e == EdgeTable::none)
      loose.push_back(s);
    else
      is_segment[e] = 1;
  }
  const double tolerance = flatness * box_size(plc.vertices);
  const FacetPatches facets = find_facets(plc.vertices, triangles, edges, is_segment, tolerance);
  const auto add = [&](const Overlap& overlap) { places.push_back(plc.grid.to_world(overlap.where)); };
  if (const auto covering = sort_around_edges(plc.vertices, triangles, facets.is_inner_edge, tolerance, edges))
    add(*covering);
  const BoxTree tree(boxes_of(plc.vertices, triangles));
  for (const Overlap& o : find_overlaps(plc.vertices, triangles, facets, tree, most_places)) add(o);
  for (const Overlap& o : find_segment_overlaps(plc.vertices, triangles, segments, loose, tree, most_places)) add(o);
  return places;
}

}  // namespace ccdt
