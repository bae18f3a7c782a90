#include "engine/refine/refine_plc.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <queue>
#include <span>
#include <tuple>
#include <utility>

#include "engine/base/count_work.h"
#include "engine/base/hash_table.h"
#include "engine/base/simplex_map.h"
#include "engine/delaunay/hilbert_order.h"
#include "engine/geometry/balls.h"
#include "engine/refine/close_segments.h"
#include "engine/refine/copies.h"
#include "engine/refine/divide_segment.h"
#include "engine/refine/facet_triangulation.h"
#include "engine/sizes/size_field.h"
#include "engine/sizes/thin_places.h"

namespace ccdt::refine {
namespace {

using planar::Side;

/// A triangle is too large if its circumradius is more than this times the wanted length; an equilateral triangle of
/// that length has 0.58.
constexpr double largest_radius = 0.75;

/// A triangle is badly shaped if its circumradius is more than this times its shortest edge, that is, if an angle is
/// below 30 degrees.
constexpr double worst_shape = 1;

/// No vertex is nearer to another than this times the wanted length.
constexpr double least_distance = 0.4;

/// To improve triangles, an edge of a segment is halved if it is longer than this times the wanted length.
constexpr double least_halved = 1.1;

/// A vertex encroaches on an edge of a segment that it sees at an angle of more than 120 degrees.
constexpr double encroaching_cosine = -0.5;

/// Largest distance of a new vertex from its wanted place, as a fraction of the wanted length.
constexpr double most_shift = 0.2;

/// On parts with many thin places, the mesh has about this many tetrahedra for each triangle of the surface; measured:
/// 21 to 27.
constexpr double tetrahedra_per_triangle = 25;

struct Shape {
  Point3 circumcenter;
  double radius = 0, shortest = 0;
  std::uint32_t corner = 0;  ///< opposite the shortest edge
};

Shape shape_of(const std::array<Point3, 3>& t) {
  Shape shape;
  shape.shortest = HUGE_VAL;
  for (std::uint32_t i = 0; i < 3; ++i) {
    const double edge = squared_length(t[(i + 2) % 3] - t[(i + 1) % 3]);
    if (edge >= shape.shortest) continue;
    shape.shortest = edge;
    shape.corner = i;
  }
  shape.shortest = std::sqrt(shape.shortest);
  const Point3 offset = to_circumcenter(t[1] - t[0], t[2] - t[0]);
  shape.circumcenter = t[0] + offset;
  shape.radius = length(offset);
  return shape;
}

class Refiner {
 public:
  /// \param field  must outlive this
  Refiner(plc::Plc plc, const sizes::SizeField& field, const Progress& progress)
      : plc_(std::move(plc)),
        sizes_(field),
        progress_(progress),
        points_(plc_.vertices),
        least_distances_(find_close_segments(plc_)),
        facets_of_segment_(plc_.segments.size()),
        copies_(plc_) {
    copies_.make_equal(least_distances_);
    std::vector<std::array<VertexId, 2>> edges;
    for (const plc::Segment& s : plc_.segments) edges.push_back(s.ends);
    segment_of_edge_ = EdgeMap(edges, plc_.vertices.size());
    place_.resize(plc_.vertices.size());
    for (const Point3& p : points_) wanted_.push_back(sizes_.at(p));
  }

  void run() {
    make_facets();
    for (std::uint32_t s = 0; s < plc_.segments.size(); ++s) divide(s);
    for (std::uint32_t f = 0; f < facets_.size(); ++f)
      for (std::uint32_t t = 0; t < triangulation(f).triangles.size(); ++t) enter(f, t);
    refine();
  }

  /// Gives the vertices their ids: those in facets first.
  RefinedPlc take() && {
    RefinedPlc result;
    const auto of_input = static_cast<std::uint32_t>(plc_.vertices.size());
    std::vector<std::uint32_t> in_facets;
    std::vector<protection::InnerVertex> inside;
    const std::span<const Point3> added = std::span(points_).subspan(of_input);
    // In Hilbert order, neighbors are near each other, so searches are short.
    for (const std::uint32_t i : delaunay::hilbert_order(added)) {
      const std::uint32_t v = of_input + i;
      if (place_[v].segment != none) continue;
      plc_.vertices.push_back(points_[v]);
      plc_.world.push_back(plc_.grid.to_world(points_[v]));
      in_facets.push_back(v);
    }
    for (std::uint32_t v = of_input; v < points_.size(); ++v) {
      if (place_[v].segment == none) continue;
      const VertexId id(plc_.vertices.size() + result.on_segments.size());
      inside.push_back({place_[v].segment, {id, place_[v].fraction * protection::usual_step, 0}});
      result.on_segments.push_back(points_[v]);
    }
    result.chains = protection::SegmentChains(plc_.segments);
    result.chains.insert(std::move(inside));
    retriangulate(in_facets, of_input);
    result.plc = std::move(plc_);
    return result;
  }

