#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

#include "engine/base/count_work.h"
#include "engine/surface/working_mesh.h"

namespace ccdt::surface {
namespace {

// Edges are split above and collapsed below these multiples of the wanted length (Botsch and Kobbelt 2004).
constexpr double too_long = 4.0 / 3, too_short = 4.0 / 5;

// Triangles of this quality are good enough after a change.
constexpr double good_after_split = 0.1, good_after_collapse = 0.2, good_after_flip = 0.3;

bool touches_frozen_face(const WorkingMesh& m, EdgeHandle e) {
  for (unsigned side = 0; side < 2; ++side) {
    const HalfedgeHandle h = m.mesh.halfedge_handle(e, side);
    if (!m.mesh.is_boundary(h) && m.is_frozen(m.mesh.face_handle(h))) return true;
  }
  return false;
}

// ---- Splits ---------------------------------------------------------------------------------------------------------

// Is the first edge of a triangle its longest, or nearly so?
bool starts_at_longest_edge(const std::array<Point3, 3>& p) {
  constexpr double much_longer = 1.21;  // squared
  const double most = much_longer * squared_length(p[1] - p[0]);
  return squared_length(p[2] - p[1]) <= most && squared_length(p[0] - p[2]) <= most;
}

// May the triangles at an edge be split with the new vertex at a point where the surface has that normal?
bool may_split(const WorkingMesh& m, EdgeHandle e, const Point3& p, const Point3& normal) {
  // If only longest edges are split, angles stay above half the least angle (Rivara 1984), and flips then repair the
  // needles. Splitting other edges would turn needles into thinner needles forever.
  constexpr double least_part_at_longest = 0.5;
  double least_part = least_part_at_longest;
  WorstFit before, after;
  for (unsigned side = 0; side < 2; ++side) {
    const HalfedgeHandle h = m.mesh.halfedge_handle(e, side);
    if (m.mesh.is_boundary(h)) continue;
    const auto [a, b, c] = m.corners(h);
    if (!starts_at_longest_edge(m.points({a, b, c}))) least_part = 1;
    before.add(fit_of(m, {a, b, c}));
    after.add(fit_of({m.point(a), p, m.point(c)}, {m.at(a).normal, normal, m.at(c).normal}));
    after.add(fit_of({p, m.point(b), m.point(c)}, {normal, m.at(b).normal, m.at(c).normal}));
  }
  return may_replace({least_part * before.worst.quality, before.worst.agreement}, after.worst, good_after_split);
}

// The wanted length in the middle of an edge, from those at its ends. A long edge between short ones does not need
// short edges all along it.
double wanted_between(const WorkingMesh& m, const Point3& middle, double one, double other, double size) {
  return std::min(m.lengths.at(middle), std::min(one, other) + length_growth * 0.5 * size);
}

// The edges that splits may have affected: those of the triangles around new vertices.
using ChangedEdges = std::vector<EdgeHandle>;

void split(WorkingMesh& m, EdgeHandle e, VertexHandle v, ChangedEdges& changed) {
  m.mesh.split(e, v);
  ++work_done.edges_split;
  m.face_is_frozen.resize(m.mesh.n_faces(), 0);
  for (auto h = m.mesh.cvoh_iter(v); h.is_valid(); ++h) {
    changed.emplace_back(m.mesh.edge_handle(*h).idx());
    if (!m.mesh.is_boundary(*h)) changed.emplace_back(m.mesh.edge_handle(m.mesh.next_halfedge_handle(*h)).idx());
  }
}

// Splits an edge at the point of the original surface nearest to its middle. If that is not allowed, the middle itself
// is tried: it lies on the current surface.
bool try_split(WorkingMesh& m, EdgeHandle e, ChangedEdges& changed) {
  constexpr double most_step = 0.25;  // from a new vertex to the original surface, as a fraction of the edge's length
  const auto [a, b] = m.ends(e);
  const std::uint32_t patch = m.at(a).patch;
  const Point3 middle = m.point(a) + 0.5 * (m.point(b) - m.point(a));
  Foot foot = m.closest.on_patch(patch, middle, m.at(a).near);
  const Point3 normal = m.closest.normal_at(foot);
  const bool is_near = foot.squared_distance <= most_step * most_step * squared_length(m.point(b) - m.point(a));
  if (!is_near || !may_split(m, e, foot.point, normal)) {
    if (!may_split(m, e, middle, normal)) return false;
    foot.point = middle;
  }
  const double wanted = wanted_between(m, middle, m.at(a).wanted, m.at(b).wanted, m.edge_length(a, b));
  split(m, e, add_vertex(m, patch, foot, wanted), changed);
  return true;
}

bool try_split_link(WorkingMesh& m, std::uint32_t l, ChangedEdges& changed) {
  const WorkingMesh::Link link = m.links[l];
  const double arc = 0.5 * (link.arc[0] + link.arc[1]);
  const Point3 p = m.features.curves[link.curve].at(arc);
  const std::vector<EdgeHandle> edges = copies_of_link(m, l);
  for (const EdgeHandle e : edges) {
    const WorkingMesh::Vertex& end = m.at(m.ends(e)[0]);
    const Point3 normal = m.closest.normal_at(m.closest.on_patch(end.patch, p, end.near));
    if (touches_frozen_face(m, e) || !may_split(m, e, p, normal)) return false;
  }
  const auto knot = static_cast<std::uint32_t>(m.knots.size());
  const auto new_link = static_cast<std::uint32_t>(m.links.size());
  const auto [a, b] = link.ends;
  const double wanted = wanted_between(m, p, m.knots[a].wanted, m.knots[b].wanted, m.link_length(link));
  m.knots.push_back({p, false, {l, new_link}, {}, wanted});
  m.links.push_back({{knot, link.ends[1]}, link.curve, {arc, link.arc[1]}});
  m.links[l].ends[1] = knot;
  m.links[l].arc[1] = arc;
  m.knots[link.ends[1]].replace_link(l, new_link);
  for (const EdgeHandle e : edges) {
    const WorkingMesh::Vertex end = m.at(m.ends(e)[0]);
    split(m, e, add_copy(m, end.patch, knot, end.near), changed);
  }
  return true;
}

// The corners of the triangles at some edges. Together with the positions of the vertices, they decide whether the
// edges may be split.
std::vector<int> corners_around(const WorkingMesh& m, const std::vector<EdgeHandle>& edges) {
  std::vector<int> corners;
  for (const EdgeHandle e : edges)
    for (unsigned side = 0; side < 2; ++side) {
      const HalfedgeHandle h = m.mesh.halfedge_handle(e, side);
      if (m.mesh.is_boundary(h)) continue;
      for (const VertexHandle v : m.corners(h)) corners.push_back(v.idx());
    }
  return corners;
}

// Splits long edges. A failed attempt is repeated only after a triangle at the edge has changed.
class LongEdgeSplitter {
 public:
  explicit LongEdgeSplitter(WorkingMesh& m) : m_(m) {
    for (const EdgeHandle e : m.mesh.edges()) open_.push_back(e);
  }

