#include "engine/lattice/place_circumcenters.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include "engine/base/count_work.h"
#include "engine/delaunay/insertion.h"
#include "engine/geometry/balls.h"
#include "engine/geometry/grid.h"
#include "engine/lattice/octree.h"
#include "engine/lattice/place_lattice_points.h"
#include "engine/lattice/surface_obstacles.h"
#include "engine/lattice/target_sizes.h"

namespace ccdt::lattice {
namespace {

using CellVertices = std::array<std::uint32_t, 4>;

CellVertices sorted(CellVertices v) {
  if (v[0] > v[1]) std::swap(v[0], v[1]);
  if (v[2] > v[3]) std::swap(v[2], v[3]);
  if (v[0] > v[2]) std::swap(v[0], v[2]);
  if (v[1] > v[3]) std::swap(v[1], v[3]);
  if (v[1] > v[2]) std::swap(v[1], v[2]);
  return v;
}

/// The circumsphere of a cell and what is compared with it.
struct CellShape {
  Point3 center;
  double squared_radius, squared_shortest_edge;
};

/// Up to rounding; a radius that is infinite or not a number if the cell is too flat.
CellShape shape_of(const Point3& a, const Point3& b, const Point3& c, const Point3& d) {
  const Point3 u = b - a, v = c - a, w = d - a;
  const double uu = squared_length(u), vv = squared_length(v), ww = squared_length(w);
  const Point3 to_center = to_circumcenter(u, v, w);
  return {a + to_center, squared_length(to_center),
          std::min({uu, vv, ww, squared_length(c - b), squared_length(d - b), squared_length(d - c)})};
}

/// A cell that may be bad. It may have been destroyed since.
struct Candidate {
  CellVertices vertices;  ///< in increasing order
  std::uint32_t cell;
};

/// Hands out candidates by badness, the worst first, up to a factor of 1 + 2^-5. Among those that are equally bad up to
/// that, the latest comes first: it is near the one before it, in space and in memory.
class CandidateQueue {
 public:
  /// \param badness  at least 0
  void push(double badness, const Candidate& candidate) {
    const std::size_t place = std::bit_cast<std::uint32_t>(static_cast<float>(badness)) >> low_bits;
    buckets_[place].push_back(candidate);
    worst_ = std::max(worst_, place);
    most_ = std::max(most_, ++size_);
  }

  /// \return  false if there is none
  bool pop(Candidate& candidate) {
    if (size_ == 0) return false;
    while (buckets_[worst_].empty()) --worst_;
    candidate = buckets_[worst_].back();
    buckets_[worst_].pop_back();
    --size_;
    return true;
  }

  /// Of the queue at its largest.
  std::size_t bytes() const { return most_ * sizeof(Candidate); }

 private:
  static constexpr int low_bits = 18;  ///< of a `float`, that do not matter: all but five of the mantissa

  std::vector<std::vector<Candidate>> buckets_ = std::vector<std::vector<Candidate>>(std::size_t{1} << (31 - low_bits));
  std::size_t worst_ = 0;  ///< no bucket beyond it has candidates
  std::size_t size_ = 0, most_ = 0;
};

class Refinement {
 public:
  Refinement(const DomainSurface& surface, delaunay::Delaunay delaunay, const LatticeOptions& options,
             const Progress& progress)
      : surface_(surface),
        options_(options),
        progress_(progress),
        squared_bound_(options.radius_edge * options.radius_edge),
        obstacles_(surface, options.sphere_factor),
        d_(std::move(delaunay)),
        insertion_(d_),
        first_(d_.vertices.size()) {
    const TargetSizes size =
        target_sizes(surface, options.edge_length, options.grading, options.wanted, options.surface_factor);
    check_number_of_points(surface, size);
    tree_ = build_octree(surface, size, options.kind);
    for (unsigned level = 0; level <= tree_.depth; ++level) {
      const double target = edge_length_of_cell(options.kind, tree_.length(2u << (tree_.depth - level)));
      levels_.push_back({options.clearance * target, radius_per_edge * radius_per_edge * target * target});
    }
  }

  LatticePoints run() {
    std::vector<std::uint32_t> all(d_.cells.size());
    std::iota(all.begin(), all.end(), 0u);
    consider(all);
    Candidate worst;
    while (queue_.pop(worst)) {
      if (is_gone(worst)) continue;
      const std::optional<NewPoint> point = find_point(worst);
      if (!point || !insert(point->place, worst.cell, point->squared_clearance)) continue;
      consider(insertion_.new_cells());
      const std::size_t count = d_.vertices.size() - first_;
      if (count % 4096 == 0) report(progress_, "lattice", count, 0);
    }
    note_bytes(bytes_of(d_.vertices, d_.cell_at, d_.cells, tree_.nodes, tree_.triangles) + obstacles_.bytes() +
               insertion_.bytes() + queue_.bytes());
    return points();
  }

 private:
  /// A circumcenter that may become a vertex.
  struct NewPoint {
    Point3 place;
    double squared_clearance;  ///< least squared distance to the nearest vertex
  };

  CellShape shape(const CellVertices& v) const {
    return shape_of(d_.point(v[0]), d_.point(v[1]), d_.point(v[2]), d_.point(v[3]));
  }

