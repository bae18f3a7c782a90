#include <algorithm>

#include "engine/surface/improve_triangles.h"
#include "engine/surface/remesh_steps.h"
#include "engine/surface/surface_limits.h"

namespace ccdt {
namespace {

constexpr std::uint32_t none = WorkingMesh::none;
constexpr double good_quality = 0.2;
constexpr int most_sweeps = 10;

std::uint32_t knot_of(const WorkingMesh& m, VertexHandle v) {
  return m.at(v).knot;
}

// The vertices opposite of a halfedge's edge, one or two.
bool is_apex(const WorkingMesh& m, HalfedgeHandle h, VertexHandle v) {
  for (const HalfedgeHandle side : {h, m.mesh.opposite_halfedge_handle(h)})
    if (!m.mesh.is_boundary(side) && m.mesh.to_vertex_handle(m.mesh.next_halfedge_handle(side)) == v) return true;
  return false;
}

// Would the start of the halfedge, drawn to its end, bring edges to where others are already? The halfedge mesh sees
// only those of the same wedge.
bool would_join_knots(const WorkingMesh& m, HalfedgeHandle h, std::uint32_t along_link) {
  const VertexHandle from = m.mesh.from_vertex_handle(h), to = m.mesh.to_vertex_handle(h);
  if (knot_of(m, to) == none) return false;
  for (auto n = m.mesh.cvv_iter(from); n.is_valid(); ++n) {
    const std::uint32_t knot = knot_of(m, *n);
    if (knot == none || *n == to || is_apex(m, h, *n)) continue;
    if (knot == knot_of(m, to)) return true;
    if (knot != along_link && are_joined(m, knot, knot_of(m, to))) return true;
  }
  return false;
}

// What a collapse is for: to have no short edges, or to make the worst triangle around better.
enum class Aim { length, angle };

// The longest edges that it may make, in units of the wanted length.
double longest(Aim aim) {
  return aim == Aim::length ? too_long : 1.3 * too_long;
}

// Are the triangles and edges that the collapse would make good enough?
bool has_good_result(const WorkingMesh& m, HalfedgeHandle h, Aim aim) {
  const VertexHandle from = m.mesh.from_vertex_handle(h), to = m.mesh.to_vertex_handle(h);
  const Shape shape = aim == Aim::angle ? Shape::angle : Shape::area;
  WorstFit before, after;
  for (auto out = m.mesh.cvoh_iter(from); out.is_valid(); ++out) {
    const VertexHandle n = m.mesh.to_vertex_handle(*out);
    if (n != to && !is_apex(m, h, n)) {
      if (m.edge_length(n, to) > longest(aim) * m.wanted_length(n, to) || !runs_along_surface(m, n, to)) return false;
    }
    if (m.mesh.is_boundary(*out)) continue;
    if (m.is_frozen(m.mesh.face_handle(*out))) return false;
    auto v = corners_of(m, *out);
    before.add(fit_of(m, v, shape));
    if (v[1] == to || v[2] == to) continue;
    v[0] = to;
    after.add(fit_of(m, v, shape));
  }
  return aim == Aim::angle ? is_better(before.worst, after.worst)
                           : may_replace(before.worst, after.worst, good_quality);
}

bool stays_near_surface(const WorkingMesh& m, HalfedgeHandle h, Aim aim) {
  const double most = aim == Aim::length ? most_deviation : most_deviation_of_improved;
  const VertexHandle from = m.mesh.from_vertex_handle(h), to = m.mesh.to_vertex_handle(h);
  for (auto n = m.mesh.cvv_iter(from); n.is_valid(); ++n)
    if (*n != to && !is_apex(m, h, *n) && !is_near_surface(m, *n, m.point(to), most)) return false;
  return true;
}

bool try_collapse(WorkingMesh& m, HalfedgeHandle h, Aim aim) {
  const VertexHandle from = m.mesh.from_vertex_handle(h);
  if (knot_of(m, from) != none || m.at(from).is_frozen || !m.mesh.is_collapse_ok(h)) return false;
  if (would_join_knots(m, h, none) || !has_good_result(m, h, aim) || !stays_near_surface(m, h, aim)) return false;
  m.mesh.collapse(h);
  return true;
}

// The halfedges to the neighbouring knots along the boundary, from each copy of a knot that is not fixed.
struct Sheet {
  HalfedgeHandle to_next, to_previous;
};

// Nothing if they do not lead to two different pairs of copies each: drawn together, they would be one edge.
std::vector<Sheet> sheets_at(const WorkingMesh& m, std::uint32_t knot, std::uint32_t next) {
  std::vector<Sheet> sheets;
  std::vector<std::array<int, 2>> ends;
  for (const VertexHandle copy : m.knots[knot].copies) {
    Sheet sheet;
    const HalfedgeHandle out = m.mesh.halfedge_handle(copy);  // on the boundary, as OpenMesh promises
    sheet.to_next = out;
    sheet.to_previous = m.mesh.opposite_halfedge_handle(m.mesh.prev_halfedge_handle(out));
    if (knot_of(m, m.mesh.to_vertex_handle(sheet.to_next)) != next) std::swap(sheet.to_next, sheet.to_previous);
    ends.push_back({m.mesh.to_vertex_handle(sheet.to_next).idx(), m.mesh.to_vertex_handle(sheet.to_previous).idx()});
    sheets.push_back(sheet);
  }
  std::sort(ends.begin(), ends.end());
  if (std::adjacent_find(ends.begin(), ends.end()) != ends.end()) sheets.clear();
  return sheets;
}

// The two links of a knot that is not fixed, as one curve from the previous to the next knot.
struct Passage {
  std::uint32_t to_next, to_previous;  // links
  std::uint32_t next, previous;        // knots
  double next_arc, previous_arc;
};

Passage passage(const WorkingMesh& m, std::uint32_t knot, std::uint32_t link) {
  const auto& links = m.knots[knot].links;
  const std::uint32_t other = links[links[0] == link ? 1 : 0];
  const WorkingMesh::Link &on = m.links[link], &back = m.links[other];
  const int i = 1 - on.side_of(knot), j = 1 - back.side_of(knot);
  return {link, other, on.ends[i], back.ends[j], on.arc[i], back.arc[j]};
}

bool may_become_straight(const WorkingMesh& m, const Passage& p, Aim aim) {
  const Point3 a = m.knots[p.previous].position, b = m.knots[p.next].position;
  const double size = length(b - a), wanted = m.wanted_length(p.previous, p.next);
  if (p.previous == p.next || size > longest(aim) * wanted) return false;
  if (m.features.curves[m.links[p.to_next].curve].deviation(p.previous_arc, p.next_arc) >
      (aim == Aim::length ? most_deviation * size : most_deviation_of_improved * std::max(size, wanted)))
    return false;
  return !are_joined(m, p.previous, p.next);
}

bool try_collapse_knot(WorkingMesh& m, std::uint32_t knot, std::uint32_t link, Aim aim) {
  if (m.knots[knot].is_fixed) return false;
  const Passage p = passage(m, knot, link);
  if (!may_become_straight(m, p, aim)) return false;
  const std::vector<Sheet> sheets = sheets_at(m, knot, p.next);
  if (sheets.size() != m.knots[knot].copies.size()) return false;
  for (const auto& [h, back] : sheets)
    if (m.at(m.mesh.from_vertex_handle(h)).is_frozen || !m.mesh.is_collapse_ok(h) ||
        would_join_knots(m, h, p.previous) || !has_good_result(m, h, aim) || !stays_near_surface(m, h, aim))
      return false;
  for (const auto& [h, back] : sheets) m.mesh.collapse(h);
  m.knots[knot].is_alive = false;
  m.knots[knot].copies.clear();
  m.links[p.to_next].is_alive = false;
  WorkingMesh::Link& joined = m.links[p.to_previous];
  const int end = joined.side_of(knot);
  joined.ends[end] = p.next;
  joined.arc[end] = p.next_arc;
  for (std::uint32_t& l : m.knots[p.next].links)
    if (l == p.to_next) {
      l = p.to_previous;
      break;
    }
  return true;
}

std::size_t collapse_links(WorkingMesh& m) {
  std::size_t done = 0;
  for (std::uint32_t l = 0; l < m.links.size(); ++l) {
    const auto [a, b] = m.links[l].ends;
    if (!m.links[l].is_alive) continue;
    if (length(m.knots[b].position - m.knots[a].position) >= too_short * m.wanted_length(a, b)) continue;
    done += try_collapse_knot(m, a, l, Aim::length) || try_collapse_knot(m, b, l, Aim::length);
  }
  return done;
}

std::size_t collapse_edges(WorkingMesh& m) {
  std::size_t done = 0;
  for (std::size_t i = 0; i < m.mesh.n_edges(); ++i) {
    const EdgeHandle e(static_cast<int>(i));
    if (m.mesh.status(e).deleted() || m.mesh.is_boundary(e)) continue;
    const HalfedgeHandle h = m.mesh.halfedge_handle(e, 0), back = m.mesh.halfedge_handle(e, 1);
    const VertexHandle a = m.mesh.from_vertex_handle(h), b = m.mesh.to_vertex_handle(h);
    if (m.edge_length(a, b) >= too_short * m.wanted_length(a, b)) continue;
    done += try_collapse(m, h, Aim::length) || try_collapse(m, back, Aim::length);
  }
  return done;
}

}  // namespace

void collapse_short_edges(WorkingMesh& m) {
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    const std::size_t done = collapse_links(m) + collapse_edges(m);
    if (done * 1000 <= m.vertices.size()) break;
  }
}

bool improve_by_collapse(WorkingMesh& m, HalfedgeHandle h) {
  const VertexHandle from = m.mesh.from_vertex_handle(h);
  if (!m.mesh.is_boundary(m.mesh.edge_handle(h))) return try_collapse(m, h, Aim::angle);
  const std::uint32_t knot = knot_of(m, from), to = knot_of(m, m.mesh.to_vertex_handle(h));
  for (const std::uint32_t l : m.knots[knot].links)
    if (m.links[l].ends[0] == to || m.links[l].ends[1] == to) return try_collapse_knot(m, knot, l, Aim::angle);
  return false;
}

}  // namespace ccdt
