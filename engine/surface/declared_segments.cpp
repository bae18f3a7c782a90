#include "engine/surface/declared_segments.h"

#include "engine/plc/split_at_vertices.h"
#include "engine/plc/triangulate_polygons.h"

namespace ccdt {

SegmentSet declared_segments(const InputPlc& input, const Plc& plc, double tolerance) {
  SegmentSet segments;
  for (std::uint32_t s = 0; s < input.segments.size(); ++s)
    segments.add(plc.vertex_of_input[input.segments[s][0]], plc.vertex_of_input[input.segments[s][1]],
                 input.segment_markers.empty() ? 0 : input.segment_markers[s]);
  TriangleSet ignored;
  triangulate_polygons(input, plc, tolerance, ignored, segments);
  split_segments_at_vertices(plc.vertices, segments);
  return segments;
}

std::vector<char> find_vertices_listed_alone(const InputPlc& input, const Plc& plc) {
  std::vector<char> alone(plc.vertices.size(), 0);
  for (const VertexId v : plc.vertex_of_input) alone[v] = 1;
  const auto use = [&](std::uint32_t input_vertex) { alone[plc.vertex_of_input[input_vertex]] = 0; };
  for (const auto& corners : input.triangles)
    for (const std::uint32_t v : corners) use(v);
  for (const auto& ends : input.segments)
    for (const std::uint32_t v : ends) use(v);
  for (const PolygonFacet& facet : input.polygon_facets)
    for (const auto& polygon : facet.polygons)
      if (polygon.size() > 1)
        for (const std::uint32_t v : polygon) use(v);
  return alone;
}

}  // namespace ccdt