 private:
  /// The place where a vertex was added.
  struct PlaceOfVertex {
    std::uint32_t segment = none, fraction = 0;
    std::uint32_t facet = none;
  };

  const planar::Triangulation& triangulation(std::uint32_t facet) const { return facets_[facet].triangulation(); }

  std::array<Point3, 3> corners(std::uint32_t facet, std::uint32_t triangle) const {
    const auto& [a, b, c] = triangulation(facet).triangles[triangle];
    return {points_[a], points_[b], points_[c]};
  }

  void make_facets() {
    facets_.reserve(plc_.facets.size());
    for (std::uint32_t f = 0; f < plc_.facets.size(); ++f) {
      std::vector<planar::Edge> segments;
      for (const auto& t : plc_.triangles_of(plc_.facets[f])) {
        for (int i = 0; i < 3; ++i) {
          const std::uint32_t s = segment_of_edge_.find(t[i], t[(i + 1) % 3]);
          if (s == none) continue;
          segments.push_back(plc_.segments[s].ends);
          if (facets_of_segment_[s].empty() || facets_of_segment_[s].back() != f) facets_of_segment_[s].push_back(f);
        }
      }
      const plc::Facet& facet = plc_.facets[f];
      facets_.emplace_back(plc_.triangles_of(facet), facet.exactly_flat, segments, points_);
    }
  }

  // ---- Segments -----------------------------------------------------------------------------------------------------

  std::array<Point3, 2> ends_of(std::uint32_t segment) const {
    const auto& [a, b] = plc_.segments[segment].ends;
    return {points_[a], points_[b]};
  }

  void divide(std::uint32_t segment) {
    if (!copies_.is_first(segment)) return;
    const std::vector<std::uint32_t> fractions = divide_segment(ends_of(segment), least_distances_[segment], sizes_);
    copies_.visit(segment, [&](std::uint32_t copy, bool turned) {
      const auto& [first, last] = plc_.segments[copy].ends;
      const VertexId begin(points_.size());
      for (const std::uint32_t fraction : fractions)
        add_point_on_segment(copy, turned ? all_steps - fraction : fraction);
      split_evenly(copy, turned ? last : first, turned ? first : last, begin, VertexId(points_.size()));
    });
  }

  /// Splits the edge ab of a segment at the vertices from `begin` to before `end`, the middle one first: if they were
  /// taken in order along the segment, each one would take over the edges of the one before.
  void split_evenly(std::uint32_t segment, VertexId a, VertexId b, VertexId begin, VertexId end) {
    if (begin == end) return;
    const VertexId middle(begin + (end - begin) / 2);
    for (const std::uint32_t f : facets_of_segment_[segment]) facets_[f].split(a, b, middle);
    split_evenly(segment, a, middle, begin, middle);
    split_evenly(segment, middle, b, VertexId(middle + 1), end);
  }

  VertexId add_point_on_segment(std::uint32_t segment, std::uint32_t fraction) {
    points_.push_back(at_fraction(ends_of(segment), fraction));
    place_.push_back({segment, fraction, none});
    wanted_.push_back(sizes_.at(points_.back()));
    if (copies_.has_copies(segment))
      vertex_at_.set(std::uint64_t{segment} << 32 | fraction, VertexId(points_.size() - 1));
    return VertexId(points_.size() - 1);
  }

  VertexId vertex_at(std::uint32_t segment, std::uint32_t fraction) const {
    if (fraction == 0) return plc_.segments[segment].ends[0];
    if (fraction == all_steps) return plc_.segments[segment].ends[1];
    return *vertex_at_.find(std::uint64_t{segment} << 32 | fraction);
  }