  bool is_skinny(const CellShape& s) const { return s.squared_radius > squared_bound_ * s.squared_shortest_edge; }

  bool is_large(const CellShape& s, const OctreeNode& leaf) const {
    return s.squared_radius > levels_[leaf.level].squared_radius;
  }

  /// Queues the bad ones of these cells whose circumcenter may be inside.
  void consider(std::span<const std::uint32_t> cells) {
    // Sorted, so that the order does not depend on that of the cells.
    new_ones_.clear();
    for (const std::uint32_t c : cells)
      if (d_.is_finite(c)) new_ones_.push_back({sorted(d_.cells[c].vertices), c});
    std::ranges::sort(new_ones_, {}, &Candidate::vertices);
    for (const Candidate& c : new_ones_) {
      const CellShape s = shape(c.vertices);
      const Point3 center = rounded(s.center);
      if (!strictly_contains(tree_.bounds, center)) continue;
      const OctreeNode& leaf = tree_.leaf_with(center);
      if (leaf.place != NodePlace::outside && (is_skinny(s) || is_large(s, leaf)))
        queue_.push(s.squared_radius / s.squared_shortest_edge, c);
    }
  }

  bool is_gone(const Candidate& c) const {
    return !d_.is_finite(c.cell) || sorted(d_.cells[c.cell].vertices) != c.vertices;
  }

  /// The circumcenter of a bad cell, if a vertex may be there.
  std::optional<NewPoint> find_point(const Candidate& candidate) const {
    const CellShape s = shape(candidate.vertices);
    const Point3 center = rounded(s.center);
    const OctreeNode& leaf = tree_.leaf_with(center);
    if (obstacles_.reach(center, levels_[leaf.level].clearance) || !is_inside(center, leaf)) return {};
    const bool is_large = this->is_large(s, leaf);
    if (!is_large && !is_inside(centroid(candidate.vertices))) return {};
    return NewPoint{center, is_large ? s.squared_radius / 4 : s.squared_shortest_edge};
  }

  /// Inserts a vertex, unless it would leave the cell in place or come too near another vertex.
  bool insert(const Point3& p, std::uint32_t cell, double squared_clearance) {
    const std::uint32_t v = d_.add_vertex(p);
    const bool is_new = insertion_.find_cavity(v, cell);
    if (is_new && insertion_.in_cavity(cell) && squared_distance_to_nearest(p) >= squared_clearance) {
      insertion_.fill_cavity();
      return true;
    }
    insertion_.discard_cavity();
    d_.remove_last_vertex();
    return false;
  }

  /// The nearest vertex will be joined to the new one by an edge, so it is on the border of the cavity.
  double squared_distance_to_nearest(const Point3& p) const {
    double least = HUGE_VAL;
    for (const delaunay::CavityFace& face : insertion_.cavity_faces())
      for (const std::uint32_t v : face.vertices)
        if (v != delaunay::ghost_vertex) least = std::min(least, squared_length(p - d_.point(v)));
    return least;
  }

  static Point3 rounded(const Point3& p) { return {round_to_unit(p.x), round_to_unit(p.y), round_to_unit(p.z)}; }

  Point3 centroid(const CellVertices& v) const {
    return rounded(0.25 * ((d_.point(v[0]) + d_.point(v[1])) + (d_.point(v[2]) + d_.point(v[3]))));
  }

  bool is_inside(const Point3& p, const OctreeNode& leaf) const {
    if (leaf.place != NodePlace::surface) return leaf.place == NodePlace::inside;
    return lattice::is_inside(tree_, surface_, p, leaf);
  }

  bool is_inside(const Point3& p) const {
    return strictly_contains(tree_.bounds, p) && is_inside(p, tree_.leaf_with(p));
  }

  /// The first points are the farthest from each other, so they should be inserted first again. Each round has three
  /// times as many points as all rounds before it.
  LatticePoints points() const {
    const std::size_t count = d_.vertices.size() - first_;
    LatticePoints result;
    result.kind = options_.kind;
    result.levels.resize(count, 0);
    for (std::size_t i = 0; i < count; ++i) {
      result.points.push_back(d_.vertices[first_ + i].point);
      std::uint8_t rounds = 0;
      for (std::size_t end = 4 * (i + 1); end <= count; end *= 4) ++rounds;
      result.later_rounds.push_back(rounds);
    }
    return result;
  }

  const DomainSurface& surface_;
  const LatticeOptions& options_;
  const Progress& progress_;
  const double squared_bound_;
  /// What is allowed where the leaves of the octree have this level.
  struct Level {
    double clearance;       ///< from the surface, the least
    double squared_radius;  ///< of a cell, the greatest
  };

  Octree tree_;
  std::vector<Level> levels_;
  const SurfaceObstacles obstacles_;
  delaunay::Delaunay d_;
  delaunay::Insertion insertion_;
  const std::size_t first_;  ///< interior vertex
  CandidateQueue queue_;
  std::vector<Candidate> new_ones_;  ///< working memory
};

}  // namespace

LatticePoints place_circumcenters(const DomainSurface& surface, delaunay::Delaunay delaunay,
                                  const LatticeOptions& options, const Progress& progress) {
  if (surface.triangles.empty()) return {};
  return Refinement(surface, std::move(delaunay), options, progress).run();
}

}  // namespace ccdt::lattice
