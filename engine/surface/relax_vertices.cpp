#include <cmath>

#include "engine/surface/move_vertices.h"
#include "engine/surface/remesh_steps.h"
#include "engine/surface/surface_limits.h"

namespace ccdt {
namespace {

constexpr std::uint32_t none = WorkingMesh::none;
constexpr double good_quality = 0.5;
constexpr double bend_reach = 0.3;  // of the new edges' length

bool may_move(const WorkingMesh& m, VertexHandle v, const Spot& spot) {
  FitChange fit;
  add_triangles_around(m, v, spot, Shape::area, fit);
  return may_replace(fit.before.worst, fit.after.worst, good_quality);
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
    const Spot spot = {foot.point, foot.triangle, m.closest.normal_at(foot)};
    if (!may_move(m, v, spot) || !edges_would_stay_near(m, v, spot.point)) continue;
    move_vertex(m, v, spot);
    return;
  }
}

// Between its neighbours, so that both edges fit the wanted lengths alike.
void relax_knot(WorkingMesh& m, std::uint32_t k) {
  const KnotOnCurve at = on_curve(m, k);
  const FeatureCurve& curve = m.features.curves[at.curve];
  const double one = m.wanted_length(k, at.others[0]), other = m.wanted_length(k, at.others[1]);
  const double share = one / (one + other);
  const double whole = at.arcs[1] - at.arcs[0];
  const double arc =
      curve.at_bend(at.arcs[0] + share * whole, bend_reach * std::min(share, 1 - share) * std::fabs(whole));
  const Point3 p = curve.at(arc);
  const std::vector<Spot> spots = spots_at(m, k, p);
  for (std::size_t c = 0; c < spots.size(); ++c) {
    const VertexHandle v = m.knots[k].copies[c];
    if (m.at(v).is_frozen || !may_move(m, v, spots[c])) return;
  }
  move_knot(m, k, arc, p, spots);
}

}  // namespace

void relax_vertices(WorkingMesh& m) {
  for (std::uint32_t k = 0; k < m.knots.size(); ++k)
    if (m.knots[k].is_alive && !m.knots[k].is_fixed) relax_knot(m, k);
  for (const VertexHandle v : m.mesh.vertices())
    if (m.at(v).knot == none && !m.at(v).is_frozen) relax_vertex(m, v);
}

}  // namespace ccdt