  /// Splits the edge ab of a segment.
  VertexId add_on_segment(std::uint32_t segment, VertexId a, VertexId b, std::uint32_t fraction) {
    const VertexId v = add_point_on_segment(segment, fraction);
    for (const std::uint32_t f : facets_of_segment_[segment]) facets_[f].split(a, b, v);
    return v;
  }

  std::uint32_t fraction_of(std::uint32_t segment, VertexId v) const {
    if (v == plc_.segments[segment].ends[0]) return 0;
    return v == plc_.segments[segment].ends[1] ? all_steps : place_[v].fraction;
  }

  std::uint32_t segment_of(VertexId a, VertexId b) const {
    for (const VertexId v : {a, b})
      if (place_[v].segment != none) return place_[v].segment;
    return segment_of_edge_.find(a, b);
  }

  bool may_have_vertex(std::uint32_t segment, std::uint32_t fraction, double wanted) const {
    const auto& [a, b] = ends_of(segment);
    const double whole = length(b - a), distance = whole * fraction / all_steps;
    const auto& [of_first, of_second] = least_distances_[segment];
    return may_end_at(distance, of_first, wanted) && may_end_at(whole - distance, of_second, wanted);
  }

  /// Halves an edge of a segment if it is long enough.
  bool halve(VertexId a, VertexId b) {
    const double wanted = 0.5 * (wanted_[a] + wanted_[b]);
    if (length(points_[b] - points_[a]) < least_halved * wanted) return false;
    const std::uint32_t segment = segment_of(a, b);
    const std::uint32_t from = fraction_of(segment, a), to = fraction_of(segment, b);
    const std::uint32_t half = std::min(from, to) + (std::max(from, to) - std::min(from, to)) / 2;
    if (half == std::min(from, to) || !may_have_vertex(segment, half, wanted)) return false;
    copies_.visit(segment, [&](std::uint32_t copy, bool turned) {
      const auto at = [&](std::uint32_t fraction) { return turned ? all_steps - fraction : fraction; };
      const VertexId v = copy == segment
                             ? add_on_segment(segment, a, b, half)
                             : add_on_segment(copy, vertex_at(copy, at(from)), vertex_at(copy, at(to)), at(half));
      for (const std::uint32_t f : facets_of_segment_[copy]) enter_around(f, v);
    });
    return true;
  }

  // ---- Facets -------------------------------------------------------------------------------------------------------

  struct BadTriangle {
    double badness;
    std::uint32_t facet, triangle;
    std::array<VertexId, 3> vertices;

    bool operator<(const BadTriangle& o) const {
      return std::tie(badness, facet, triangle) < std::tie(o.badness, o.facet, o.triangle);
    }
  };

  /// Is the smallest angle between segments? If so, nothing helps.
  bool has_input_angle(const planar::Triangulation& t, std::uint32_t triangle, std::uint32_t corner) const {
    return t.constrained[triangle][planar::next_corner(corner)] &&
           t.constrained[triangle][planar::previous_corner(corner)];
  }

  double wanted_in(std::uint32_t facet, std::uint32_t triangle) const {
    const auto& [a, b, c] = triangulation(facet).triangles[triangle];
    return (wanted_[a] + wanted_[b] + wanted_[c]) / 3;
  }

  /// How bad a triangle is: 0 if it is good, otherwise more than 1, and largest if the triangle is too large.
  double badness_of(std::uint32_t facet, std::uint32_t triangle) const {
    const std::array<Point3, 3> t = corners(facet, triangle);
    const Shape shape = shape_of(t);
    const double wanted = wanted_in(facet, triangle);
    if (shape.radius > largest_radius * wanted) return 1e6 + shape.radius / wanted;
    if (shape.radius <= worst_shape * shape.shortest) return 0;
    return has_input_angle(triangulation(facet), triangle, shape.corner) ? 0 : shape.radius / shape.shortest;
  }

  void enter(std::uint32_t facet, std::uint32_t triangle) {
    if (copies_.is_copy(facet)) return;
    const double badness = badness_of(facet, triangle);
    if (badness > 0) queue_.push({badness, facet, triangle, triangulation(facet).triangles[triangle]});
  }

  void enter_around(std::uint32_t facet, VertexId v) {
    planar::visit_star(triangulation(facet), v, [&](std::uint32_t triangle, std::uint32_t) {
      enter(facet, triangle);
      return false;
    });
  }

