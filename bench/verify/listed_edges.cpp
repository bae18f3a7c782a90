#include "bench/verify/listed_edges.h"

#include <algorithm>
#include <unordered_map>
#include <unordered_set>

#include "bench/verify/exact.h"
#include "bench/verify/findings.h"
#include "engine/base/simplex_map.h"

namespace ccdt::verify {
namespace {

using EdgeKeys = std::unordered_set<std::uint64_t>;

std::string described(const mesh::TetMesh& mesh, const Edge& edge) {
  return "the edge" + text(mesh.vertices, edge);
}

/// Calls visit(one, next) for the mesh edges of a chain.
template <class Visit>
void visit_links(std::span<const std::uint32_t> chain, const Visit& visit) {
  for (std::size_t i = 1; i < chain.size(); ++i) visit(chain[i - 1], chain[i]);
}

void add_links(std::span<const std::uint32_t> chain, EdgeKeys& keys) {
  visit_links(chain, [&](std::uint32_t a, std::uint32_t b) { keys.insert(edge_key(a, b)); });
}

bool has_polygons(const plc::InputPlc& input) {
  return std::ranges::any_of(input.polygon_facets, [](const plc::PolygonFacet& facet) {
    return std::ranges::any_of(facet.polygons, [](const auto& polygon) { return polygon.size() > 3; });
  });
}

/// The edges along which listed faces meet that are not exactly in one plane.
EdgeKeys folds_of_faces(const mesh::TetMesh& mesh) {
  EdgeKeys folds;
  std::unordered_map<std::uint64_t, std::uint32_t> apex;  // of the first face at an edge
  for (const auto& face : mesh.faces)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = face[k], b = face[(k + 1) % 3], c = face[(k + 2) % 3];
      const auto [first, is_new] = apex.try_emplace(edge_key(a, b), c);
      const auto at = [&](std::uint32_t v) { return mesh.vertices[v]; };
      if (!is_new && orientation(at(a), at(b), at(c), at(first->second)) != 0) folds.insert(edge_key(a, b));
    }
  return folds;
}

std::size_t count_edges(const mesh::TetMesh& mesh) {
  std::vector<std::uint64_t> keys;
  keys.reserve(6 * mesh.tetrahedra.size());
  for (const auto& t : mesh.tetrahedra)
    for (int j = 1; j < 4; ++j)
      for (int i = 0; i < j; ++i) keys.push_back(edge_key(t[i], t[j]));
  sort_and_unique(keys);
  return keys.size();
}

int marker_of(const plc::InputPlc& input, std::size_t segment) {
  return input.segment_markers.empty() ? 0 : input.segment_markers[segment];
}

}  // namespace

Check check_listed_edges(const plc::InputPlc& input, const Topology& topology, const Surface& surface,
                         const SurfaceEdges& lines, bool required) {
  const mesh::TetMesh& mesh = topology.mesh;
  Check check{.name = listed_edges_check};
  if (mesh.edges.empty()) {
    if (required && std::ranges::any_of(input.segment_markers, [](int marker) { return marker != 0; }))
      fail(check, [] { return std::string("segments of the input have markers, but no edge is listed"); });
    return check;
  }
  EdgeKeys on_surface, listed;
  for (std::size_t s = 0; s < surface.segments.size(); ++s) add_links(lines.segments.of(s), on_surface);
  for (std::size_t e = 0; e < surface.edges.size(); ++e) add_links(lines.edges.of(e), on_surface);
  std::vector<Edge> others;
  for (const Edge& edge : mesh.edges) {
    const std::uint64_t key = edge_key(edge[0], edge[1]);
    ++check.checked;
    if (!has_edge(topology, edge[0], edge[1]))
      fail(check, [&] { return described(mesh, edge) + " is listed, but belongs to no tetrahedron"; });
    else if (!listed.insert(key).second)
      fail(check, [&] { return described(mesh, edge) + " is listed twice"; });
    else if (!on_surface.contains(key))
      others.push_back(edge);
  }
  if (!others.empty() && listed.size() < count_edges(mesh)) {
    // A polygon that is not planar becomes several facets, and the mesh has the edges between them.
    const EdgeKeys folds = has_polygons(input) ? folds_of_faces(mesh) : EdgeKeys();
    for (const Edge& edge : others)
      if (!folds.contains(edge_key(edge[0], edge[1])))
        fail(check, [&] { return described(mesh, edge) + " is listed, but is on no edge or segment of the input"; });
  }
  const auto miss = [&](std::uint32_t a, std::uint32_t b) {
    ++check.checked;
    if (!listed.insert(edge_key(a, b)).second) return;
    fail(check, [&] { return described(mesh, {a, b}) + " is on a segment or an edge of the input, but not listed"; });
  };
  for (std::size_t s = 0; s < surface.segments.size(); ++s) visit_links(lines.segments.of(s), miss);
  for (std::size_t e = 0; e < surface.edges.size(); ++e)
    if (lines.features[e]) visit_links(lines.edges.of(e), miss);
  return check;
}

Check check_edge_markers(const plc::InputPlc& input, const Topology& topology, const Surface& surface) {
  const mesh::TetMesh& mesh = topology.mesh;
  Check check{.name = "edge markers"};
  if (!mesh.edges.empty() && mesh.edge_markers.empty() && !input.segment_markers.empty())
    check.not_compared = "the mesh has no markers of edges";
  if (mesh.edge_markers.empty() || input.segment_markers.empty()) return check;
  std::vector<Edge> segments;
  for (const auto& [a, b] : input.segments) segments.push_back({surface.sites.of_input[a], surface.sites.of_input[b]});
  const Chains chains = find_chains(topology, surface, segments);
  std::unordered_multimap<std::uint64_t, int> markers;  // by edge
  for (std::size_t s = 0; s < segments.size(); ++s)
    if (marker_of(input, s) != 0)
      visit_links(chains.of(s),
                  [&](std::uint32_t a, std::uint32_t b) { markers.emplace(edge_key(a, b), marker_of(input, s)); });
  for (std::size_t i = 0; i < mesh.edges.size(); ++i) {
    const auto [first, last] = markers.equal_range(edge_key(mesh.edges[i][0], mesh.edges[i][1]));
    if (first == last) continue;
    ++check.checked;
    if (std::any_of(first, last, [&](const auto& marker) { return marker.second == mesh.edge_markers[i]; })) continue;
    fail(check, [&, marker = first->second] {
      return described(mesh, mesh.edges[i]) + " has the marker " + std::to_string(mesh.edge_markers[i]) +
             " and is on a segment with the marker " + std::to_string(marker);
    });
  }
  return check;
}

}  // namespace ccdt::verify
