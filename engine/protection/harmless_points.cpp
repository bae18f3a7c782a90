#include "engine/protection/harmless_points.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <optional>

#include "engine/base/box_tree.h"
#include "engine/base/parallel.h"
#include "engine/numbers/predicates.h"
#include "engine/protection/voronoi_face.h"

namespace ccdt::protection {
namespace {

using Edge = std::array<std::uint32_t, 2>;

std::vector<Edge> protected_edges(const ProtectedDelaunay& p) {
  std::vector<Edge> edges;
  for (std::size_t s = 0; s < p.chains.size(); ++s)
    for (std::size_t i = 0; p.must_be_chain[s] && i + 1 < p.chains[s].size(); ++i)
      edges.push_back({p.chains[s][i].vertex, p.chains[s][i + 1].vertex});
  return edges;
}

std::vector<Box> boxes_of(std::span<const Point3> points) {
  std::vector<Box> boxes;
  boxes.reserve(points.size());
  for (const Point3& p : points) boxes.push_back(box_of(p));
  return boxes;
}

/// Finds the points that may harm an edge; keeps its working memory from one edge to the next.
class HarmSearch {
 public:
  HarmSearch(std::span<const Point3> points, const BoxTree& tree, const delaunay::Delaunay& d)
      : points_(points), tree_(tree), d_(d) {}

  /// Adds the points in the edge's sphere.
  void find(const Edge& edge, std::vector<std::uint32_t>& harmful) {
    gather_ring(d_, edge[0], edge[1], ring_);
    face_.make(d_, edge[0], edge[1], ring_);
    std::optional<std::size_t> fewest;
    face_.visit_empty_balls([&](const Ball& ball) {
      inside_.clear();
      tree_.for_each_meeting(ball, [&](std::uint32_t i) { inside_.push_back(i); });
      if (!fewest || inside_.size() < *fewest) {
        fewest = inside_.size();
        best_.swap(inside_);
      }
      return *fewest > 0;
    });
    if (!fewest) find_in_ring();
    if (!fewest || *fewest > 0) harmful.insert(harmful.end(), best_.begin(), best_.end());
  }

 private:
  /// Leaves all points in `best_` that destroy some cell around the edge.
  void find_in_ring() {
    best_.clear();
    tree_.for_each_meeting(face_.covering_ball(), [&](std::uint32_t i) {
      if (std::ranges::any_of(ring_.cells, [&](std::uint32_t c) { return destroys(points_[i], c); }))
        best_.push_back(i);
    });
  }

  bool destroys(const Point3& p, std::uint32_t cell) const {
    const auto& v = d_.cells[cell].vertices;
    // A point on the sphere does not: its vertex will have a greater rank than those of the cell.
    if (!d_.is_ghost(cell))
      return numbers::insphere(d_.point(v[0]), d_.point(v[1]), d_.point(v[2]), d_.point(v[3]), p) > 0;
    return numbers::orient3d(d_.point(v[0]), d_.point(v[1]), d_.point(v[2]), p) >= 0;
  }

  std::span<const Point3> points_;
  const BoxTree& tree_;
  const delaunay::Delaunay& d_;
  EdgeRing ring_;
  VoronoiFace face_;
  std::vector<std::uint32_t> inside_, best_;  ///< points in the ball of the moment; in the best one
};

}  // namespace

std::vector<std::uint32_t> harmless_points(std::span<const Point3> points, const ProtectedDelaunay& surface) {
  const BoxTree tree(boxes_of(points));
  std::vector<std::uint8_t> is_harmful(points.size(), false);
  const auto note = [&](std::uint32_t i) { std::atomic_ref(is_harmful[i]).store(true, std::memory_order_relaxed); };
  const std::vector<Edge> edges = protected_edges(surface);
  parallel_ranges(edges.size(), 256, [&](std::size_t begin, std::size_t end) {
    HarmSearch search(points, tree, surface.delaunay);
    std::vector<std::uint32_t> harmful;
    for (std::size_t i = begin; i < end; ++i) search.find(edges[i], harmful);
    std::ranges::for_each(harmful, note);
  });
  const auto& vertices = surface.delaunay.vertices;
  parallel_for(vertices.size(), 1024, [&](std::size_t v) { tree.for_each_meeting(box_of(vertices[v].point), note); });
  std::vector<std::uint32_t> harmless;
  for (std::uint32_t i = 0; i < points.size(); ++i)
    if (!is_harmful[i]) harmless.push_back(i);
  return harmless;
}

}  // namespace ccdt::protection
