#include "engine/surface/wanted_lengths.h"

#include <algorithm>
#include <queue>

namespace ccdt {
namespace {

constexpr double most_ratio = 2;  // of the wanted length to the shortest edge of a vertex
constexpr double growth = 0.5;    // of the wanted length per length
constexpr double least = 0.2;     // of the usual length; slits may be as narrow as they like

double& wanted_at(WorkingMesh& m, VertexHandle v) {
  return m.at(v).knot == WorkingMesh::none ? m.at(v).wanted : m.knots[m.at(v).knot].wanted;
}

void limit_by_shortest_edges(WorkingMesh& m) {
  const auto limit = [&](double& wanted, double usual, double edge) {
    wanted = std::min(wanted, std::max(most_ratio * edge, least * usual));
  };
  for (WorkingMesh::Knot& k : m.knots) k.wanted = m.lengths.at(k.position);
  for (const VertexHandle v : m.mesh.vertices()) m.at(v).wanted = m.lengths.at(m.point(v));
  for (const WorkingMesh::Link& link : m.links) {
    if (!link.is_alive) continue;
    WorkingMesh::Knot &a = m.knots[link.ends[0]], &b = m.knots[link.ends[1]];
    for (WorkingMesh::Knot* k : {&a, &b}) limit(k->wanted, m.lengths.at(k->position), length(b.position - a.position));
  }
  for (const EdgeHandle e : m.mesh.edges()) {
    const VertexHandle a = m.mesh.to_vertex_handle(m.mesh.halfedge_handle(e, 0));
    const VertexHandle b = m.mesh.to_vertex_handle(m.mesh.halfedge_handle(e, 1));
    for (const VertexHandle v : {a, b}) limit(wanted_at(m, v), m.lengths.at(m.point(v)), m.edge_length(a, b));
  }
}

}  // namespace

// Dijkstra's algorithm from the smallest lengths on.
void find_wanted_lengths(WorkingMesh& m) {
  limit_by_shortest_edges(m);
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  for (const VertexHandle v : m.mesh.vertices())
    if (wanted_at(m, v) < m.lengths.at(m.point(v))) queue.emplace(wanted_at(m, v), v.idx());
  while (!queue.empty()) {
    const auto [wanted, index] = queue.top();
    queue.pop();
    const VertexHandle v(index);
    if (wanted > wanted_at(m, v)) continue;
    for (auto n = m.mesh.cvv_iter(v); n.is_valid(); ++n) {
      const double most = wanted + growth * m.edge_length(v, *n);
      if (most >= wanted_at(m, *n)) continue;
      wanted_at(m, *n) = most;
      if (m.at(*n).knot == WorkingMesh::none)
        queue.emplace(most, (*n).idx());
      else
        for (const VertexHandle copy : m.knots[m.at(*n).knot].copies) queue.emplace(most, copy.idx());
    }
  }
  for (const VertexHandle v : m.mesh.vertices()) m.at(v).wanted = wanted_at(m, v);
}

}  // namespace ccdt
