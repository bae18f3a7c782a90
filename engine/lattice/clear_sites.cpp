#include "engine/lattice/clear_sites.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "engine/base/count_work.h"
#include "engine/base/index_lists.h"
#include "engine/base/parallel.h"
#include "engine/base/raw_vector.h"
#include "engine/geometry/balls.h"
#include "engine/geometry/closest_point.h"
#include "engine/lattice/surface_obstacles.h"

namespace ccdt::lattice {

// The usual clearance was chosen by measuring the cells of the Delaunay tetrahedralization of surface and lattice. For
// a uniform sphere of 5120 triangles: the percentage of cells with a dihedral angle below 20 degrees, and the mean of
// the paper's r:
//
//     clearance    0      0.4    0.5    0.55   0.6    0.65   0.7    0.8
//     fcc, < 20    1.18   1.18   0.97   0.73   0.75   0.73   0.93   1.03
//     fcc, r       1.236  1.236  1.228  1.222  1.223  1.228  1.247  1.255
//     bcc, < 20    0.97   0.56   0.39   0.39   0.43   0.52   0.65   0.76
//     bcc, r       1.245  1.214  1.176  1.175  1.182  1.196  1.204  1.205
//
// For a scanned surface of uneven triangles, 0.55 to 0.65 is best; for a cube with a grid on its faces, the clearance
// makes no difference.

namespace {

/// Covers the rounding in the test of whether a point is near enough to a triangle.
constexpr double relative_margin = 1e-9;

/// Octree coordinates from `low` to `high`, both included.
struct Range {
  std::array<std::uint32_t, 3> low, high;
};

/// An obstacle among the sites of an octree.
struct PlacedObstacle : Obstacle {
  Range near;     ///< of the triangle
  Range in_ball;  ///< of the triangle and its ball
};

/// A fast test of whether a point is near a triangle.
class TriangleDistance {
 public:
  explicit TriangleDistance(const TrianglePoints& triangle)
      : corners_(triangle),
        normal_(cross(triangle[1] - triangle[0], triangle[2] - triangle[0])),
        squared_area_(squared_length(normal_)) {}

  bool is_below(double squared_radius, const Point3& p) const {
    // Most points are already too far from the plane. The margin is for narrow triangles, whose normals are rounded
    // most.
    constexpr double margin = 1.01;
    const double height = dot(p - corners_[0], normal_);
    if (height * height > margin * squared_radius * squared_area_) return false;
    return squared_distance(corners_, p) <= squared_radius;
  }

 private:
  TrianglePoints corners_;
  Point3 normal_;
  double squared_area_;
};

/// A bounding box, slightly enlarged.
Range range_of(const Box& box, const Octree& tree) {
  const auto low = as_array(box.low - tree.origin), high = as_array(box.high - tree.origin);
  constexpr double most = std::uint32_t{1} << (Octree::bits + 1);
  Range range;
  for (int k = 0; k < 3; ++k) {
    range.low[k] = static_cast<std::uint32_t>(std::clamp(low[k] / tree.unit - 1, 0.0, most));
    range.high[k] = static_cast<std::uint32_t>(std::clamp(high[k] / tree.unit + 1, 0.0, most));
  }
  return range;
}

RawVector<PlacedObstacle> place_obstacles(const Octree& tree, const DomainSurface& surface, double sphere_factor) {
  const RawVector<Obstacle> obstacles = list_obstacles(surface, sphere_factor);
  RawVector<PlacedObstacle> placed(obstacles.size());
  parallel_for(obstacles.size(), 1024, [&](std::size_t i) {
    const Obstacle& o = obstacles[i];
    const Box box = bounding_box(surface.corners(o.vertices));
    const Box with_ball = o.squared_ball_radius >= 0 ? hull(box, expanded(box_of(o.ball.center), o.ball.radius)) : box;
    placed[i] = {o, range_of(box, tree), range_of(with_ball, tree)};
  });
  return placed;
}

/// Passes the obstacles down the octree to the leaves whose sites they may remove.
class Clearing {
 public:
  Clearing(const Octree& tree, const DomainSurface& surface, const std::vector<Site>& sites,
           const LatticeOptions& options)
      : tree_(tree),
        surface_(surface),
        sites_(sites),
        obstacles_(place_obstacles(tree, surface, options.sphere_factor)),
        nodes_(tree.nodes.size()),
        stays_(sites.size(), true) {
    for (unsigned level = 0; level <= tree.depth; ++level) {
      const double radius =
          options.clearance * edge_length_of_cell(options.kind, tree.length(2u << (tree.depth - level)));
      clearance_.push_back(
          {radius * radius, static_cast<std::uint32_t>(std::ceil(radius * (1 + relative_margin) / tree.unit))});
    }
    find_sites(0, 0);
  }

