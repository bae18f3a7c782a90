#include "baselines/common.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "engine/io/merge_vertices.h"

namespace ccdt {
namespace {

using Coordinates = std::array<double, 3>;

/// Adding zero turns -0 into +0, so that equal coordinates also compare and sort as equal.
Coordinates key(const Point3& p) {
  return {p.x + 0.0, p.y + 0.0, p.z + 0.0};
}

double distance(const Point3& a, const Point3& b) {
  return std::sqrt(squared_length(a - b));
}

double signed_volume(const TetMesh& mesh, const std::array<std::uint32_t, 4>& t) {
  const auto& v = mesh.vertices;
  return dot(cross(v[t[1]] - v[t[0]], v[t[2]] - v[t[0]]), v[t[3]] - v[t[0]]) / 6;
}

}  // namespace

InputPlc merge_equal_vertices(const InputPlc& input) {
  InputPlc merged = input;
  merged.vertices.clear();
  io::VertexMerger merger(merged.vertices);
  std::vector<std::uint32_t> renumbered;
  renumbered.reserve(input.vertices.size());
  for (const Point3& p : input.vertices) renumbered.push_back(merger.index_of(p));
  for (auto& triangle : merged.triangles)
    for (auto& v : triangle) v = renumbered[v];
  for (auto& facet : merged.polygon_facets)
    for (auto& polygon : facet.polygons)
      for (auto& v : polygon) v = renumbered[v];
  for (auto& segment : merged.segments)
    for (auto& v : segment) v = renumbered[v];
  return merged;
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

void orient_positively(TetMesh& mesh) {
  double total = 0;  // of the sum, because rounding may turn the sign of a single sliver
  for (const auto& t : mesh.tetrahedra) total += signed_volume(mesh, t);
  if (total >= 0) return;
  for (auto& t : mesh.tetrahedra) std::swap(t[0], t[1]);
}

MeshCounts count_elements(const InputPlc& input, const TetMesh& mesh) {
  std::vector<Coordinates> known;
  known.reserve(input.vertices.size());
  for (const Point3& p : input.vertices) known.push_back(key(p));
  std::ranges::sort(known);

  std::vector<char> on_facet(mesh.vertices.size(), 0);
  for (const auto& face : mesh.faces)
    for (const auto v : face) on_facet[v] = 1;
  for (const auto& edge : mesh.edges)
    for (const auto v : edge) on_facet[v] = 1;

  MeshCounts counts;
  counts.vertices = mesh.vertices.size();
  counts.tetrahedra = mesh.tetrahedra.size();
  counts.faces = mesh.faces.size();
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    if (std::ranges::binary_search(known, key(mesh.vertices[v]))) continue;
    ++(on_facet[v] ? counts.steiner_vertices : counts.interior_vertices);
  }
  return counts;
}

std::string digits(double value) {
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return {text.data(), end};
}

}  // namespace ccdt