  void refine() {
    std::uint64_t done = 0;
    while (!queue_.empty()) {
      if ((++done & 0xFFF) == 0) report(progress_, "refine", done, 0);
      const BadTriangle bad = queue_.top();
      queue_.pop();
      if (triangulation(bad.facet).triangles[bad.triangle] != bad.vertices) continue;
      // A vertex on a segment may leave the triangle unchanged.
      while (mend(bad.facet, bad.triangle) && triangulation(bad.facet).triangles[bad.triangle] == bad.vertices) {
      }
    }
  }

  /// Tries to add a vertex that removes a bad triangle. False if nothing changed.
  bool mend(std::uint32_t facet, std::uint32_t triangle) {
    const std::array<Point3, 3> t = corners(facet, triangle);
    const Shape shape = shape_of(t);
    const Point3 middle = 0.5 * (t[(shape.corner + 1) % 3] + t[(shape.corner + 2) % 3]);
    const Point3 up = shape.circumcenter - middle;
    const double wanted = wanted_in(facet, triangle), height = length(up);
    // The squared height over the shortest edge of a triangle whose other sides have the wanted length (Rebay 1993), or
    // at least that of the equilateral one (Uengoer 2009).
    const double even =
        std::max(wanted * wanted - 0.25 * shape.shortest * shape.shortest, 0.75 * shape.shortest * shape.shortest);
    if (height * height > even && put(facet, triangle, middle + (std::sqrt(even) / height) * up)) return true;
    // The circumcenter of a needle may exceed all coordinates. The way to it is blocked much nearer.
    constexpr double farthest = 0x1p50;
    return put(facet, triangle, height < farthest ? shape.circumcenter : middle + (farthest / height) * up);
  }

  /// Adds a vertex at a place in a facet, or halves an edge of a segment in the way. False if neither is possible.
  bool put(std::uint32_t facet, std::uint32_t triangle, const Point3& place) {
    FacetTriangulation& f = facets_[facet];
    const double wanted = wanted_in(facet, triangle);
    const std::optional<Point3> p = f.snap(place, most_shift * wanted);
    if (!p) return false;
    const VertexId v(points_.size());
    points_.push_back(*p);
    const WalkEnd end = f.walk(triangle, v);
    if (!end.wall && end.triangle == none) ++work_done.refinement_walks;
    const std::optional<Side> wall = end.wall ? end.wall : encroached(facet, end.triangle, v);
    if (wall || end.triangle == none || is_too_near(facet, end.triangle, v, wanted) || !f.insert(v, end.triangle)) {
      points_.pop_back();
      return wall && halve(planar::edge_start(f.triangulation(), *wall), planar::edge_end(f.triangulation(), *wall));
    }
    place_.push_back({none, 0, facet});
    wanted_.push_back(sizes_.at(*p));
    enter_around(facet, v);
    if (const auto [copy, shift] = copies_.of_facet(facet); copy != none) {
      points_.push_back(*p + shift);
      place_.push_back({none, 0, copy});
      wanted_.push_back(wanted_[v]);
      facets_[copy].insert(VertexId(v + 1), facets_[copy].find(VertexId(v + 1)));
    }
    return true;
  }

  /// Calls visit(triangle) for the triangles whose circumcircle contains the vertex.
  template <class Visit>
  void visit_cavity(std::uint32_t facet, std::uint32_t triangle, VertexId v, const Visit& visit) {
    const planar::Triangulation& t = triangulation(facet);
    cavity_.assign(1, triangle);
    for (std::size_t i = 0; i < cavity_.size(); ++i) {
      visit(cavity_[i]);
      for (std::uint32_t corner = 0; corner < 3; ++corner) {
        const std::uint32_t next = t.neighbors[cavity_[i]][corner];
        if (next == none || t.constrained[cavity_[i]][corner] || std::ranges::count(cavity_, next) > 0) continue;
        const auto& [a, b, c] = t.triangles[next];
        if (facets_[facet].plane().incircle(a, b, c, v) > 0) cavity_.push_back(next);
      }
    }
  }