  std::vector<std::uint8_t> clear() {
    for (const double largest : parallel_chunks(obstacles_.size(), 4096, [&](std::size_t i, std::size_t end) {
           double of_these = -1;
           for (; i < end; ++i) of_these = std::max(of_these, obstacles_[i].squared_ball_radius);
           return of_these;
         }))
      largest_squared_ball_radius_ = std::max(largest_squared_ball_radius_, largest);
    std::vector<Subtree> subtrees;
    const std::size_t most_sites = thread_count() == 1 ? sites_.size() : sites_.size() / (8 * thread_count());
    divide({0, all_indices(obstacles_.size())}, most_sites, subtrees);
    parallel_for(subtrees.size(), 1, [&](std::size_t i) {
      Descent descent{std::move(subtrees[i].reaching)};
      descend(subtrees[i].node, 0, descent.reaching.size(), descent);
    });
    note_bytes(bytes_of(tree_.nodes, tree_.triangles, sites_, obstacles_, nodes_, stays_));
    return std::move(stays_);
  }

 private:
  /// The sites in a node, which are consecutive in Morton order.
  struct NodeSites {
    std::uint32_t begin = 0, end = 0;
    std::uint8_t coarsest = 0;  ///< the level of the coarsest leaf in the node that has any sites
  };
  struct PlacedSite {
    Point3 point;
    std::uint32_t number;
  };
  /// A node and the obstacles that reach it.
  struct Subtree {
    std::uint32_t node;
    std::vector<std::uint32_t> reaching;
  };
  /// The working memory of a descent.
  struct Descent {
    /// The obstacles that reach each node on the way from the root, those of the current node last; then unused room.
    std::vector<std::uint32_t> reaching;
    std::vector<std::uint8_t> children_in_reach = {};  ///< of each reaching obstacle
    std::vector<PlacedSite> left = {};                 ///< of a leaf
  };
  struct Clearance {
    double squared_radius;
    std::uint32_t units;  ///< the radius in octree units, rounded up
  };

  /// \param begin  where the sites of node i begin
  /// \return where they end
  std::uint32_t find_sites(std::uint32_t i, std::uint32_t begin) {
    const OctreeNode& node = tree_.nodes[i];
    NodeSites& here = nodes_[i];
    here = {begin, begin, node.level};
    if (node.is_leaf()) {
      const std::uint64_t side = tree_.side(node);
      const Site end = site_at(node.corner) + side * side * side;
      while (here.end < sites_.size() && sites_[here.end] < end) ++here.end;
      return here.end;
    }
    here.coarsest = static_cast<std::uint8_t>(tree_.depth);
    for (std::uint32_t c = 0; c < 8; ++c) {
      here.end = find_sites(node.first_child + c, here.end);
      const NodeSites& child = nodes_[node.first_child + c];
      if (child.begin != child.end) here.coarsest = std::min(here.coarsest, child.coarsest);
    }
    return here.end;
  }

  /// Divides a subtree into those with few sites, on all threads.
  void divide(Subtree whole, std::size_t most_sites, std::vector<Subtree>& subtrees) {
    const auto& [i, reaching] = whole;
    const OctreeNode& node = tree_.nodes[i];
    const NodeSites& here = nodes_[i];
    if (node.is_leaf() || reaching.empty() || here.end - here.begin <= most_sites) {
      subtrees.push_back(std::move(whole));
      return;
    }
    ++work_done.octree_nodes;
    if (is_covered(node, reaching)) {
      clear_all(here);
      return;
    }
    RawVector<std::uint8_t> children(reaching.size());
    parallel_for(reaching.size(), 4096,
                 [&](std::size_t k) { children[k] = children_in_reach(node, here, obstacles_[reaching[k]]); });
    std::array<std::vector<std::uint32_t>, 8> of_child;
    parallel_for(8, 1, [&](std::size_t c) {
      for (std::size_t k = 0; k < reaching.size(); ++k)
        if (children[k] >> c & 1u) of_child[c].push_back(reaching[k]);
    });
    for (std::uint32_t c = 0; c < 8; ++c) divide({node.first_child + c, std::move(of_child[c])}, most_sites, subtrees);
  }

  /// \param first,last  the part of `descent.reaching` that holds the obstacles that reach node i
  void descend(std::uint32_t i, std::size_t first, std::size_t last, Descent& descent) {
    ++work_done.octree_nodes;
    const OctreeNode& node = tree_.nodes[i];
    const NodeSites& here = nodes_[i];
    if (first == last || here.begin == here.end) return;
    std::vector<std::uint32_t>& reaching = descent.reaching;
    const std::span those = std::span(reaching).subspan(first, last - first);
    if (node.is_leaf()) {
      clear_leaf(node, here, those, descent.left);
      return;
    }
    if (is_covered(node, those)) {
      clear_all(here);
      return;
    }
    std::vector<std::uint8_t>& children = descent.children_in_reach;
    if (reaching.size() < 2 * last - first) reaching.resize(2 * (2 * last - first));
    if (children.size() < last) children.resize(2 * last);
    for (std::size_t k = first; k < last; ++k) children[k] = children_in_reach(node, here, obstacles_[reaching[k]]);
    for (std::uint32_t c = 0; c < 8; ++c) {
      // It is unpredictable whether an obstacle reaches a child, so there is no branch.
      std::size_t end = last;
      for (std::size_t k = first; k < last; ++k) {
        reaching[end] = reaching[k];
        end += children[k] >> c & 1u;
      }
      descend(node.first_child + c, last, end, descent);
    }
  }

