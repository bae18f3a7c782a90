#include "engine/surface/wanted_lengths.h"

#include <algorithm>
#include <queue>

#include "engine/surface/surface_limits.h"

namespace ccdt {
namespace {

constexpr std::uint32_t none = WorkingMesh::none;
constexpr double most_ratio = 2;      // of the wanted length to the shortest edge of a vertex
constexpr double most_turn = 0.42;    // radians, of the normals along an edge
constexpr double width_ratio = 1.15;  // of edges along a strip to its width: equilateral triangles fill it
constexpr double narrow_wedge = 0.5;  // its width by the distance from its tip

// None of these makes edges shorter than such a part of the usual length: slits may be as narrow as they like, and
// noise turns, too.
constexpr double least_by_curve = 0.02, least_by_width = 0.05, least_by_edge = 0.2, least_by_turn = 0.3;

double& wanted_at(WorkingMesh& m, VertexHandle v) {
  return m.at(v).knot == none ? m.at(v).wanted : m.knots[m.at(v).knot].wanted;
}

void limit(double& wanted, double most, double least) {
  wanted = std::min(wanted, std::max(most, least));
}

void limit_by_curves(WorkingMesh& m) {
  for (const WorkingMesh::Link& link : m.links) {
    if (!link.is_alive) continue;
    for (int i = 0; i < 2; ++i) {
      WorkingMesh::Knot& k = m.knots[link.ends[i]];
      limit(k.wanted, m.curve_lengths.at(link.curve, link.arc[i]), least_by_curve * m.lengths.at(k.position));
    }
  }
}

void limit_by_edges(WorkingMesh& m) {
  for (const EdgeHandle e : m.mesh.edges()) {
    const VertexHandle a = m.mesh.to_vertex_handle(m.mesh.halfedge_handle(e, 0));
    const VertexHandle b = m.mesh.to_vertex_handle(m.mesh.halfedge_handle(e, 1));
    const double edge = m.edge_length(a, b);
    double most = most_ratio * edge;
    const double turn = length(m.at(b).normal - m.at(a).normal);
    if (!m.is_flat(a) && turn > 0) {
      const double usual = std::min(m.lengths.at(m.point(a)), m.lengths.at(m.point(b)));
      most = std::min(most, std::max(edge * most_turn / turn, least_by_turn * usual));
    }
    for (const VertexHandle v : {a, b}) limit(wanted_at(m, v), most, least_by_edge * m.lengths.at(m.point(v)));
  }
}

bool are_linked(const WorkingMesh& m, std::uint32_t a, std::uint32_t b) {
  for (const std::uint32_t l : m.knots[a].links)
    if (m.links[l].ends[0] == b || m.links[l].ends[1] == b) return true;
  return false;
}

// Is a knot in reach of a corner that is also near to another knot? What lies between them there is no strip.
bool share_a_corner(const WorkingMesh& m, std::uint32_t a, std::uint32_t b) {
  const auto is_corner_near = [&](std::uint32_t corner, std::uint32_t k) {
    return m.knots[corner].is_fixed && (corner == k || are_linked(m, corner, k));
  };
  if (is_corner_near(a, b)) return true;
  for (const std::uint32_t l : m.knots[a].links)
    for (const std::uint32_t end : m.links[l].ends)
      if (is_corner_near(end, b)) return true;
  return false;
}

// Does a narrow wedge between two curves reach from a corner of both to a point? No edge length is small enough there.
bool is_in_narrow_wedge(const FeatureCurve& one, const FeatureCurve& other, const Point3& p, double width) {
  for (const Point3& end : {one.points.front(), one.points.back()})
    if ((end == other.points.front() || end == other.points.back()) && width < narrow_wedge * length(p - end))
      return true;
  return false;
}

std::uint32_t curve_between(const WorkingMesh& m, std::uint32_t a, std::uint32_t b) {
  for (const std::uint32_t l : m.knots[a].links)
    if (m.links[l].ends[0] == b || m.links[l].ends[1] == b) return m.links[l].curve;
  return none;
}

// Between features that are near to each other, edges along them as long as the strip is wide.
void limit_by_width(WorkingMesh& m) {
  for (const HalfedgeHandle h : m.mesh.halfedges()) {
    if (m.mesh.is_boundary(h) || !m.mesh.is_boundary(m.mesh.opposite_halfedge_handle(h))) continue;
    const auto [a, b, c] = corners_of(m, h);
    const std::array<std::uint32_t, 3> k = {m.at(a).knot, m.at(b).knot, m.at(c).knot};
    if (k[2] == none || share_a_corner(m, k[0], k[2]) || share_a_corner(m, k[1], k[2])) continue;
    if (are_linked(m, k[0], k[2]) || are_linked(m, k[1], k[2])) continue;
    const double width = length(area_vector({m.point(a), m.point(b), m.point(c)})) / m.edge_length(a, b);
    const FeatureCurve& curve = m.features.curves[curve_between(m, k[0], k[1])];
    const auto& links = m.knots[k[2]].links;
    if (std::any_of(links.begin(), links.end(), [&](std::uint32_t l) {
          return is_in_narrow_wedge(curve, m.features.curves[m.links[l].curve], m.point(c), width);
        }))
      continue;
    for (const std::uint32_t knot : k)
      limit(m.knots[knot].wanted, width_ratio * width, least_by_width * m.lengths.at(m.knots[knot].position));
  }
}

}  // namespace

// Dijkstra's algorithm from the smallest lengths on.
void find_wanted_lengths(WorkingMesh& m) {
  for (WorkingMesh::Knot& k : m.knots) k.wanted = m.lengths.at(k.position);
  for (const VertexHandle v : m.mesh.vertices()) m.at(v).wanted = m.lengths.at(m.point(v));
  limit_by_curves(m);
  limit_by_edges(m);
  limit_by_width(m);
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
      const double most = wanted + length_growth * m.edge_length(v, *n);
      if (most >= wanted_at(m, *n)) continue;
      wanted_at(m, *n) = most;
      if (m.at(*n).knot == none)
        queue.emplace(most, (*n).idx());
      else
        for (const VertexHandle copy : m.knots[m.at(*n).knot].copies) queue.emplace(most, copy.idx());
    }
  }
  for (const VertexHandle v : m.mesh.vertices()) m.at(v).wanted = wanted_at(m, v);
}

}  // namespace ccdt
