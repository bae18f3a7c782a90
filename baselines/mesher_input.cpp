#include "baselines/mesher_input.h"

#include <algorithm>
#include <cmath>

#include "engine/io/merge_vertices.h"
#include "engine/plc/build_plc.h"

namespace ccdt::baselines {
namespace {

double distance(const Point3& a, const Point3& b) {
  return std::sqrt(squared_length(a - b));
}

}  // namespace

InputPlc merge_equal_vertices(const InputPlc& input) {
  InputPlc merged = input;
  merged.vertices.clear();
  io::VertexMerger<double> merger(merged.vertices);
  std::vector<std::uint32_t> renumbered;
  renumbered.reserve(input.vertices.size());
  for (const Point3& p : input.vertices) renumbered.push_back(merger.index_of(as_array(p)));
  for (auto& triangle : merged.triangles)
    for (auto& v : triangle) v = renumbered[v];
  for (auto& facet : merged.polygon_facets)
    for (auto& polygon : facet.polygons)
      for (auto& v : polygon) v = renumbered[v];
  for (auto& segment : merged.segments)
    for (auto& v : segment) v = renumbered[v];
  return merged;
}

InputPlc triangulate_facets(const InputPlc& input, const MeshOptions& options) {
  const plc::Plc plc = plc::build_plc(input, {.flatness = options.flatness});
  InputPlc triangles = input;
  triangles.vertices = plc.world;
  triangles.triangles.clear();
  triangles.triangle_markers.clear();
  triangles.triangle_numbers.clear();
  triangles.polygon_facets.clear();
  for (const plc::Facet& facet : plc.facets)
    for (const auto& [a, b, c] : plc.triangles_of(facet)) {
      triangles.triangles.push_back({a.value, b.value, c.value});
      triangles.triangle_markers.push_back(facet.marker);
    }
  for (auto& segment : triangles.segments)
    for (std::uint32_t& v : segment) v = plc.vertex_of_input[v].value;
  return triangles;
}

double median_edge_length(const InputPlc& input) {
  std::vector<double> lengths;
  lengths.reserve(3 * input.triangles.size());
  const auto add_loop = [&](const auto& loop) {
    if (loop.size() < 2) return;
    for (std::size_t i = 0; i < loop.size(); ++i)
      lengths.push_back(distance(input.vertices[loop[i]], input.vertices[loop[(i + 1) % loop.size()]]));
  };
  for (const auto& triangle : input.triangles) add_loop(triangle);
  for (const auto& facet : input.polygon_facets)
    for (const auto& polygon : facet.polygons) add_loop(polygon);
  if (lengths.empty()) return 0;
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  return *middle;
}

double target_edge_length(const InputPlc& input, const MeshOptions& options) {
  return options.edge_length > 0 ? options.edge_length : median_edge_length(input);
}

double regular_tetrahedron_volume(double edge_length) {
  return edge_length * edge_length * edge_length / (6 * std::sqrt(2.0));
}

double largest_tetrahedron_volume(double edge_length) {
  constexpr double largest_to_average = 2;
  return largest_to_average * regular_tetrahedron_volume(edge_length);
}

}  // namespace ccdt::baselines
