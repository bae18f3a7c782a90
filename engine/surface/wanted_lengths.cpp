#include "engine/surface/wanted_lengths.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "engine/sizes/budget.h"
#include "engine/sizes/walls.h"
#include "engine/surface/working_mesh.h"

namespace ccdt::surface {
namespace {

constexpr double shortening = 0.9;  // from one tried length to the next

// The longest edge at a point of a curve that stays near the curve. An edge as long as a piece of the chain is always
// allowed: each bend may get a vertex.
double length_at(const FeatureCurve& curve, std::size_t i, double usual, double deviation) {
  const double whole = curve.arc.back();
  const double before = i > 0 ? curve.arc[i] - curve.arc[i - 1] : 0;
  const double after = i + 1 < curve.arc.size() ? curve.arc[i + 1] - curve.arc[i] : 0;
  const double least = std::max(before, after);
  double edge = std::min(usual, whole);
  for (; edge > least; edge *= shortening) {
    const double from = std::clamp(curve.arc[i] - 0.5 * edge, 0.0, whole - edge);
    if (curve.deviation(from, from + edge) <= std::min(deviation, most_deviation * edge)) break;
  }
  return std::min({std::max(edge, least), usual, whole});
}

constexpr double most_ratio = 2;       // of the wanted length to the shortest edge of a vertex
constexpr double most_turn = 0.42;     // radians, of the normals along an edge
constexpr double width_ratio = 1.15;   // of edges along a strip to its width: equilateral triangles fill it
constexpr double least_width = 0.002;  // of the usual length: no allowed edge fits narrower strips
constexpr double least_wall = 0.01;    // of the usual length: thinner walls would need too many edges
constexpr double narrow_wedge = 0.5;   // its width over the distance from its tip

// None of these rules makes edges shorter than this fraction of the usual length: slits may be arbitrarily narrow, and
// noise bends surfaces too.
constexpr double least_by_curve = 0.02, least_by_width = 0.05, least_by_wall = 0.15, least_by_edge = 0.2,
                 least_by_turn = 0.3;

double& wanted_at(WorkingMesh& m, VertexHandle v) {
  return m.at(v).knot == none ? m.at(v).wanted : m.knots[m.at(v).knot].wanted;
}

void limit(double& wanted, double most, double least) {
  wanted = std::min(wanted, std::max(most, least));
}

/// On a circle, the middles of equilateral triangles are not farther away than the wanted deviation.
void limit_by_deviation(WorkingMesh& m) {
  if (m.deviation == HUGE_VAL) return;
  for (const EdgeHandle e : m.mesh.edges()) {
    const auto [a, b] = m.ends(e);
    // At a feature, the nearest facet may be one beyond it; elsewhere, interpolated normals turn even within a facet.
    if (m.at(a).knot != none || m.at(b).knot != none || m.is_flat(a)) continue;
    const auto& normals = m.original.triangle_normals;
    const double turn = length(normals[m.at(b).near] - normals[m.at(a).near]);
    if (turn == 0) continue;
    const double most = std::sqrt(6 * m.deviation * m.edge_length(a, b) / turn);
    for (const VertexHandle v : {a, b}) limit(m.at(v).wanted, most, 4 * m.deviation);
  }
}

void limit_by_edges(WorkingMesh& m) {
  for (const EdgeHandle e : m.mesh.edges()) {
    const auto [a, b] = m.ends(e);
    const double edge = m.edge_length(a, b);
    double most = most_ratio * edge;
    const double turn = length(m.at(b).normal - m.at(a).normal);
    if (!m.is_flat(a) && !m.is_tip(a) && !m.is_tip(b) && turn > 0) {
      const double usual = std::min(m.lengths.at(m.point(a)), m.lengths.at(m.point(b)));
      most = std::min(most, std::max(edge * most_turn / turn, least_by_turn * usual));
    }
    for (const VertexHandle v : {a, b}) limit(wanted_at(m, v), most, least_by_edge * m.lengths.at(m.point(v)));
  }
}

// Is some corner at, or next to, each of the two knots? Then the space between them is not a strip.
bool share_a_corner(const WorkingMesh& m, std::uint32_t a, std::uint32_t b) {
  const auto is_corner_near = [&](std::uint32_t corner, std::uint32_t k) {
    return m.knots[corner].is_fixed && (corner == k || link_between(m, corner, k) != none);
  };
  if (is_corner_near(a, b)) return true;
  for (const std::uint32_t l : m.knots[a].links)
    for (const std::uint32_t end : m.links[l].ends)
      if (is_corner_near(end, b)) return true;
  return false;
}

// Is a point in a narrow wedge between two curves that meet at a corner? No edge length is small enough there.
bool is_in_narrow_wedge(const FeatureCurve& one, const FeatureCurve& other, const Point3& p, double width) {
  for (const Point3& end : {one.points.front(), one.points.back()})
    if ((end == other.points.front() || end == other.points.back()) && width < narrow_wedge * length(p - end))
      return true;
  return false;
}

// Between features near each other, edges are as long as the strip is wide.
void limit_by_width(WorkingMesh& m) {
  for (const HalfedgeHandle h : m.mesh.halfedges()) {
    if (m.mesh.is_boundary(h) || !m.mesh.is_boundary(m.mesh.opposite_halfedge_handle(h))) continue;
    const std::array<VertexHandle, 3> v = m.corners(h);
    const std::array<std::uint32_t, 3> k = {m.at(v[0]).knot, m.at(v[1]).knot, m.at(v[2]).knot};
    if (k[2] == none || share_a_corner(m, k[0], k[2]) || share_a_corner(m, k[1], k[2])) continue;
    if (link_between(m, k[0], k[2]) != none || link_between(m, k[1], k[2]) != none) continue;
    const double width = length(area_vector(m.points(v))) / m.edge_length(v[0], v[1]);
    if (width < least_width * m.lengths.at(m.point(v[2]))) continue;
    const FeatureCurve& curve = m.features.curves[m.links[link_between(m, k[0], k[1])].curve];
    const auto& links = m.knots[k[2]].links;
    if (std::any_of(links.begin(), links.end(), [&](std::uint32_t l) {
          return is_in_narrow_wedge(curve, m.features.curves[m.links[l].curve], m.point(v[2]), width);
        }))
      continue;
    for (const std::uint32_t knot : k)
      limit(m.knots[knot].wanted, width_ratio * width, least_by_width * m.lengths.at(m.knots[knot].position));
  }
}

/// The number of equilateral triangles of the wanted lengths, if these were at least `least`, except where the given
/// length is less.
double count_triangles(const WorkingMesh& m, double least) {
  double count = 0;
  for (const FaceHandle f : m.mesh.faces()) {
    const std::array<VertexHandle, 3> v = m.corners(m.mesh.halfedge_handle(f));
    const double wanted = (m.at(v[0]).wanted + m.at(v[1]).wanted + m.at(v[2]).wanted) / 3;
    const double edge = std::max(wanted, std::min(least, m.lengths.at(m.point(v[0]))));
    count += 2 / std::sqrt(3.0) * length(area_vector(m.points(v))) / (edge * edge);
  }
  return count;
}

/// Makes the shortest wanted lengths longer until features do not cost too many triangles.
void limit_count(WorkingMesh& m) {
  const double usual = m.lengths.largest();
  const double even = count_triangles(m, usual), most = even + sizes::affordable_triangles(even);
  double shortest = usual;
  for (const VertexHandle v : m.mesh.vertices()) shortest = std::min(shortest, m.at(v).wanted);
  const double least =
      sizes::least_affordable(shortest, usual, [&](double limit) { return count_triangles(m, limit) <= most; });
  const auto raise = [&](double& wanted, const Point3& p) {
    wanted = std::max(wanted, std::min(least, m.lengths.at(p)));
  };
  for (const VertexHandle v : m.mesh.vertices()) raise(m.at(v).wanted, m.point(v));
  for (WorkingMesh::Knot& k : m.knots) raise(k.wanted, k.position);
}

/// The places where a solid, or a gap between curved sheets, is thin.
std::vector<sizes::SizedPlace> find_walls(const plc::Plc& plc, const OriginalSurface& surface, double usual) {
  // Edges at a gap are chords and must not cross.
  constexpr double of_solid = 2, of_gap = 4;
  // A wedge that opens faster than edges may grow (`length_growth`) is not a thin place: the sine of the angle of that
  // slope is 0.287.
  constexpr double least_cosine = 0.958;
  const double unit = plc.grid.unit;
  std::vector<bool> is_curved(plc.facets.size());
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    is_curved[surface.facet_of[t]] = surface.patch_is_flat[surface.patch_of[t]] == 0;
  sizes::WallRules rules{usual / unit, {}, least_by_wall * usual / unit, least_wall * usual / unit, least_cosine};
  for (std::size_t f = 0; f < plc.facets.size(); ++f) {
    const auto ratio = [&](RegionId beside) {
      return plc.regions[beside].inside ? of_solid : is_curved[f] ? of_gap : 0;
    };
    rules.ratios.push_back({ratio(plc.facets[f].above), ratio(plc.facets[f].below)});
  }
  sizes::Walls walls(plc, std::move(rules));
  std::vector<sizes::SizedPlace> places;
  walls.measure(0, places);
  for (sizes::SizedPlace& p : places) p = {box_of(plc.grid.to_world(p.box.low)), unit * p.size};
  return places;
}

}  // namespace

sizes::SizeField lengths_of_shape(const plc::Plc& plc, const OriginalSurface& surface, const FeatureCurves& features,
                                  double usual, double deviation) {
  std::vector<sizes::SizedPlace> places = find_walls(plc, surface, usual);
  for (const FeatureCurve& curve : features.curves)
    for (std::size_t i = 0; i < curve.points.size(); ++i)
      places.push_back(
          {box_of(curve.points[i]), std::max(length_at(curve, i, usual, deviation), least_by_curve * usual)});
  return {usual, length_growth, places};
}

void find_wanted_lengths(WorkingMesh& m, bool is_remeshed) {
  const auto wanted_by_shape = [&](const Point3& p) { return m.shape.at(p, m.lengths.at(p)); };
  for (WorkingMesh::Knot& k : m.knots) k.wanted = wanted_by_shape(k.position);
  for (const VertexHandle v : m.mesh.vertices()) m.at(v).wanted = wanted_by_shape(m.point(v));
  if (is_remeshed) {
    limit_by_edges(m);
    limit_by_width(m);
    limit_by_deviation(m);
    // From there, the lengths grow.
    std::vector<sizes::SizedPlace> places;
    for (const VertexHandle v : m.mesh.vertices())
      if (wanted_at(m, v) < m.lengths.largest()) places.push_back({box_of(m.point(v)), wanted_at(m, v)});
    const sizes::SizeField field(m.lengths.largest(), length_growth, places);
    for (WorkingMesh::Knot& k : m.knots) k.wanted = field.at(k.position, k.wanted);
    for (const VertexHandle v : m.mesh.vertices()) m.at(v).wanted = field.at(m.point(v), m.at(v).wanted);
  }
  for (const VertexHandle v : m.mesh.vertices()) m.at(v).wanted = wanted_at(m, v);
  limit_count(m);
  if (is_remeshed) limit_by_deviation(m);  // it must hold, however many triangles that takes
}

}  // namespace ccdt::surface
