#include "engine/lattice/clear_surface.h"

#include <algorithm>
#include <cmath>

#include "engine/lattice/cell_size.h"

namespace ccdt {

// The usual clearance was measured on the cells of the Delaunay tetrahedralization of surface and lattice. A sphere of
// 5120 triangles, uniform; in per cent the cells with a dihedral angle below 20 degrees, and the mean of the paper's r:
//
//     clearance    0      0.4    0.5    0.55   0.6    0.65   0.7    0.8
//     fcc, < 20    1.18   1.18   0.97   0.73   0.75   0.73   0.93   1.03
//     fcc, r       1.236  1.236  1.228  1.222  1.223  1.228  1.247  1.255
//     bcc, < 20    0.97   0.56   0.39   0.39   0.43   0.52   0.65   0.76
//     bcc, r       1.245  1.214  1.176  1.175  1.182  1.196  1.204  1.205
//
// A scanned surface of uneven triangles has its best values from 0.55 to 0.65, a cube with a grid on its faces does not
// care.

namespace {

/// How a node and the region that must be empty lie to each other.
enum class Relation { apart, overlapping, covered };

/// The part of the sites that is in a node, and whether none of it is left.
struct NodeSites {
  std::uint32_t begin = 0, end = 0;
  std::uint8_t coarsest = 0;  ///< the level of the coarsest leaf in the node
  bool emptied = false;
};

class Clearing {
 public:
  Clearing(const Octree& tree, const std::vector<Site>& sites, const LatticeOptions& options)
      : tree_(tree),
        sites_(sites),
        stays_(sites.size(), true),
        nodes_(tree.nodes.size()),
        radius_of_level_(tree.depth + 1) {
    for (unsigned level = 0; level <= tree.depth; ++level)
      radius_of_level_[level] =
          options.clearance * edge_length_of_cell(options.kind, tree.length(2u << (tree.depth - level)));
    find_sites(0, 0, static_cast<std::uint32_t>(sites.size()));
  }

  void clear(const Ball& ball) {
    const double bound = ball.radius * ball.radius;
    drop(
        0,
        [&](std::uint32_t node) {
          const Box box = tree_.box(tree_.nodes[node]);
          if (squared_distance(box, ball.centre) > bound) return Relation::apart;
          return squared_farthest_distance(box, ball.centre) <= bound ? Relation::covered : Relation::overlapping;
        },
        [&](std::uint32_t, const Point3& p) { return squared_length(p - ball.centre) <= bound; });
  }

  /// Drops what is too near to a triangle, which may be degenerate: a segment or a vertex.
  void clear(const Corners& triangle) {
    const Box around = bounding_box(triangle);
    const Point3 normal = cross(triangle[1] - triangle[0], triangle[2] - triangle[0]);
    const double length = std::sqrt(squared_length(normal));
    const Point3 unit = length > 0 ? (1 / length) * normal : Point3{};
    const Point3 slant{std::abs(unit.x), std::abs(unit.y), std::abs(unit.z)};
    drop(
        0,
        [&](std::uint32_t node) {
          const double radius = radius_of_level_[nodes_[node].coarsest] * (1 + 1e-9);
          const Box box = tree_.box(tree_.nodes[node]);
          if (squared_distance(box, around) > radius * radius) return Relation::apart;
          const double height = std::abs(dot(unit, box.centre() - triangle[0]));
          return height - 0.5 * dot(slant, box.high - box.low) > radius ? Relation::apart : Relation::overlapping;
        },
        [&](std::uint32_t leaf, const Point3& p) {
          const double radius = radius_of_level_[tree_.nodes[leaf].level];
          return squared_distance(triangle, p) <= radius * radius;
        });
  }

  std::vector<bool> take() { return std::move(stays_); }

 private:
  /// The sites of a node follow one another in Morton order.
  void find_sites(std::uint32_t i, std::uint32_t begin, std::uint32_t end) {
    const OctreeNode& node = tree_.nodes[i];
    nodes_[i] = {begin, end, node.level, begin == end};
    if (node.is_leaf()) return;
    nodes_[i].coarsest = static_cast<std::uint8_t>(tree_.depth);
    for (std::uint32_t c = 0; c < 8; ++c) {
      std::uint32_t child_end = end;
      if (c < 7) {
        const Site next = site_at(tree_.nodes[node.first_child + c + 1].corner);
        const auto at = std::lower_bound(sites_.begin() + begin, sites_.begin() + end, next);
        child_end = static_cast<std::uint32_t>(at - sites_.begin());
      }
      find_sites(node.first_child + c, begin, child_end);
      const NodeSites& child = nodes_[node.first_child + c];
      if (!child.emptied) nodes_[i].coarsest = std::min(nodes_[i].coarsest, child.coarsest);
      begin = child_end;
    }
  }