  // New links are added at the end of the list; halves that are still too long are found in the next sweep.
  void split_links() {
    std::size_t count = 0;
    while (count != m_.links.size()) {
      count = m_.links.size();
      for (std::uint32_t l = 0; l < count; ++l) {
        const WorkingMesh::Link& link = m_.links[l];
        if (!link.is_alive || m_.link_length(link) <= too_long * m_.wanted_length(link.ends[0], link.ends[1])) continue;
        try_if_changed(failed_links_[l], copies_of_link(m_, l), [&] { return try_split_link(m_, l, open_); });
      }
    }
  }

  void split_inner_edges() {
    for (std::size_t count = 0; count != m_.mesh.n_edges();) {
      count = m_.mesh.n_edges();
      const std::vector<std::pair<double, EdgeHandle>> edges = long_edges();
      open_.clear();
      for (const auto& [negative_length, e] : edges) {
        const bool is_split =
            try_if_changed(failed_edges_[e.idx()], {e}, [&, edge = e] { return try_split(m_, edge, open_); });
        if (!is_split) open_.push_back(e);
      }
    }
  }

 private:
  // \param corners  of the triangles around the edges when they could not be split
  // \return         whether they were split
  template <class Try>
  bool try_if_changed(std::vector<int>& corners, const std::vector<EdgeHandle>& edges, const Try& run) {
    std::vector<int> now = corners_around(m_, edges);
    if (!now.empty() && corners == now) return false;
    if (run()) return true;
    corners = std::move(now);
    return false;
  }

