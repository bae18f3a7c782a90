#include "engine/protection/insert_interior.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "engine/base/simplex_map.h"
#include "engine/delaunay/cell_star.h"
#include "engine/delaunay/hilbert_order.h"
#include "engine/delaunay/insertion.h"
#include "engine/delaunay/wrap_delaunay.h"

namespace ccdt {
namespace {

/// The edges that must stay, and quick questions about them.
struct ProtectedEdges {
  std::vector<std::uint8_t> on_edge;  ///< by vertex, those before the interior ones
  EdgeMap edges;

  bool may_have(std::uint32_t v) const { return v < on_edge.size() && on_edge[v] != 0; }
  bool has(std::uint32_t a, std::uint32_t b) const { return edges.find(a, b) != EdgeMap::none; }
};

ProtectedEdges collect(const std::vector<bool>& must_be_chain, const SegmentChains& chains, std::size_t vertices) {
  std::vector<std::uint8_t> on_edge(vertices, 0);
  std::vector<std::array<VertexId, 2>> edges;
  for (std::size_t s = 0; s < chains.size(); ++s) {
    if (!must_be_chain[s]) continue;
    for (std::size_t i = 0; i + 1 < chains[s].size(); ++i) {
      const VertexId a = chains[s][i].vertex, b = chains[s][i + 1].vertex;
      on_edge[a] = on_edge[b] = 1;
      edges.push_back({a, b});
    }
  }
  return {std::move(on_edge), EdgeMap(edges, vertices)};
}

/// Would filling this cavity destroy a protected edge, one that no face of the cavity has?
bool destroys_edge(const Delaunay& d, const Insertion& insertion, const ProtectedEdges& edges,
                   std::vector<std::uint64_t>& found) {
  found.clear();
  const auto interior = static_cast<std::uint32_t>(edges.on_edge.size());  // the first id, and all from there on
  for (const std::uint32_t c : insertion.cavity_cells()) {
    const auto& v = d.cells[c].vertices;
    const int others = int{v[0] < interior} + int{v[1] < interior} + int{v[2] < interior} + int{v[3] < interior};
    if (others < 2) continue;
    for (int i = 1; i < 4; ++i) {
      if (!edges.may_have(v[i])) continue;
      for (int j = 0; j < i; ++j) {
        if (edges.may_have(v[j]) && edges.has(v[i], v[j])) found.push_back(edge_key(v[i], v[j]));
      }
    }
  }
  if (found.empty()) return false;
  std::ranges::sort(found);
  const auto repeated = std::ranges::unique(found);
  // The faces are a closed surface, which passes each of its edges once in each direction.
  std::ptrdiff_t on_faces = 0;
  for (const CavityFace& face : insertion.cavity_faces()) {
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t a = face.vertices[i], b = face.vertices[i < 2 ? i + 1 : 0];
      if (a < b && edges.may_have(a) && edges.may_have(b) && edges.has(a, b)) ++on_faces;
    }
  }
  return on_faces < repeated.begin() - found.begin();
}

bool has_all_edges(const Delaunay& d, const std::vector<bool>& must_be_chain, const SegmentChains& chains) {
  CellStar star(d);
  for (std::size_t s = 0; s < chains.size(); ++s)
    for (std::size_t i = 0; must_be_chain[s] && i + 1 < chains[s].size(); ++i)
      if (!star.has_edge(chains[s][i].vertex, chains[s][i + 1].vertex)) return false;
  return true;
}

/// The vertices with the points that are not among them, ranked as they would be inserted.
std::vector<DelaunayVertex> with_points(std::vector<DelaunayVertex> vertices, std::span<const Point3> points) {
  const auto less = [](const Point3& a, const Point3& b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); };
  std::vector<Point3> taken;
  taken.reserve(vertices.size());
  for (const DelaunayVertex& v : vertices) taken.push_back(v.point);
  std::ranges::sort(taken, less);
  for (const std::uint32_t i : hilbert_order(points))
    if (!std::ranges::binary_search(taken, points[i], less))
      vertices.push_back({points[i], static_cast<std::uint32_t>(vertices.size()), 0});
  return vertices;
}

}  // namespace

std::uint64_t insert_interior(std::span<const Point3> points, const std::vector<bool>& must_be_chain,
                              const SegmentChains& chains, Delaunay& delaunay, const Progress& progress) {
  const ProtectedEdges edges = collect(must_be_chain, chains, delaunay.vertices.size());
  const std::size_t before = delaunay.vertices.size();
  delaunay.vertices.reserve(before + points.size());
  delaunay.cells.reserve(delaunay.cells.size() + 7 * points.size());
  Insertion insertion(delaunay);
  std::vector<std::uint64_t> found;
  std::uint32_t last = delaunay.vertices[0].cell;
  std::uint64_t done = 0;
  for (const std::uint32_t i : hilbert_order(points)) {
    if ((++done & 0xFFFF) == 0) report(progress, "delaunay", done, points.size());
    const auto id = static_cast<std::uint32_t>(delaunay.vertices.size());
    delaunay.vertices.push_back({points[i], id, 0});
    if (insertion.dig(id, last) && !destroys_edge(delaunay, insertion, edges, found)) {
      last = insertion.fill();
    } else {
      insertion.abandon();
      delaunay.vertices.pop_back();
    }
  }
  return delaunay.vertices.size() - before;
}

std::uint64_t wrap_interior(std::span<const Point3> points, const std::vector<bool>& must_be_chain,
                            const SegmentChains& chains, double grid_scale, Delaunay& delaunay,
                            const Progress& progress) {
  const std::size_t before = delaunay.vertices.size();
  Delaunay all = wrap_delaunay(with_points(delaunay.vertices, points), grid_scale, progress);
  // Edges that are there with all points were there with any part of them: then insertion would drop none.
  if (has_all_edges(all, must_be_chain, chains)) {
    delaunay = std::move(all);
  } else {
    insert_interior(points, must_be_chain, chains, delaunay, progress);
    delaunay = wrap_delaunay(std::move(delaunay.vertices), grid_scale, progress);
  }
  return delaunay.vertices.size() - before;
}

}  // namespace ccdt