  template <class RelationOf, class Contains>
  void drop(std::uint32_t i, const RelationOf& relation_of, const Contains& contains) {
    NodeSites& here = nodes_[i];
    if (here.emptied) return;
    const Relation relation = relation_of(i);
    if (relation == Relation::apart) return;
    if (relation == Relation::covered) {
      std::fill(stays_.begin() + here.begin, stays_.begin() + here.end, false);
      here.emptied = true;
      return;
    }
    const OctreeNode& node = tree_.nodes[i];
    here.emptied = true;
    if (node.is_leaf()) {
      for (std::uint32_t s = here.begin; s < here.end; ++s) {
        if (stays_[s] && contains(i, tree_.point(coordinates_of(sites_[s])))) stays_[s] = false;
        if (stays_[s]) here.emptied = false;
      }
      return;
    }
    for (std::uint32_t c = 0; c < 8; ++c) {
      drop(node.first_child + c, relation_of, contains);
      if (!nodes_[node.first_child + c].emptied) here.emptied = false;
    }
  }

  const Octree& tree_;
  const std::vector<Site>& sites_;
  std::vector<bool> stays_;
  std::vector<NodeSites> nodes_;
  std::vector<double> radius_of_level_;
};

/// Covers the rounding of the test whether a point is in a ball.
constexpr double hair = 1e-9;

}  // namespace

Ball smallest_ball(const Point3& a, const Point3& b) {
  return {0.5 * (a + b), 0.5 * std::sqrt(squared_length(b - a)) * (1 + hair)};
}

Ball smallest_ball(const Corners& triangle) {
  // a to b is the longest edge, c the corner across.
  Corners t = triangle;
  for (int turn = 0; turn < 2; ++turn) {
    const double opposite_c = squared_length(t[1] - t[0]);
    if (opposite_c >= squared_length(t[2] - t[1]) && opposite_c >= squared_length(t[0] - t[2])) break;
    t = {t[1], t[2], t[0]};
  }
  const auto& [a, b, c] = t;
  const Point3 middle = 0.5 * (a + b), along = b - a, to_c = c - middle;
  const double radius2 = 0.25 * squared_length(along), excess = squared_length(to_c) - radius2;
  const Point3 height = to_c - (dot(to_c, along) / squared_length(along)) * along;
  const double height2 = squared_length(height);
  if (excess <= 0 || height2 == 0) return smallest_ball(a, b);
  // On the way from the middle of ab towards c, the centre is where a and c are equally far.
  const double shift = excess / (2 * height2);
  const double radius = std::sqrt(radius2 + shift * shift * height2);
  constexpr double rounding = 1e-15;
  return {middle + shift * height, radius * (1 + hair) + rounding * radius2 / std::sqrt(height2)};
}

std::vector<bool> find_clear_sites(const Octree& tree, const Surface& surface, const std::vector<Site>& sites,
                                   const LatticeOptions& options) {
  Clearing clearing(tree, sites, options);
  std::vector<Ball> balls;
  if (options.sphere_factor > 0) {
    for (std::uint32_t t = 0; t < surface.triangles.size(); ++t) balls.push_back(smallest_ball(surface.corners(t)));
    for (const auto& [a, b] : surface.subsegments)
      balls.push_back(smallest_ball(surface.vertices[a], surface.vertices[b]));
  }
  // The large ones first: they empty whole nodes, which no other needs to enter then.
  std::ranges::sort(balls, std::ranges::greater{}, &Ball::radius);
  for (Ball& ball : balls) {
    ball.radius *= options.sphere_factor;
    clearing.clear(ball);
  }

  std::vector<bool> in_triangle(surface.vertices.size(), false);
  for (std::uint32_t t = 0; t < surface.triangles.size(); ++t) {
    clearing.clear(surface.corners(t));
    for (VertexId v : surface.triangles[t].vertices) in_triangle[v] = true;
  }
  for (const auto& [a, b] : surface.subsegments) {
    if (!in_triangle[a] || !in_triangle[b])
      clearing.clear({surface.vertices[a], surface.vertices[b], surface.vertices[b]});
  }
  for (std::size_t v = 0; v < surface.vertices.size(); ++v) {
    if (!in_triangle[v]) clearing.clear({surface.vertices[v], surface.vertices[v], surface.vertices[v]});
  }
  return clearing.take();
}

}  // namespace ccdt