  // The longest first, sorted by negative lengths: then each split edge is the longest of its triangles, which keeps
  // their angles (Rivara 1984).
  std::vector<std::pair<double, EdgeHandle>> long_edges() const {
    std::vector<std::pair<double, EdgeHandle>> found;
    for (const EdgeHandle e : open_) {
      if (m_.mesh.is_boundary(e) || touches_frozen_face(m_, e)) continue;
      const auto [a, b] = m_.ends(e);
      const double edge = m_.edge_length(a, b);
      if (edge > too_long * m_.wanted_length(a, b)) found.emplace_back(-edge, e);
    }
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
  }

  WorkingMesh& m_;
  ChangedEdges open_;  // edges that may be too long: at first all, then those that changed or could not be split
  std::unordered_map<int, std::vector<int>> failed_edges_, failed_links_;  // the corners around them at that time
};

// ---- Collapses ------------------------------------------------------------------------------------------------------

// The purpose of a collapse: to remove short edges, or to improve the worst triangle around it.
struct CollapseAim {
  TriangleMeasure measure;
  double longest;         // edge that it may make, in units of the wanted length
  double most_deviation;  // of the edges that it makes
};
constexpr CollapseAim no_short_edges = {TriangleMeasure::area, too_long, most_deviation};
constexpr CollapseAim better_triangles = {TriangleMeasure::angle, 1.3 * too_long, most_deviation_of_improved};

// Is this one of the (one or two) vertices opposite the halfedge's edge?
bool is_apex(const WorkingMesh& m, HalfedgeHandle h, VertexHandle v) {
  for (const HalfedgeHandle side : {h, m.mesh.opposite_halfedge_handle(h)})
    if (!m.mesh.is_boundary(side) && m.corners(side)[2] == v) return true;
  return false;
}

// Would collapsing the start of the halfedge to its end duplicate edges? The halfedge mesh sees only duplicates in the
// same wedge.
bool would_join_knots(const WorkingMesh& m, HalfedgeHandle h, std::uint32_t along_link) {
  const auto [from, to] = m.ends(h);
  if (m.at(to).knot == none) return false;
  for (auto n = m.mesh.cvv_iter(from); n.is_valid(); ++n) {
    const std::uint32_t knot = m.at(*n).knot;
    if (knot == none || *n == to || is_apex(m, h, *n)) continue;
    if (knot == m.at(to).knot) return true;
    if (knot != along_link && are_joined(m, knot, m.at(to).knot)) return true;
  }
  return false;
}

// May there be an edge between n and `to` instead of the one between n and `from`? To improve bad triangles, an edge
// may be replaced even by one that is not better.
bool may_have_edge(const WorkingMesh& m, VertexHandle n, VertexHandle to, VertexHandle from, const CollapseAim& aim) {
  const bool may_be_alike = aim.measure == TriangleMeasure::angle;
  const double size = m.edge_length(n, to);
  if (size > aim.longest * m.wanted_length(n, to) && (!may_be_alike || size > m.edge_length(n, from))) return false;
  return runs_along_surface(m, n, to) || (may_be_alike && !runs_along_surface(m, n, from));
}

// Are the triangles and edges that the collapse would make good enough?
bool has_good_result(const WorkingMesh& m, HalfedgeHandle h, const CollapseAim& aim) {
  const auto [from, to] = m.ends(h);
  WorstFit before, after;
  for (auto out = m.mesh.cvoh_iter(from); out.is_valid(); ++out) {
    const VertexHandle n = m.mesh.to_vertex_handle(*out);
    if (n != to && !is_apex(m, h, n) && !may_have_edge(m, n, to, from, aim)) return false;
    if (m.mesh.is_boundary(*out)) continue;
    if (m.is_frozen(m.mesh.face_handle(*out))) return false;
    auto v = m.corners(*out);
    before.add(fit_of(m, v, aim.measure));
    if (v[1] == to || v[2] == to) continue;
    v[0] = to;
    after.add(fit_of(m, v, aim.measure));
  }
  return aim.measure == TriangleMeasure::angle ? is_better(before.worst, after.worst)
                                               : may_replace(before.worst, after.worst, good_after_collapse);
}

bool stays_near_surface(const WorkingMesh& m, HalfedgeHandle h, const CollapseAim& aim) {
  const auto [from, to] = m.ends(h);
  for (auto n = m.mesh.cvv_iter(from); n.is_valid(); ++n) {
    if (*n == to || is_apex(m, h, *n) || is_near_surface(m, *n, m.point(to), aim.most_deviation)) continue;
    if (aim.measure == TriangleMeasure::area || is_near_surface(m, *n, from)) return false;
  }
  return true;
}

// \param along_link  the previous knot on the curve of the start, if it is on one
bool may_collapse(WorkingMesh& m, HalfedgeHandle h, std::uint32_t along_link, const CollapseAim& aim) {
  return !m.at(m.mesh.from_vertex_handle(h)).is_frozen && m.mesh.is_collapse_ok(h) &&
         !would_join_knots(m, h, along_link) && has_good_result(m, h, aim) && stays_near_surface(m, h, aim);
}

bool try_collapse(WorkingMesh& m, HalfedgeHandle h, const CollapseAim& aim) {
  if (m.at(m.mesh.from_vertex_handle(h)).knot != none || !may_collapse(m, h, none, aim)) return false;
  m.mesh.collapse(h);
  ++work_done.edges_collapsed;
  return true;
}

// The halfedge to the next knot from each copy of a knot that is not fixed. Nothing if two copies have the same two
// neighbors along the curve: the collapse would merge their edges.
std::vector<HalfedgeHandle> halfedges_to(const WorkingMesh& m, std::uint32_t next, std::uint32_t knot) {
  std::vector<HalfedgeHandle> halfedges;
  std::vector<std::array<int, 2>> ends;
  for (const VertexHandle copy : m.knots[knot].copies) {
    HalfedgeHandle to_next = m.mesh.halfedge_handle(copy);  // on the boundary, as OpenMesh promises
    HalfedgeHandle to_previous = m.mesh.opposite_halfedge_handle(m.mesh.prev_halfedge_handle(to_next));
    if (m.at(m.mesh.to_vertex_handle(to_next)).knot != next) std::swap(to_next, to_previous);
    ends.push_back({m.mesh.to_vertex_handle(to_next).idx(), m.mesh.to_vertex_handle(to_previous).idx()});
    halfedges.push_back(to_next);
  }
  std::sort(ends.begin(), ends.end());
  if (std::adjacent_find(ends.begin(), ends.end()) != ends.end()) halfedges.clear();
  return halfedges;
}

// May the two links of a knot become one?
bool may_become_straight(const WorkingMesh& m, const KnotOnCurve& at, const CollapseAim& aim) {
  const auto [a, b] = at.others;
  const double size = length(m.knots[b].position - m.knots[a].position), wanted = m.wanted_length(a, b);
  if (a == b || size > aim.longest * wanted) return false;
  const double reference = aim.measure == TriangleMeasure::area ? size : std::max(size, wanted);
  const double most = std::min(m.deviation, aim.most_deviation * reference);
  if (m.features.curves[at.curve].deviation(at.arcs[0], at.arcs[1]) > most) return false;
  return !are_joined(m, a, b);
}

// Collapses the knot along its link to the knot at the other end.
bool try_collapse_knot(WorkingMesh& m, std::uint32_t knot, std::uint32_t link, const CollapseAim& aim) {
  if (m.knots[knot].is_fixed) return false;
  const KnotOnCurve at = on_curve(m, knot);
  if (!may_become_straight(m, at, aim)) return false;
  const int i = at.links[0] == link ? 0 : 1;
  const std::uint32_t next = at.others[i], previous = at.others[1 - i];
  const std::vector<HalfedgeHandle> halfedges = halfedges_to(m, next, knot);
  if (halfedges.size() != m.knots[knot].copies.size()) return false;
  for (const HalfedgeHandle h : halfedges)
    if (!may_collapse(m, h, previous, aim)) return false;
  for (const HalfedgeHandle h : halfedges) m.mesh.collapse(h);
  work_done.edges_collapsed += halfedges.size();
  m.knots[knot].is_alive = false;
  m.knots[knot].copies.clear();
  m.links[link].is_alive = false;
  WorkingMesh::Link& joined = m.links[at.links[1 - i]];
  joined.ends[at.sides[1 - i]] = next;
  joined.arc[at.sides[1 - i]] = at.arcs[i];
  m.knots[next].replace_link(link, at.links[1 - i]);
  return true;
}

std::size_t collapse_short_links(WorkingMesh& m) {
  std::size_t done = 0;
  for (std::uint32_t l = 0; l < m.links.size(); ++l) {
    const auto [a, b] = m.links[l].ends;
    if (!m.links[l].is_alive || m.link_length(m.links[l]) >= too_short * m.wanted_length(a, b)) continue;
    done += try_collapse_knot(m, a, l, no_short_edges) || try_collapse_knot(m, b, l, no_short_edges);
  }
  return done;
}

std::size_t collapse_short_inner_edges(WorkingMesh& m) {
  std::size_t done = 0;
  for (std::size_t i = 0; i < m.mesh.n_edges(); ++i) {
    const EdgeHandle e(static_cast<int>(i));
    if (m.mesh.status(e).deleted() || m.mesh.is_boundary(e)) continue;
    const auto [a, b] = m.ends(e);
    if (m.edge_length(a, b) >= too_short * m.wanted_length(a, b)) continue;
    done += try_collapse(m, m.mesh.halfedge_handle(e, 0), no_short_edges) ||
            try_collapse(m, m.mesh.halfedge_handle(e, 1), no_short_edges);
  }
  return done;
}

// ---- Flips ----------------------------------------------------------------------------------------------------------

// An edge ab between the triangles abc and bad, and the triangles cdb and dca that a flip would give.
struct Flip {
  VertexHandle a, b, c, d;
  WorstFit before, after;
};

Flip flip_at(const WorkingMesh& m, EdgeHandle e, TriangleMeasure measure = TriangleMeasure::area) {
  Flip f;
  const auto one = m.corners(m.mesh.halfedge_handle(e, 0)), other = m.corners(m.mesh.halfedge_handle(e, 1));
  f.a = one[0], f.b = one[1], f.c = one[2], f.d = other[2];
  f.before.add(fit_of(m, one, measure));
  f.before.add(fit_of(m, other, measure));
  f.after.add(fit_of(m, {f.c, f.d, f.b}, measure));
  f.after.add(fit_of(m, {f.d, f.c, f.a}, measure));
  return f;
}

bool is_flip_candidate(const WorkingMesh& m, EdgeHandle e) {
  return !m.mesh.status(e).deleted() && !m.mesh.is_boundary(e) && !touches_frozen_face(m, e);
}

bool may_flip(const WorkingMesh& m, EdgeHandle e, const Flip& f) {
  if (!runs_along_surface(m, f.c, f.d) || !m.mesh.is_flip_ok(e)) return false;
  const std::uint32_t c = m.at(f.c).knot, d = m.at(f.d).knot;
  if (c != none && d != none && (c == d || are_joined(m, c, d))) return false;
  return is_near_surface(m, f.c, f.d) || !is_near_surface(m, f.a, f.b);
}

bool try_flip(WorkingMesh& m, EdgeHandle e, const Flip& f) {
  if (!may_replace(f.before.worst, f.after.worst, good_after_flip) || !may_flip(m, e, f)) return false;
  m.mesh.flip(e);
  ++work_done.edges_flipped;
  return true;
}

// The ideal number of neighbors of a vertex: six, or, on a feature, as many as divide its wedge into equal parts near
// 60 degrees.
int ideal_valence(const WorkingMesh& m, VertexHandle v) {
  if (!m.mesh.is_boundary(v)) return 6;
  double angle = 0;
  for (auto h = m.mesh.cvoh_iter(v); h.is_valid(); ++h) {
    if (m.mesh.is_boundary(*h)) continue;
    const auto [a, b, c] = m.points(m.corners(*h));
    angle += angle_at(a, b, c);
  }
  return std::max(1, static_cast<int>(std::lround(angle / to_radians(60)))) + 1;
}

int square(int i) {
  return i * i;
}

}  // namespace

void split_long_edges(WorkingMesh& m) {
  // A long link may have to wait for longer edges in its triangles, and these edges for links.
  LongEdgeSplitter splitter(m);
  std::size_t links = 0, edges = 0;
  while (links != m.links.size() || edges != m.mesh.n_edges()) {
    links = m.links.size();
    edges = m.mesh.n_edges();
    splitter.split_links();
    splitter.split_inner_edges();
  }
}

void collapse_short_edges(WorkingMesh& m) {
  constexpr int most_sweeps = 10;
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    const std::size_t done = collapse_short_links(m) + collapse_short_inner_edges(m);
    if (done * 1000 <= m.vertices.size()) break;
  }
}