  /// The edge of a segment that the vertex would encroach on most.
  std::optional<Side> encroached(std::uint32_t facet, std::uint32_t triangle, VertexId v) {
    std::optional<Side> worst;
    if (triangle == none) return worst;
    double least = encroaching_cosine;
    const planar::Triangulation& t = triangulation(facet);
    visit_cavity(facet, triangle, v, [&](std::uint32_t in_cavity) {
      for (std::uint32_t corner = 0; corner < 3; ++corner) {
        const Side side{in_cavity, corner};
        if (!planar::is_constrained(t, side)) continue;
        const Point3 a = points_[planar::edge_start(t, side)] - points_[v],
                     b = points_[planar::edge_end(t, side)] - points_[v];
        const double cosine = dot(a, b) / std::sqrt(squared_length(a) * squared_length(b));
        if (cosine >= least) continue;
        least = cosine;
        worst = side;
      }
    });
    return worst;
  }

  bool is_too_near(std::uint32_t facet, std::uint32_t triangle, VertexId v, double wanted) {
    double least = HUGE_VAL;
    visit_cavity(facet, triangle, v, [&](std::uint32_t in_cavity) {
      for (const VertexId u : triangulation(facet).triangles[in_cavity])
        least = std::min(least, squared_length(points_[u] - points_[v]));
    });
    return least < least_distance * least_distance * wanted * wanted;
  }

  // ---- Result -------------------------------------------------------------------------------------------------------

  /// Triangulates the facets with the vertices inside them, but without those on segments, as a PLC requires.
  void retriangulate(const std::vector<std::uint32_t>& in_facets, std::uint32_t of_input) {
    facets_.clear();
    std::vector<std::vector<VertexId>> vertices_of(plc_.facets.size());
    for (std::uint32_t i = 0; i < in_facets.size(); ++i)
      vertices_of[place_[in_facets[i]].facet].push_back(VertexId(of_input + i));
    const std::vector<plc::Facet> facets = std::exchange(plc_.facets, {});
    const std::vector<std::array<VertexId, 3>> triangles = std::exchange(plc_.triangles, {});
    plc_.faces.clear();
    for (std::uint32_t f = 0; f < facets.size(); ++f) {
      const plc::Facet& facet = facets[f];
      const auto its_triangles = std::span(triangles).subspan(facet.first_triangle, facet.triangle_count);
      if (vertices_of[f].empty()) {
        plc_.add(facet, its_triangles);
        continue;
      }
      std::vector<planar::Edge> segments;
      for (const auto& t : its_triangles)
        for (int i = 0; i < 3; ++i)
          if (segment_of_edge_.find(t[i], t[(i + 1) % 3]) != none) segments.push_back({t[i], t[(i + 1) % 3]});
      FacetTriangulation triangulation(its_triangles, facet.exactly_flat, segments, plc_.vertices);
      std::uint32_t near = 0;
      for (const VertexId v : vertices_of[f]) {
        const WalkEnd end = triangulation.walk(near, v);
        triangulation.insert(v, end.wall || end.triangle == none ? triangulation.find(v) : end.triangle);
        near = triangulation.triangulation().triangle_of_vertex.get(v, 0);
      }
      plc_.add(facet, triangulation.triangulation().triangles);
    }
  }

  plc::Plc plc_;
  sizes::SizeWalk sizes_;
  const Progress& progress_;
  std::vector<Point3> points_;        // with those that were added
  std::vector<PlaceOfVertex> place_;  // of each
  std::vector<double> wanted_;        // length of edges at each
  EdgeMap segment_of_edge_;
  HashTable<std::uint64_t, VertexId> vertex_at_;  // by segment and fraction
  std::vector<LeastDistances> least_distances_;   // by segment: of its vertices from its ends
  std::vector<std::vector<std::uint32_t>> facets_of_segment_;
  Copies copies_;
  std::vector<FacetTriangulation> facets_;
  std::priority_queue<BadTriangle> queue_;
  std::vector<std::uint32_t> cavity_;  // working memory
};

}  // namespace

RefinedPlc refine_plc(const plc::Plc& plc, const RefineOptions& options, const Progress& progress) {
  const sizes::SizeField field = sizes::find_thin_places(plc, options.edge_length, options.grading, options.wanted,
                                                         options.most_tetrahedra / tetrahedra_per_triangle);
  Refiner refiner(plc, field, progress);
  refiner.run();
  return std::move(refiner).take();
}

}  // namespace ccdt::refine
