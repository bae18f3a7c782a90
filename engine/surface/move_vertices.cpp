#include "engine/surface/move_vertices.h"

#include "engine/surface/surface_limits.h"

namespace ccdt {

Spot spot_at(const WorkingMesh& m, VertexHandle v, const Point3& p) {
  const Foot foot = m.closest.on_patch(m.at(v).patch, p, m.at(v).near);
  return {p, foot.triangle, m.closest.normal_at(foot)};
}

void add_triangles_around(const WorkingMesh& m, VertexHandle v, const Spot& spot, Shape shape, FitChange& fit) {
  for (auto h = m.mesh.cvoh_iter(v); h.is_valid(); ++h) {
    if (m.mesh.is_boundary(*h)) continue;
    const auto [a, b, c] = corners_of(m, *h);
    fit.before.add(fit_of(m, {a, b, c}, shape));
    fit.after.add(fit_of({spot.point, m.point(b), m.point(c)}, {spot.normal, m.at(b).normal, m.at(c).normal}, shape));
  }
}

bool edges_would_stay_near(const WorkingMesh& m, VertexHandle v, const Point3& p) {
  if (m.is_flat(v)) return true;
  for (auto n = m.mesh.cvv_iter(v); n.is_valid(); ++n)
    if (!is_near_surface(m, *n, p) && is_near_surface(m, *n, m.point(v))) return false;
  return true;
}

void move_vertex(WorkingMesh& m, VertexHandle v, const Spot& spot) {
  m.move(v, spot.point);
  m.at(v).near = spot.near;
  m.at(v).normal = spot.normal;
}

KnotOnCurve on_curve(const WorkingMesh& m, std::uint32_t knot) {
  KnotOnCurve at = {};
  for (std::size_t i = 0; i < 2; ++i) {
    at.links[i] = m.knots[knot].links[i];
    const WorkingMesh::Link& link = m.links[at.links[i]];
    at.sides[i] = link.side_of(knot);
    at.others[i] = link.ends[1 - at.sides[i]];
    at.arcs[i] = link.arc[1 - at.sides[i]];
    at.curve = link.curve;
  }
  return at;
}

std::vector<Spot> spots_at(const WorkingMesh& m, std::uint32_t knot, const Point3& p) {
  std::vector<Spot> spots;
  for (const VertexHandle v : m.knots[knot].copies) spots.push_back(spot_at(m, v, p));
  return spots;
}

void move_knot(WorkingMesh& m, std::uint32_t knot, double arc, const Point3& p, const std::vector<Spot>& spots) {
  const KnotOnCurve at = on_curve(m, knot);
  for (std::size_t i = 0; i < 2; ++i) m.links[at.links[i]].arc[at.sides[i]] = arc;
  m.knots[knot].position = p;
  for (std::size_t c = 0; c < spots.size(); ++c) move_vertex(m, m.knots[knot].copies[c], spots[c]);
}

}  // namespace ccdt
