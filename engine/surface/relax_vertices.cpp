#include <cmath>

#include "engine/surface/remesh_steps.h"
#include "engine/surface/surface_limits.h"

namespace ccdt {
namespace {

constexpr std::uint32_t none = WorkingMesh::none;
constexpr double good_quality = 0.5;
constexpr double bend_reach = 0.3;  // of the new edges' length

// May a vertex move to a point where the surface has that normal?
bool may_move(const WorkingMesh& m, VertexHandle v, const Point3& p, const Point3& normal) {
  WorstFit before, after;
  for (auto h = m.mesh.cvoh_iter(v); h.is_valid(); ++h) {
    if (m.mesh.is_boundary(*h)) continue;
    const auto [a, b, c] = corners_of(m, *h);
    before.add(fit_of(m, {a, b, c}));
    after.add(fit_of({p, m.point(b), m.point(c)}, {normal, m.at(b).normal, m.at(c).normal}));
  }
  return may_replace(before.worst, after.worst, good_quality);
}

bool edges_would_stay_near(const WorkingMesh& m, VertexHandle v, const Point3& p) {
  if (m.is_flat(v)) return true;
  for (auto n = m.mesh.cvv_iter(v); n.is_valid(); ++n)
    if (!is_near_surface(m, *n, p) && is_near_surface(m, *n, m.point(v))) return false;
  return true;
}

// The centre of the triangles around, by their areas in units of the wanted edge length.
Point3 centre_around(const WorkingMesh& m, VertexHandle v) {
  Point3 sum;
  double weights = 0;
  for (auto h = m.mesh.cvoh_iter(v); h.is_valid(); ++h) {
    const auto [a, b, c] = corners_of(m, *h);
    const Point3 centre = (1.0 / 3) * (m.point(a) + m.point(b) + m.point(c));
    const double wanted = m.at(a).wanted + m.at(b).wanted + m.at(c).wanted;
    const double weight = length(area_vector({m.point(a), m.point(b), m.point(c)})) / (wanted * wanted);
    sum = sum + weight * centre;
    weights += weight;
  }
  return weights > 0 ? (1 / weights) * sum : m.point(v);
}

void relax_vertex(WorkingMesh& m, VertexHandle v) {
  const Point3 p = m.point(v), normal = m.at(v).normal;
  const Point3 move = centre_around(m, v) - p;
  const Point3 tangential = move - dot(move, normal) * normal;
  for (const double step : {1.0, 0.5}) {
    const Foot foot = m.closest.on_patch(m.at(v).patch, p + step * tangential, m.at(v).near);
    // A foot beyond the step is on another sheet of the surface.
    if (foot.squared_distance > squared_length(step * tangential)) continue;
    const Point3 there = m.closest.normal_at(foot);
    if (!may_move(m, v, foot.point, there) || !edges_would_stay_near(m, v, foot.point)) continue;
    m.move(v, foot.point);
    m.at(v).near = foot.triangle;
    m.at(v).normal = there;
    return;
  }
}

struct NewCopy {
  std::uint32_t near;
  Point3 normal;
};

void relax_knot(WorkingMesh& m, std::uint32_t k) {
  WorkingMesh::Knot& knot = m.knots[k];
  WorkingMesh::Link &one = m.links[knot.links[0]], &other = m.links[knot.links[1]];
  const int i = one.side_of(k), j = other.side_of(k);
  const FeatureCurve& curve = m.features.curves[one.curve];
  const double reach = bend_reach * 0.5 * std::fabs(other.arc[1 - j] - one.arc[1 - i]);
  const double arc = curve.at_bend(0.5 * (one.arc[1 - i] + other.arc[1 - j]), reach);
  const Point3 p = curve.at(arc);
  std::vector<NewCopy> copies;
  for (const VertexHandle v : knot.copies) {
    const Foot foot = m.closest.on_patch(m.at(v).patch, p, m.at(v).near);
    copies.push_back({foot.triangle, m.closest.normal_at(foot)});
    if (m.at(v).is_frozen || !may_move(m, v, p, copies.back().normal)) return;
  }
  knot.position = p;
  one.arc[i] = other.arc[j] = arc;
  for (std::size_t c = 0; c < copies.size(); ++c) {
    m.move(knot.copies[c], p);
    m.at(knot.copies[c]).near = copies[c].near;
    m.at(knot.copies[c]).normal = copies[c].normal;
  }
}

}  // namespace

void relax_vertices(WorkingMesh& m) {
  for (std::uint32_t k = 0; k < m.knots.size(); ++k)
    if (m.knots[k].is_alive && !m.knots[k].is_fixed) relax_knot(m, k);
  for (const VertexHandle v : m.mesh.vertices())
    if (m.at(v).knot == none && !m.at(v).is_frozen) relax_vertex(m, v);
}

}  // namespace ccdt
