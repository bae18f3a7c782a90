#include "engine/protection/insert_interior.h"

#include <algorithm>
#include <tuple>
#include <unordered_set>

#include "engine/base/edge_key.h"
#include "engine/delaunay/cell_star.h"
#include "engine/delaunay/hilbert_order.h"
#include "engine/delaunay/insertion.h"
#include "engine/delaunay/wrap_delaunay.h"

namespace ccdt {
namespace {

/// The edges that must stay, and quick questions about them.
struct ProtectedEdges {
  std::vector<bool> on_edge;  ///< by vertex, those before the interior ones
  std::unordered_set<std::uint64_t> edges;

  bool may_have(std::uint32_t v) const { return v < on_edge.size() && on_edge[v]; }
  bool has(std::uint32_t a, std::uint32_t b) const { return edges.contains(edge_key(a, b)); }
};

ProtectedEdges collect(const std::vector<bool>& must_be_chain, const SegmentChains& chains, std::size_t vertices) {
  ProtectedEdges result;
  result.on_edge.assign(vertices, false);
  for (std::size_t s = 0; s < chains.size(); ++s) {
    if (!must_be_chain[s]) continue;
    for (std::size_t i = 0; i + 1 < chains[s].size(); ++i) {
      const VertexId a = chains[s][i].vertex, b = chains[s][i + 1].vertex;
      result.on_edge[a] = result.on_edge[b] = true;
      result.edges.insert(edge_key(a, b));
    }
  }
  return result;
}

/// Would filling this cavity destroy a protected edge, one that no face of the cavity has?
bool destroys_edge(const Delaunay& d, const Insertion& insertion, const ProtectedEdges& edges,
                   std::vector<std::uint64_t>& found) {
  found.clear();
  for (const std::uint32_t c : insertion.cavity_cells()) {
    const auto& v = d.cells[c].vertices;
    for (int i = 1; i < 4; ++i) {
      if (!edges.may_have(v[i])) continue;
      for (int j = 0; j < i; ++j)
        if (edges.may_have(v[j]) && edges.has(v[i], v[j])) found.push_back(edge_key(v[i], v[j]));
    }
  }
  if (found.empty()) return false;
  std::vector<std::uint64_t> border;
  for (const CavityFace& face : insertion.cavity_faces())
    for (int i = 0; i < 3; ++i) border.push_back(edge_key(face.vertices[i], face.vertices[(i + 1) % 3]));
  return std::any_of(found.begin(), found.end(),
                     [&](std::uint64_t edge) { return std::find(border.begin(), border.end(), edge) == border.end(); });
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
