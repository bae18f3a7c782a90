#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/base/count_work.h"
#include "engine/surface/working_mesh.h"

namespace ccdt::surface {
namespace {

// A possible position of a vertex, with properties of the original surface there.
struct Spot {
  Point3 point;
  std::uint32_t near;
  Point3 normal;
};

// The spot at a foot on the original surface.
Spot spot_at(const WorkingMesh& m, const Foot& foot) {
  return {foot.point, foot.triangle, m.closest.normal_at(foot)};
}

Foot foot_of(const WorkingMesh& m, VertexHandle v, const Point3& p) {
  return m.closest.on_patch(m.at(v).patch, p, m.at(v).near);
}

// The worst of the affected triangles, before and after a change.
struct FitChange {
  WorstFit before, after;
};

// Adds the triangles around a vertex that would move to a spot.
void add_triangles_around(const WorkingMesh& m, VertexHandle v, const Spot& spot, TriangleMeasure measure,
                          FitChange& fit) {
  for (auto h = m.mesh.cvoh_iter(v); h.is_valid(); ++h) {
    if (m.mesh.is_boundary(*h)) continue;
    const auto [a, b, c] = m.corners(*h);
    fit.before.add(fit_of(m, {a, b, c}, measure));
    fit.after.add(fit_of({spot.point, m.point(b), m.point(c)}, {spot.normal, m.at(b).normal, m.at(c).normal}, measure));
  }
}

// Would all edges of the vertex be near the original surface, except those that are not near it now?
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

// The spots of a knot's copies for a point on its curve.
std::vector<Spot> spots_at(const WorkingMesh& m, std::uint32_t knot, const Point3& p) {
  std::vector<Spot> spots;
  for (const VertexHandle v : m.knots[knot].copies) {
    spots.push_back(spot_at(m, foot_of(m, v, p)));
    spots.back().point = p;
  }
  return spots;
}

void move_knot(WorkingMesh& m, std::uint32_t knot, const KnotOnCurve& at, double arc, const std::vector<Spot>& spots) {
  for (std::size_t i = 0; i < 2; ++i) m.links[at.links[i]].arc[at.sides[i]] = arc;
  m.knots[knot].position = m.features.curves[at.curve].at(arc);
  for (std::size_t c = 0; c < spots.size(); ++c) move_vertex(m, m.knots[knot].copies[c], spots[c]);
  ++work_done.vertices_moved;
}

// ---- Relaxation -----------------------------------------------------------------------------------------------------

bool may_relax(const WorkingMesh& m, VertexHandle v, const Spot& spot) {
  constexpr double good_quality = 0.5;
  FitChange fit;
  add_triangles_around(m, v, spot, TriangleMeasure::area, fit);
  return may_replace(fit.before.worst, fit.after.worst, good_quality);
}

// The center of the triangles around a vertex, weighted by their areas in units of the wanted edge length.
Point3 center_around(const WorkingMesh& m, VertexHandle v) {
  Point3 sum;
  double weights = 0;
  for (auto h = m.mesh.cvoh_iter(v); h.is_valid(); ++h) {
    const auto [a, b, c] = m.corners(*h);
    const Point3 center = (1.0 / 3) * (m.point(a) + m.point(b) + m.point(c));
    const double wanted = m.at(a).wanted + m.at(b).wanted + m.at(c).wanted;
    const double weight = length(area_vector(m.points({a, b, c}))) / (wanted * wanted);
    sum = sum + weight * center;
    weights += weight;
  }
  return weights > 0 ? (1 / weights) * sum : m.point(v);
}

void relax_vertex(WorkingMesh& m, VertexHandle v) {
  ++work_done.moves_tried;
  const Point3 p = m.point(v), normal = m.at(v).normal;
  const Point3 move = center_around(m, v) - p;
  const Point3 tangential = move - dot(move, normal) * normal;
  for (const double step : {1.0, 0.5}) {
    const Foot foot = foot_of(m, v, p + step * tangential);
    // A foot farther away than the step is on a different sheet of the surface.
    if (foot.squared_distance > squared_length(step * tangential)) continue;
    const Spot spot = spot_at(m, foot);
    if (!may_relax(m, v, spot) || !edges_would_stay_near(m, v, spot.point)) continue;
    move_vertex(m, v, spot);
    ++work_done.vertices_moved;
    return;
  }
}

// Moves a knot between its neighbors, so that both edges fit the wanted lengths equally well.
void relax_knot(WorkingMesh& m, std::uint32_t k) {
  ++work_done.moves_tried;
  constexpr double bend_reach = 0.3;  // of the new edges' length
  const KnotOnCurve at = on_curve(m, k);
  const FeatureCurve& curve = m.features.curves[at.curve];
  const double one = m.wanted_length(k, at.others[0]), other = m.wanted_length(k, at.others[1]);
  const double share = one / (one + other);
  const double whole = at.arcs[1] - at.arcs[0];
  const double arc =
      curve.at_bend(at.arcs[0] + share * whole, bend_reach * std::min(share, 1 - share) * std::fabs(whole));
  const std::vector<Spot> spots = spots_at(m, k, curve.at(arc));
  for (std::size_t c = 0; c < spots.size(); ++c) {
    const VertexHandle v = m.knots[k].copies[c];
    if (m.at(v).is_frozen || !may_relax(m, v, spots[c])) return;
  }
  move_knot(m, k, at, arc, spots);
}

// ---- Improvement ----------------------------------------------------------------------------------------------------

constexpr double first_step = 0.25, last_step = 0.01;  // as fractions of the mean edge around the vertex
constexpr int directions = 8;
constexpr double diagonal = 0.70710678118654752;  // sine of 45 degrees

// The smallest angle around a vertex at another position; less than 0 if a triangle is turned over there.
double angle_around(const WorkingMesh& m, VertexHandle v, const Point3& p) {
  double cosine = -1;
  const Point3 normal = m.at(v).normal;
  for (auto h = m.mesh.cvoh_iter(v); h.is_valid(); ++h) {
    if (m.mesh.is_boundary(*h)) continue;
    std::array<Point3, 3> corners = m.points(m.corners(*h));
    corners[0] = p;
    if (dot(area_vector(corners), normal) <= 0) return -1;
    cosine = std::max(cosine, largest_cosine(corners));
  }
  return portable::arc_cosine(cosine);
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
  const Point3 u = normalized(cross(normal, axis)), w = cross(normal, u);
  std::array<Point3, directions> result;
  for (int i = 0; i < directions; ++i) {
    constexpr std::array<double, directions> sines = {0, diagonal, 1, diagonal, 0, -diagonal, -1, -diagonal};
    result[i] = sines[(i + 2) % directions] * u + sines[i] * w;
  }
  return result;
}

// The best place in the tangent plane, by pattern search (Hooke and Jeeves 1961).
Point3 best_place(const WorkingMesh& m, VertexHandle v) {
  constexpr int most_steps = 16;
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
  ++work_done.moves_tried;
  const Spot spot = spot_at(m, foot_of(m, v, best_place(m, v)));
  FitChange fit;
  add_triangles_around(m, v, spot, TriangleMeasure::angle, fit);
  if (!is_better(fit.before.worst, fit.after.worst) || !edges_would_stay_near(m, v, spot.point)) return false;
  move_vertex(m, v, spot);
  ++work_done.vertices_moved;
  return true;
}

double angle_around(const WorkingMesh& m, const WorkingMesh::Knot& knot, const Point3& p) {
  double angle = to_radians(180);
  for (const VertexHandle v : knot.copies) angle = std::min(angle, angle_around(m, v, p));
  return angle;
}

// Would the links stay near enough to the curve, or at least as near as they are?
bool follows_curve(const WorkingMesh& m, std::uint32_t knot, const KnotOnCurve& at, double arc, double now) {
  const FeatureCurve& curve = m.features.curves[at.curve];
  const Point3 p = curve.at(arc);
  for (int i = 0; i < 2; ++i) {
    const double deviation = curve.deviation(arc, at.arcs[i]);
    const double size = std::max(length(m.knots[at.others[i]].position - p), m.wanted_length(knot, at.others[i]));
    const double most = std::min(m.deviation, most_deviation_of_improved * size);
    if (deviation > most && deviation > curve.deviation(now, at.arcs[i])) return false;
  }
  return true;
}

bool improve_knot(WorkingMesh& m, std::uint32_t k) {
  const WorkingMesh::Knot& knot = m.knots[k];
  if (knot.is_fixed || knot.copies.empty()) return false;
  for (const VertexHandle v : knot.copies)
    if (m.at(v).is_frozen) return false;
  ++work_done.moves_tried;
  const KnotOnCurve at = on_curve(m, k);
  const FeatureCurve& curve = m.features.curves[at.curve];
  const double now = m.links[at.links[0]].arc[at.sides[0]];
  const double reach = std::min(std::fabs(now - at.arcs[0]), std::fabs(at.arcs[1] - now));
  double best = now, angle = angle_around(m, knot, knot.position);
  for (double step = first_step; step >= last_step; step *= 0.5)
    for (const double arc : {best - step * reach, best + step * reach}) {
      const double there = angle_around(m, knot, curve.at(arc));
      if (there <= angle || !follows_curve(m, k, at, arc, now)) continue;
      best = arc;
      angle = there;
    }
  if (best == now) return false;
  const std::vector<Spot> spots = spots_at(m, k, curve.at(best));
  FitChange fit;
  for (std::size_t c = 0; c < spots.size(); ++c)
    add_triangles_around(m, knot.copies[c], spots[c], TriangleMeasure::angle, fit);
  if (!is_better(fit.before.worst, fit.after.worst)) return false;
  move_knot(m, k, at, best, spots);
  return true;
}

}  // namespace

void relax_vertices(WorkingMesh& m) {
  for (std::uint32_t k = 0; k < m.knots.size(); ++k)
    if (m.knots[k].is_alive && !m.knots[k].is_fixed) relax_knot(m, k);
  for (const VertexHandle v : m.mesh.vertices())
    if (m.at(v).knot == none && !m.at(v).is_frozen) relax_vertex(m, v);
}

bool improve_by_move(WorkingMesh& m, VertexHandle v) {
  if (m.at(v).knot != none) return improve_knot(m, m.at(v).knot);
  return !m.at(v).is_frozen && improve_vertex(m, v);
}

}  // namespace ccdt::surface
