#include "engine/surface/wanted_lengths.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <queue>
#include <utility>

#include "engine/surface/working_mesh.h"

namespace ccdt::surface {
namespace {

constexpr double step = 0.9;  // from one tried length to the next

// The longest edge at a point of a curve that stays near to it. An edge as long as a piece of the chain is always
// allowed: each bend may get a vertex.
double length_at(const FeatureCurve& curve, std::size_t i, double usual) {
  const double whole = curve.arc.back();
  const double before = i > 0 ? curve.arc[i] - curve.arc[i - 1] : 0;
  const double after = i + 1 < curve.arc.size() ? curve.arc[i + 1] - curve.arc[i] : 0;
  const double least = std::max(before, after);
  double edge = std::min(usual, whole);
  for (; edge > least; edge *= step) {
    const double from = std::clamp(curve.arc[i] - 0.5 * edge, 0.0, whole - edge);
    if (curve.deviation(from, from + edge) <= most_deviation * edge) break;
  }
  return std::min({std::max(edge, least), usual, whole});
}

constexpr double most_ratio = 2;       // of the wanted length to the shortest edge of a vertex
constexpr double most_turn = 0.42;     // radians, of the normals along an edge
constexpr double width_ratio = 1.15;   // of edges along a strip to its width: equilateral triangles fill it
constexpr double least_width = 0.002;  // of the usual length: narrower strips fit no allowed edge
constexpr double narrow_wedge = 0.5;   // its width over the distance from its tip

// None of these makes edges shorter than this fraction of the usual length: slits may be arbitrarily narrow, and noise
// has bends too.
constexpr double least_by_curve = 0.02, least_by_width = 0.05, least_by_edge = 0.2, least_by_turn = 0.3;

double& wanted_at(WorkingMesh& m, VertexHandle v) {
  return m.at(v).knot == none ? m.at(v).wanted : m.knots[m.at(v).knot].wanted;
}

void limit(double& wanted, double most, double least) {
  wanted = std::min(wanted, std::max(most, least));
}

void limit_from_below(double& wanted, double least) {
  wanted = std::max(wanted, least);
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

// Is there a corner that is at, or next to, each of two knots? Then the space between them is not a strip.
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

void limit_by_thickness(WorkingMesh& m) {
  for (const FaceHandle f : m.mesh.faces()) {
    if (m.is_frozen(f)) continue;
    const std::array<VertexHandle, 3> corners = m.corners(m.mesh.halfedge_handle(f));
    const double now = std::max({wanted_at(m, corners[0]), wanted_at(m, corners[1]), wanted_at(m, corners[2])});
    if (now <= m.thickness.least_wanted()) continue;
    const WorkingMesh::Vertex& first = m.at(corners[0]);
    const std::array<Point3, 3> p = m.points(corners);
    const Foot foot = m.closest.on_patch(first.patch, (1.0 / 3) * (p[0] + p[1] + p[2]), first.near);
    const double most = m.thickness.wanted_at(foot, now);
    for (const VertexHandle v : corners) limit(wanted_at(m, v), most, 0);
  }
}

/// Short edges at features may cost this many triangles, which lead to about a million tetrahedra. If they would cost
/// more, the shortest become longer.
constexpr double most_triangles_at_features = 40000;

/// The number of equilateral triangles of the wanted lengths, if none was below `least` except where the given length
/// is.
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

/// Makes the shortest wanted lengths longer until features cost no more triangles than they may.
void limit_count(WorkingMesh& m) {
  const double usual = m.lengths.usual();
  const double most = count_triangles(m, usual) + most_triangles_at_features;
  if (count_triangles(m, 0) <= most) return;
  double low = 0, least = usual;
  for (int i = 0; i < 10; ++i) {
    const double middle = 0.5 * (low + least);
    (count_triangles(m, middle) > most ? low : least) = middle;
  }
  for (const VertexHandle v : m.mesh.vertices())
    limit_from_below(m.at(v).wanted, std::min(least, m.lengths.at(m.point(v))));
  for (WorkingMesh::Knot& k : m.knots) limit_from_below(k.wanted, std::min(least, m.lengths.at(k.position)));
}

}  // namespace

double EdgeLengths::at(const Point3& p) const {
  double wanted = usual_;
  reaches_.for_each_meeting(box_of(p), [&](std::uint32_t i) {
    const Ball& ball = balls_[i];
    wanted = std::min(wanted, ball.wanted + length_growth * std::max(0.0, length(p - ball.center) - ball.radius));
  });
  return wanted;
}

void EdgeLengths::limit(const std::vector<Ball>& balls) {
  balls_.insert(balls_.end(), balls.begin(), balls.end());
  RawVector<Box> reaches;
  for (const Ball& ball : balls_)
    reaches.push_back(expanded(box_of(ball.center), ball.radius + std::max(0.0, usual_ - ball.wanted) / length_growth));
  reaches_ = BoxTree(std::move(reaches));
}

CurveLengths::CurveLengths(const FeatureCurves& features, double usual) : features_(features) {
  for (const FeatureCurve& curve : features.curves) {
    std::vector<double>& lengths = lengths_.emplace_back();
    for (std::size_t i = 0; i < curve.points.size(); ++i) lengths.push_back(length_at(curve, i, usual));
    for (std::size_t i = 1; i < lengths.size(); ++i)
      lengths[i] = std::min(lengths[i], lengths[i - 1] + length_growth * (curve.arc[i] - curve.arc[i - 1]));
    for (std::size_t i = lengths.size() - 1; i-- > 0;)
      lengths[i] = std::min(lengths[i], lengths[i + 1] + length_growth * (curve.arc[i + 1] - curve.arc[i]));
  }
}

double CurveLengths::at(std::uint32_t curve, double arc) const {
  const std::vector<double>& arcs = features_.curves[curve].arc;
  const auto after = std::upper_bound(arcs.begin() + 1, arcs.end() - 1, arc);
  const auto i = static_cast<std::size_t>(after - arcs.begin());
  const std::vector<double>& lengths = lengths_[curve];
  return std::min(lengths[i - 1] + length_growth * (arc - arcs[i - 1]), lengths[i] + length_growth * (arcs[i] - arc));
}

// The lengths spread from the smallest ones by Dijkstra's algorithm.
void find_wanted_lengths(WorkingMesh& m, bool is_remeshed) {
  for (WorkingMesh::Knot& k : m.knots) k.wanted = m.lengths.at(k.position);
  for (const VertexHandle v : m.mesh.vertices()) m.at(v).wanted = m.lengths.at(m.point(v));
  limit_by_curves(m);
  if (is_remeshed) {
    limit_by_edges(m);
    limit_by_width(m);
    limit_by_thickness(m);
  }
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
  limit_count(m);
}

}  // namespace ccdt::surface