bool improve_by_collapse(WorkingMesh& m, HalfedgeHandle h) {
  if (!m.mesh.is_boundary(m.mesh.edge_handle(h))) return try_collapse(m, h, better_triangles);
  const auto [from, to] = m.ends(h);
  const std::uint32_t link = link_between(m, m.at(from).knot, m.at(to).knot);
  return link != none && try_collapse_knot(m, m.at(from).knot, link, better_triangles);
}

void flip_edges_for_valence(WorkingMesh& m) {
  std::vector<int> excess(m.vertices.size(), 0);
  const auto excess_of = [&](VertexHandle v) -> int& { return excess[static_cast<std::size_t>(v.idx())]; };
  for (const VertexHandle v : m.mesh.vertices())
    excess_of(v) = static_cast<int>(m.mesh.valence(v)) - ideal_valence(m, v);
  for (std::size_t i = 0; i < m.mesh.n_edges(); ++i) {
    const EdgeHandle e(static_cast<int>(i));
    if (!is_flip_candidate(m, e)) continue;
    const auto [a, b, c] = m.corners(m.mesh.halfedge_handle(e, 0));
    const VertexHandle d = m.corners(m.mesh.halfedge_handle(e, 1))[2];
    int &ea = excess_of(a), &eb = excess_of(b), &ec = excess_of(c), &ed = excess_of(d);
    const int before = square(ea) + square(eb) + square(ec) + square(ed);
    const int after = square(ea - 1) + square(eb - 1) + square(ec + 1) + square(ed + 1);
    if (after < before && try_flip(m, e, flip_at(m, e))) --ea, --eb, ++ec, ++ed;
  }
}

void flip_edges_for_quality(WorkingMesh& m) {
  constexpr double least_gain = 1.001;  // so that rounding does not flip edges back and forth
  constexpr int most_sweeps = 5;
  bool any = true;
  for (int sweep = 0; any && sweep < most_sweeps; ++sweep) {
    any = false;
    for (std::size_t i = 0; i < m.mesh.n_edges(); ++i) {
      const EdgeHandle e(static_cast<int>(i));
      if (!is_flip_candidate(m, e)) continue;
      const Flip f = flip_at(m, e);
      if (f.after.worst.quality >= least_gain * f.before.worst.quality && try_flip(m, e, f)) any = true;
    }
  }
}

bool improve_by_flip(WorkingMesh& m, EdgeHandle e) {
  if (!is_flip_candidate(m, e)) return false;
  const Flip f = flip_at(m, e, TriangleMeasure::angle);
  if (!is_better(f.before.worst, f.after.worst) || !may_flip(m, e, f)) return false;
  m.mesh.flip(e);
  ++work_done.edges_flipped;
  return true;
}

}  // namespace ccdt::surface
