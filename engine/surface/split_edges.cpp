#include <algorithm>

#include "engine/surface/remesh_steps.h"
#include "engine/surface/surface_limits.h"

namespace ccdt {
namespace {

constexpr double good_quality = 0.1;
constexpr double least_part = 0.5;
constexpr double most_step = 0.25;  // of a new vertex to the original surface, as a fraction of the edge's length

bool touches_frozen_face(const WorkingMesh& m, EdgeHandle e) {
  for (unsigned side = 0; side < 2; ++side) {
    const HalfedgeHandle h = m.mesh.halfedge_handle(e, side);
    if (!m.mesh.is_boundary(h) && m.is_frozen(m.mesh.face_handle(h))) return true;
  }
  return false;
}

// May the triangles at an edge be split with the new vertex at a point where the surface has that normal?
bool may_split(const WorkingMesh& m, EdgeHandle e, const Point3& p, const Point3& normal) {
  WorstFit before, after;
  for (unsigned side = 0; side < 2; ++side) {
    const HalfedgeHandle h = m.mesh.halfedge_handle(e, side);
    if (m.mesh.is_boundary(h)) continue;
    const auto [a, b, c] = corners_of(m, h);
    before.add(fit_of(m, {a, b, c}));
    after.add(fit_of({m.point(a), p, m.point(c)}, {m.at(a).normal, normal, m.at(c).normal}));
    after.add(fit_of({p, m.point(b), m.point(c)}, {normal, m.at(b).normal, m.at(c).normal}));
  }
  // Longest edges are split, so that angles stay above half of the least (Rivara 1984); flips then mend the needles.
  return may_replace({least_part * before.worst.quality, before.worst.agreement}, after.worst, good_quality);
}

void split(WorkingMesh& m, EdgeHandle e, VertexHandle v) {
  m.mesh.split(e, v);
  m.face_is_frozen.resize(m.mesh.n_faces(), 0);
}

VertexHandle any_end(const WorkingMesh& m, EdgeHandle e) {
  return m.mesh.to_vertex_handle(m.mesh.halfedge_handle(e, 0));
}

// The middle of the edge lies on the surface of before, if not on the original one, and is tried next.
void try_split(WorkingMesh& m, EdgeHandle e) {
  const VertexHandle a = any_end(m, e), b = m.mesh.to_vertex_handle(m.mesh.halfedge_handle(e, 1));
  const std::uint32_t patch = m.at(a).patch;
  const Point3 middle = m.point(a) + 0.5 * (m.point(b) - m.point(a));
  Foot foot = m.closest.on_patch(patch, middle, m.at(a).near);
  const Point3 normal = m.closest.normal_at(foot);
  const bool is_near = foot.squared_distance <= most_step * most_step * squared_length(m.point(b) - m.point(a));
  if (!is_near || !may_split(m, e, foot.point, normal)) {
    if (!may_split(m, e, middle, normal)) return;
    foot.point = middle;
  }
  split(m, e, add_vertex(m, patch, foot, m.wanted_length(a, b)));
}

void try_split_link(WorkingMesh& m, std::uint32_t l) {
  const WorkingMesh::Link link = m.links[l];
  const double arc = 0.5 * (link.arc[0] + link.arc[1]);
  const Point3 p = m.features.curves[link.curve].at(arc);
  const std::vector<EdgeHandle> edges = copies_of_link(m, l);
  for (const EdgeHandle e : edges) {
    const WorkingMesh::Vertex& end = m.at(any_end(m, e));
    const Point3 normal = m.closest.normal_at(m.closest.on_patch(end.patch, p, end.near));
    if (touches_frozen_face(m, e) || !may_split(m, e, p, normal)) return;
  }
  const auto knot = static_cast<std::uint32_t>(m.knots.size());
  const auto new_link = static_cast<std::uint32_t>(m.links.size());
  m.knots.push_back({p, false, {l, new_link}, {}, m.wanted_length(link.ends[0], link.ends[1])});
  m.links.push_back({{knot, link.ends[1]}, link.curve, {arc, link.arc[1]}});
  m.links[l].ends[1] = knot;
  m.links[l].arc[1] = arc;
  for (std::uint32_t& at_end : m.knots[link.ends[1]].links)
    if (at_end == l) {
      at_end = new_link;
      break;
    }
  for (const EdgeHandle e : edges) {
    const WorkingMesh::Vertex end = m.at(any_end(m, e));
    split(m, e, add_copy(m, end.patch, knot, end.near));
  }
}

// The longest first: what is split then is the longest edge of its triangles, which keeps their angles (Rivara 1984).
std::vector<EdgeHandle> long_edges(const WorkingMesh& m) {
  std::vector<std::pair<double, int>> found;
  for (const EdgeHandle e : m.mesh.edges()) {
    if (m.mesh.is_boundary(e) || touches_frozen_face(m, e)) continue;
    const VertexHandle a = any_end(m, e), b = m.mesh.to_vertex_handle(m.mesh.halfedge_handle(e, 1));
    const double edge = m.edge_length(a, b);
    if (edge > too_long * m.wanted_length(a, b)) found.emplace_back(-edge, e.idx());
  }
  std::sort(found.begin(), found.end());
  std::vector<EdgeHandle> edges;
  edges.reserve(found.size());
  for (const auto& [negative_length, e] : found) edges.emplace_back(e);
  return edges;
}

}  // namespace

void split_long_edges(WorkingMesh& m) {
  // New links and edges come at the end of the lists; halves that are still too long are found in the next sweep.
  std::size_t count = 0;
  while (count != m.links.size()) {
    count = m.links.size();
    for (std::uint32_t l = 0; l < count; ++l) {
      const auto [a, b] = m.links[l].ends;
      const double edge = length(m.knots[b].position - m.knots[a].position);
      if (m.links[l].is_alive && edge > too_long * m.wanted_length(a, b)) try_split_link(m, l);
    }
  }
  count = 0;
  while (count != m.mesh.n_edges()) {
    count = m.mesh.n_edges();
    for (const EdgeHandle e : long_edges(m)) try_split(m, e);
  }
}

}  // namespace ccdt
