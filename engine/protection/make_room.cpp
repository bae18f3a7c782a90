#include "engine/protection/make_room.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>

#include "engine/base/count_work.h"
#include "engine/base/errors.h"
#include "engine/base/parallel.h"
#include "engine/base/platform.h"
#include "engine/geometry/box_tree.h"
#include "engine/geometry/predicates.h"
#include "engine/protection/voronoi_face.h"

namespace ccdt::protection {
namespace {

/// If the smallest sphere of an edge holds more points, other spheres hardly ever hold fewer.
constexpr std::size_t few_points = 8;

/// Least number of points that a split must save.
constexpr std::size_t points_per_split = 20;

/// The halves of an edge may be costly as well. After this many rounds, few of them are.
constexpr int most_rounds = 3;

struct ProtectedEdge {
  PieceEnds ends;
  std::uint32_t face;  ///< of the tetrahedralization, at the edge; `plc::no_face` if none is known
};

std::vector<ProtectedEdge> protected_edges(const plc::Plc& plc, const ProtectedDelaunay& p) {
  // After vertices were added, the faces may have changed.
  const bool has_faces = p.delaunay.vertices.size() == plc.vertices.size();
  std::vector<ProtectedEdge> edges;
  for (std::size_t s = 0; s < p.chains.size(); ++s)
    for (std::size_t i = 0; p.must_be_chain[s] && i + 1 < p.chains[s].size(); ++i)
      edges.push_back(
          {{p.chains[s][i].vertex, p.chains[s][i + 1].vertex}, has_faces ? plc.segments[s].face : plc::no_face});
  return edges;
}

/// A vector of higher precision.
using LongVector = std::array<long double, 3>;

/// Exact for points of the grid, whose difference may need one more bit than they do.
LongVector difference(const Point3& a, const Point3& b) {
  return {static_cast<long double>(a.x) - b.x, static_cast<long double>(a.y) - b.y,
          static_cast<long double>(a.z) - b.z};
}

long double dot(const LongVector& a, const LongVector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

LongVector cross(const LongVector& a, const LongVector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Finds the points that may harm an edge; keeps its working memory from one edge to the next.
class HarmSearch {
 public:
  HarmSearch(std::span<const Point3> points, const BoxTree& tree, const delaunay::Delaunay& d, Avoided avoided)
      : points_(points), tree_(tree), d_(d), avoided_(avoided) {}

  /// \return  the points in the edge's sphere
  std::vector<std::uint32_t> find(const ProtectedEdge& edge) {
    const auto [a, b] = edge.ends;
    const std::uint32_t first =
        edge.face == plc::no_face ? delaunay::find_edge(d_, a, b) : delaunay::cell_of(edge.face);
    gather_ring(d_, a, b, first, ring_);
    face_.make(d_, a, b, ring_);
    if (avoided_ == Avoided::smallest_spheres && face_.smallest_ball_is_empty()) return {};
    std::optional<std::size_t> fewest;
    face_.visit_empty_balls([&](const Ball& ball) {
      inside_.clear();
      tree_.for_each_meeting(ball, [&](std::uint32_t i) { inside_.push_back(i); });
      if (!fewest || inside_.size() < *fewest) {
        fewest = inside_.size();
        best_.swap(inside_);
      }
      return *fewest > 0 && *fewest <= few_points;
    });
    if (!fewest) find_in_cell(edge.ends);
    return best_;
  }

 private:
  /// Keeps only those points in `best_` that are in the sphere of one cell around the edge: without them, that cell
  /// stays, and the edge with it. The cell is about the one with the smallest sphere.
  void find_in_cell(const PieceEnds& edge) {
    const auto size = [&](std::uint32_t cell) { return rough_squared_radius(edge, cell); };
    const std::uint32_t smallest = *std::ranges::min_element(ring_.cells, {}, size);
    best_.clear();
    const std::optional<Ball> ball = ball_around(smallest);
    tree_.for_each_meeting(ball ? *ball : face_.covering_ball(), [&](std::uint32_t i) {
      if (destroys(points_[i], smallest)) best_.push_back(i);
    });
  }

  /// A ball that holds the sphere of a cell, enlarged by more than its rounding; none for a ghost or a flat cell. The
  /// ball around the spheres of all cells of an edge would hold most points of a convex part.
  ///
  /// Cells on a nearly flat surface have large spheres that are hardly inside the domain. So the center is computed
  /// with high precision.
  std::optional<Ball> ball_around(std::uint32_t cell) const {
    if (d_.is_ghost(cell)) return {};
    const auto& v = d_.cells[cell].vertices;
    const Point3 origin = d_.point(v[0]);
    const LongVector a = difference(d_.point(v[1]), origin), b = difference(d_.point(v[2]), origin),
                     c = difference(d_.point(v[3]), origin);
    const LongVector bc = cross(b, c), ca = cross(c, a), ab = cross(a, b);
    const long double aa = dot(a, a), bb = dot(b, b), cc = dot(c, c), det = dot(a, bc);
    // Rounding moves the center by up to 30 times this share of the radius.
    const long double rounding = std::numeric_limits<long double>::epsilon() * std::sqrt(aa * bb * cc) / std::abs(det);
    if (!(rounding < 1e-6L)) return {};
    const auto coordinate = [&](int k) {
      return static_cast<double>((aa * bc[k] + bb * ca[k] + cc * ab[k]) / (2 * det));
    };
    const Point3 to_center = {coordinate(0), coordinate(1), coordinate(2)};
    const double radius = length(to_center), margin = static_cast<double>(100 * rounding);
    constexpr double epsilon = std::numeric_limits<double>::epsilon();
    return Ball{origin + to_center, (1 + margin) * radius + 16 * epsilon * (radius + length(origin))};
  }

  /// The squared radius of the cell's sphere up to rounding, which does not depend on the order of the cell's vertices;
  /// the vertices break ties.
  std::tuple<double, std::uint32_t, std::uint32_t> rough_squared_radius(const PieceEnds& edge,
                                                                        std::uint32_t cell) const {
    std::array<std::uint32_t, 4> v = d_.cells[cell].vertices;
    std::ranges::sort(v);
    std::ranges::stable_partition(v, [&](std::uint32_t i) { return i == edge[0] || i == edge[1]; });
    if (v[3] == delaunay::ghost_vertex) return {HUGE_VAL, v[2], v[3]};
    const Point3 a = d_.point(v[1]) - d_.point(v[0]), b = d_.point(v[2]) - d_.point(v[0]),
                 c = d_.point(v[3]) - d_.point(v[0]);
    const double det = dot(a, cross(b, c));
    const Point3 sum =
        squared_length(a) * cross(b, c) + squared_length(b) * cross(c, a) + squared_length(c) * cross(a, b);
    return {det == 0 ? HUGE_VAL : squared_length((0.5 / det) * sum), v[2], v[3]};
  }

  bool destroys(const Point3& p, std::uint32_t cell) const {
    const auto& v = d_.cells[cell].vertices;
    // A point on the sphere does not: its vertex will have a greater rank than those of the cell.
    if (!d_.is_ghost(cell)) return insphere(d_.point(v[0]), d_.point(v[1]), d_.point(v[2]), d_.point(v[3]), p) > 0;
    return orient3d(d_.point(v[0]), d_.point(v[1]), d_.point(v[2]), p) >= 0;
  }

  std::span<const Point3> points_;
  const BoxTree& tree_;
  const delaunay::Delaunay& d_;
  const Avoided avoided_;
  EdgeRing ring_;
  VoronoiFace face_;
  std::vector<std::uint32_t> inside_, best_;  ///< points in the current ball; in the best one
};

/// The points that may harm each protected edge.
std::vector<std::vector<std::uint32_t>> find_harmful(std::span<const Point3> points, const BoxTree& tree,
                                                     const std::vector<ProtectedEdge>& edges,
                                                     const delaunay::Delaunay& delaunay, Avoided avoided) {
  std::vector<std::vector<std::uint32_t>> harmful(edges.size());
  parallel_ranges(edges.size(), 256, [&](std::size_t begin, std::size_t end) {
    HarmSearch search(points, tree, delaunay, avoided);
    for (std::size_t i = begin; i < end; ++i) harmful[i] = search.find(edges[i]);
  });
  return harmful;
}

/// What points do to the protected edges of a surface.
struct Harm {
  std::vector<ProtectedEdge> edges;
  std::vector<std::vector<std::uint32_t>> points;  ///< that may harm each edge
  std::vector<std::uint32_t> edge_count;           ///< by point: the edges that it may harm

  Harm(std::span<const Point3> all, const BoxTree& tree, const plc::Plc& plc, const ProtectedDelaunay& surface,
       Avoided avoided)
      : edges(protected_edges(plc, surface)),
        points(find_harmful(all, tree, edges, surface.delaunay, avoided)),
        edge_count(all.size()) {
    for (const auto& harmful : points)
      for (const std::uint32_t i : harmful) ++edge_count[i];
  }

  std::size_t harmful_points() const { return edge_count.size() - std::ranges::count(edge_count, 0u); }

  /// The edges that cost many points. A point that may harm several edges counts in equal parts for each.
  std::vector<PieceEnds> costly_edges() const {
    std::vector<PieceEnds> costly;
    for (std::size_t e = 0; e < edges.size(); ++e) {
      double own = 0;
      for (const std::uint32_t i : points[e]) own += 1.0 / edge_count[i];
      if (own > points_per_split) costly.push_back(edges[e].ends);
    }
    return costly;
  }
};

/// The points that harm no edge and do not coincide with one of these vertices.
std::vector<std::uint32_t> harmless_points(const Harm& harm, const BoxTree& tree,
                                           std::span<const delaunay::DelaunayVertex> vertices) {
  std::vector<std::uint8_t> is_vertex(harm.edge_count.size(), false);
  parallel_for(vertices.size(), 1024, [&](std::size_t v) {
    tree.for_each_meeting(box_of(vertices[v].point),
                          [&](std::uint32_t i) { as_atomic(is_vertex[i]).store(true, std::memory_order_relaxed); });
  });
  std::vector<std::uint32_t> result;
  for (std::uint32_t i = 0; i < harm.edge_count.size(); ++i)
    if (harm.edge_count[i] == 0 && !is_vertex[i]) result.push_back(i);
  return result;
}

/// The surface with these edges split; none if one of them, or an edge that must be split as a result, cannot be.
std::optional<ProtectedDelaunay> with_split(const std::vector<PieceEnds>& edges, const plc::Plc& plc,
                                            Protection strategy, const ProtectedDelaunay& surface,
                                            const Progress& progress) {
  try {
    return protect_edges(plc, surface, strategy, progress, edges);
  } catch (const LimitError&) {
    return {};
  }
}

}  // namespace

std::vector<std::uint32_t> make_room(std::span<const Point3> points, const plc::Plc& plc, Protection strategy,
                                     ProtectedDelaunay& surface, Avoided avoided, const Progress& progress) {
  const BoxTree tree(points, box_of);
  const std::size_t first_in_the_way = avoided == Avoided::nothing ? 0 : surface.delaunay.vertices.size();
  Harm harm(points, tree, plc, surface, avoided);
  for (int round = 0;; ++round) {
    const std::vector<PieceEnds> costly = harm.costly_edges();
    if (costly.empty()) break;
    if (round == most_rounds) {
      ++work_done.rounds_of_room;
      break;
    }
    std::optional<ProtectedDelaunay> split = with_split(costly, plc, strategy, surface, progress);
    if (!split) break;
    Harm less(points, tree, plc, *split, Avoided::nothing);
    const std::size_t splits = split->delaunay.vertices.size() - surface.delaunay.vertices.size();
    if (less.harmful_points() + points_per_split * splits > harm.harmful_points()) break;
    surface = std::move(*split);
    harm = std::move(less);
  }
  return harmless_points(harm, tree, std::span(surface.delaunay.vertices).subspan(first_in_the_way));
}

}  // namespace ccdt::protection
