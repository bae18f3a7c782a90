#include <cmath>

#include "engine/surface/improve_triangles.h"
#include "engine/surface/move_vertices.h"
#include "engine/surface/surface_limits.h"

namespace ccdt {
namespace {

constexpr double first_step = 0.25, last_step = 0.01;  // as fractions of the mean edge around the vertex
constexpr int directions = 8;
constexpr int most_steps = 16;

// The smallest angle around a vertex if that was elsewhere; less than 0 if a triangle was turned over there.
double angle_around(const WorkingMesh& m, VertexHandle v, const Point3& p) {
  double angle = radians(180);
  const Point3 normal = m.at(v).normal;
  for (auto h = m.mesh.cvoh_iter(v); h.is_valid(); ++h) {
    if (m.mesh.is_boundary(*h)) continue;
    const auto [a, b, c] = corners_of(m, *h);
    const std::array<Point3, 3> corners = {p, m.point(b), m.point(c)};
    if (dot(area_vector(corners), normal) <= 0) return -1;
    angle = std::min(angle, smallest_angle(corners));
  }
  return angle;
}

double mean_edge_around(const WorkingMesh& m, VertexHandle v) {
  double sum = 0;
  int count = 0;
  for (auto n = m.mesh.cvv_iter(v); n.is_valid(); ++n, ++count) sum += m.edge_length(v, *n);
  return sum / count;
}

std::array<Point3, directions> tangential_directions(const Point3& normal) {
  const Point3 size = {std::fabs(normal.x), std::fabs(normal.y), std::fabs(normal.z)};
  const Point3 axis = size.x <= size.y && size.x <= size.z ? Point3{1, 0, 0}
                      : size.y <= size.z                   ? Point3{0, 1, 0}
                                                           : Point3{0, 0, 1};
  const Point3 u = unit(cross(normal, axis)), w = cross(normal, u);
  std::array<Point3, directions> result;
  for (int i = 0; i < directions; ++i) {
    const double angle = radians(360.0 * i / directions);
    result[i] = std::cos(angle) * u + std::sin(angle) * w;
  }
  return result;
}

// In the tangent plane, by pattern search (Hooke and Jeeves 1961).
Point3 best_place(const WorkingMesh& m, VertexHandle v) {
  const std::array<Point3, directions> around = tangential_directions(m.at(v).normal);
  const double edge = mean_edge_around(m, v);
  Point3 best = m.point(v);
  double angle = angle_around(m, v, best);
  double step = first_step;
  for (int i = 0; i < most_steps && step >= last_step; ++i) {
    const Point3 center = best;
    bool any = false;
    for (const Point3& direction : around) {
      const Point3 p = center + step * edge * direction;
      const double there = angle_around(m, v, p);
      if (there <= angle) continue;
      best = p;
      angle = there;
      any = true;
    }
    if (!any) step *= 0.5;
  }
  return best;
}

bool improve_vertex(WorkingMesh& m, VertexHandle v) {
  const Point3 p = best_place(m, v);
  const Foot foot = m.closest.on_patch(m.at(v).patch, p, m.at(v).near);
  const Spot spot = {foot.point, foot.triangle, m.closest.normal_at(foot)};
  FitChange fit;
  add_triangles_around(m, v, spot, Shape::angle, fit);
  if (!is_better(fit.before.worst, fit.after.worst) || !edges_would_stay_near(m, v, spot.point)) return false;
  move_vertex(m, v, spot);
  return true;
}

double angle_around(const WorkingMesh& m, const WorkingMesh::Knot& knot, const Point3& p) {
  double angle = radians(180);
  for (const VertexHandle v : knot.copies) angle = std::min(angle, angle_around(m, v, p));
  return angle;
}

// Would the links still be as near to the curve as they have to be, or as they are?
bool follows_curve(const WorkingMesh& m, std::uint32_t knot, const KnotOnCurve& at, double arc, const Point3& p,
                   double now) {
  const FeatureCurve& curve = m.features.curves[at.curve];
  for (int i = 0; i < 2; ++i) {
    const double deviation = curve.deviation(arc, at.arcs[i]);
    const double size = std::max(length(m.knots[at.others[i]].position - p), m.wanted_length(knot, at.others[i]));
    if (deviation > most_deviation_of_improved * size && deviation > curve.deviation(now, at.arcs[i])) return false;
  }
  return true;
}

bool improve_knot(WorkingMesh& m, std::uint32_t k) {
  const WorkingMesh::Knot& knot = m.knots[k];
  if (knot.is_fixed || knot.copies.empty()) return false;
  for (const VertexHandle v : knot.copies)
    if (m.at(v).is_frozen) return false;
  const KnotOnCurve at = on_curve(m, k);
  const FeatureCurve& curve = m.features.curves[at.curve];
  const double now = m.links[at.links[0]].arc[at.sides[0]];
  const double reach = std::min(std::fabs(now - at.arcs[0]), std::fabs(at.arcs[1] - now));
  double best = now, angle = angle_around(m, knot, knot.position);
  for (double step = first_step; step >= last_step; step *= 0.5)
    for (const double arc : {best - step * reach, best + step * reach}) {
      const Point3 p = curve.at(arc);
      const double there = angle_around(m, knot, p);
      if (there <= angle || !follows_curve(m, k, at, arc, p, now)) continue;
      best = arc;
      angle = there;
    }
  if (best == now) return false;
  const Point3 p = curve.at(best);
  const std::vector<Spot> spots = spots_at(m, k, p);
  FitChange fit;
  for (std::size_t c = 0; c < spots.size(); ++c) add_triangles_around(m, knot.copies[c], spots[c], Shape::angle, fit);
  if (!is_better(fit.before.worst, fit.after.worst)) return false;
  move_knot(m, k, best, p, spots);
  return true;
}

}  // namespace

bool improve_by_move(WorkingMesh& m, VertexHandle v) {
  if (m.at(v).knot != WorkingMesh::none) return improve_knot(m, m.at(v).knot);
  return !m.at(v).is_frozen && improve_vertex(m, v);
}

}  // namespace ccdt