  void clear_all(const NodeSites& those) {
    std::fill(stays_.begin() + those.begin, stays_.begin() + those.end, std::uint8_t{false});
  }

  /// Is the node within one of the balls?
  bool is_covered(const OctreeNode& node, std::span<const std::uint32_t> reaching) const {
    const Box box = tree_.box(node);
    const double side = tree_.length(tree_.side(node)), least = 0.75 * side * side;
    if (largest_squared_ball_radius_ < least) return false;
    return std::ranges::any_of(reaching, [&](std::uint32_t o) {
      const double bound = obstacles_[o].squared_ball_radius;
      return bound >= least && squared_farthest_distance(box, obstacles_[o].ball.center) <= bound;
    });
  }

  /// A bit for each child that may have a site in the ball or within the clearance.
  std::uint8_t children_in_reach(const OctreeNode& node, const NodeSites& here, const PlacedObstacle& o) const {
    constexpr std::uint8_t lower[] = {0x55, 0x33, 0x0F};
    const std::uint32_t reach = o.needs_clearance ? clearance_[here.coarsest].units : 0;
    unsigned children = 0xFF;
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t middle = node.corner[k] + tree_.side(node) / 2;
      if (std::min(o.in_ball.low[k] + reach, o.near.low[k]) >= middle + reach) children &= ~unsigned{lower[k]};
      if (std::max(o.in_ball.high[k], o.near.high[k] + reach) < middle) children &= lower[k];
    }
    return static_cast<std::uint8_t>(children);
  }

  void clear_leaf(const OctreeNode& leaf, const NodeSites& here, std::span<const std::uint32_t> reaching,
                  std::vector<PlacedSite>& left) {
    left.clear();
    std::uint64_t balls = 0;
    for (std::uint32_t s = here.begin; s < here.end; ++s) {
      const Point3 p = tree_.point(coordinates_of(sites_[s]));
      const auto covering = std::ranges::find_if(reaching, [&](std::uint32_t o) {
        return squared_length(p - obstacles_[o].ball.center) <= obstacles_[o].squared_ball_radius;
      });
      balls += static_cast<std::uint64_t>(covering - reaching.begin()) + (covering != reaching.end());
      if (covering != reaching.end())
        stays_[s] = false;
      else
        left.push_back({p, s});
    }
    work_done.sites_tested += here.end - here.begin;
    work_done.obstacles_tested += balls;
    for (std::size_t k = 0; k < reaching.size() && !left.empty(); ++k) {
      const PlacedObstacle& o = obstacles_[reaching[k]];
      if (o.needs_clearance && is_near(leaf, o)) clear_around(o, clearance_[leaf.level].squared_radius, left);
    }
  }

  /// May the leaf have a site within the clearance?
  bool is_near(const OctreeNode& leaf, const PlacedObstacle& o) const {
    const std::uint32_t side = tree_.side(leaf), reach = clearance_[leaf.level].units;
    for (int k = 0; k < 3; ++k)
      if (o.near.low[k] >= leaf.corner[k] + side + reach || o.near.high[k] + reach < leaf.corner[k]) return false;
    return true;
  }

  void clear_around(const PlacedObstacle& o, double squared_radius, std::vector<PlacedSite>& left) {
    const TriangleDistance distance(surface_.corners(o.vertices));
    work_done.obstacles_tested += left.size();
    std::erase_if(left, [&](const PlacedSite& site) {
      const bool goes = distance.is_below(squared_radius, site.point);
      if (goes) stays_[site.number] = false;
      return goes;
    });
  }

  const Octree& tree_;
  const DomainSurface& surface_;
  const std::vector<Site>& sites_;
  RawVector<PlacedObstacle> obstacles_;
  std::vector<NodeSites> nodes_;
  std::vector<Clearance> clearance_;  ///< by level
  std::vector<std::uint8_t> stays_;   ///< by site; each leaf has its own
  double largest_squared_ball_radius_ = -1;
};

}  // namespace

std::vector<std::uint8_t> find_clear_sites(const Octree& tree, const DomainSurface& surface,
                                           const std::vector<Site>& sites, const LatticeOptions& options) {
  return Clearing(tree, surface, sites, options).clear();
}

}  // namespace ccdt::lattice
