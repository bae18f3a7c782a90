#include "engine/lattice/place_lattice_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <string_view>

#include "engine/base/morton.h"
#include "engine/base/parallel.h"
#include "engine/base/raw_vector.h"
#include "engine/lattice/clear_sites.h"
#include "engine/lattice/sites.h"
#include "engine/plc/edge_length_bounds.h"

namespace ccdt::lattice {
namespace {

constexpr std::string_view stage = "lattice";
constexpr std::uint8_t outside = 0xFF;  ///< in place of a level

/// By the divergence theorem.
double volume_inside(const DomainSurface& surface) {
  if (surface.triangles.empty()) return 0;
  const Point3 origin = surface.vertices[surface.triangles[0].vertices[0]];
  double volume = 0;
  for (std::uint32_t t = 0; t < surface.triangles.size(); ++t) {
    const auto& triangle = surface.triangles[t];
    const auto [a, b, c] = surface.corners(t);
    const double six_volumes = dot(cross(a - origin, b - origin), c - origin);
    volume += six_volumes / 6 * (int{triangle.inside_below} - int{triangle.inside_above});
  }
  return volume;
}

/// Before the points take memory. Near the surface, most of them may be dropped.
void check_number_of_leaves(const Octree& tree, const LatticeOptions& options) {
  constexpr double largest_error = 100;
  const double edge = edge_length_of_cell(options.kind, 1), tetrahedra_of_leaf = 6 * std::sqrt(2.0) / std::pow(edge, 3);
  const auto leaves = static_cast<double>(std::ranges::count_if(
      tree.nodes, [](const OctreeNode& node) { return node.is_leaf() && node.place == NodePlace::inside; }));
  if (leaves * tetrahedra_of_leaf > largest_error * options.most_tetrahedra)
    plc::throw_too_many_tetrahedra(leaves * tetrahedra_of_leaf);
}

/// The size field takes much memory, so its lifetime ends here.
Octree make_octree(const DomainSurface& surface, const LatticeOptions& options) {
  const TargetSizes size =
      target_sizes(surface, options.edge_length, options.grading, options.wanted, options.surface_factor);
  check_number_of_points(surface, size);
  Octree tree = build_octree(surface, size, options.kind);
  if (options.most_tetrahedra > 0) check_number_of_leaves(tree, options);
  return tree;
}

/// Are all leaves around an inner leaf also inner leaves of its level?
bool is_in_one_level(const Octree& tree, const OctreeNode& leaf) {
  for (std::uint32_t i = 0; i < 27; ++i) {
    const std::array<std::uint32_t, 3> step = {i % 3, i / 3 % 3, i / 9};
    std::array<std::uint32_t, 3> corner;
    // Below 0 wraps around to a large number.
    for (int k = 0; k < 3; ++k) corner[k] = leaf.corner[k] + (step[k] - 1) * tree.side(leaf);
    if (std::ranges::max(corner) >= tree.side(tree.nodes[0])) return false;
    const OctreeNode& other = tree.leaf_at(corner);
    if (other.level != leaf.level || other.place != NodePlace::inside) return false;
  }
  return true;
}

double share_in_one_level(const Octree& tree) {
  constexpr std::uint32_t every = 16;
  std::vector<const OctreeNode*> sample;
  std::uint32_t leaves = 0;
  for (const OctreeNode& node : tree.nodes)
    if (node.is_leaf() && node.place == NodePlace::inside && leaves++ % every == 0) sample.push_back(&node);
  std::vector<char> in_one_level(sample.size());
  parallel_for(sample.size(), 256, [&](std::size_t i) { in_one_level[i] = is_in_one_level(tree, *sample[i]); });
  const auto count = static_cast<double>(std::ranges::count(in_one_level, 1));
  return sample.empty() ? 0 : count / static_cast<double>(sample.size());
}

/// The place of a leaf that touches a lattice point of another leaf, if one of these leaves is not on the surface.
NodePlace place_beside(const Octree& tree, const std::array<std::uint32_t, 3>& point, const OctreeNode& leaf) {
  for (const unsigned axes : {1u, 2u, 4u, 3u, 5u, 6u, 7u}) {
    std::array<std::uint32_t, 3> beside = point;
    bool is_on_border = true;
    for (unsigned k = 0; k < 3; ++k) {
      if ((axes >> k & 1u) == 0) continue;
      is_on_border = is_on_border && point[k] == leaf.corner[k];
      --beside[k];
    }
    if (!is_on_border) continue;
    if (const NodePlace place = tree.leaf_at(beside).place; place != NodePlace::surface) return place;
  }
  return NodePlace::surface;
}

/// Is a lattice point, which is within the bounds of the surface, strictly inside the domain?
bool is_site_inside(const Octree& tree, const DomainSurface& surface, const std::array<std::uint32_t, 3>& point,
                    const OctreeNode& leaf) {
  const NodePlace place = leaf.place == NodePlace::surface ? place_beside(tree, point, leaf) : leaf.place;
  return place == NodePlace::surface ? is_inside(tree, surface, tree.point(point), leaf) : place == NodePlace::inside;
}

/// Sorts things with corners among the vertices along a space-filling curve, so that neighbors in space are neighbors
/// in memory. Each is placed at the sum of its corners.
template <class Thing, class Corners>
RawVector<Thing> in_morton_order(std::span<const Point3> vertices, std::span<const Thing> things,
                                 const Corners& corners_of) {
  RawVector<Point3> places(things.size());
  parallel_for(things.size(), 4096, [&](std::size_t i) {
    Point3 sum;
    for (const VertexId v : corners_of(things[i])) sum = sum + vertices[v];
    places[i] = sum;
  });
  const std::vector<std::uint32_t> order = morton_order(places);
  RawVector<Thing> sorted(things.size());
  parallel_for(things.size(), 4096, [&](std::size_t i) { sorted[i] = things[order[i]]; });
  return sorted;
}

}  // namespace

void check_number_of_points(const DomainSurface& surface, const TargetSizes& size) {
  const double largest = size.field.largest();
  if (largest == HUGE_VAL) return;
  const double points = std::sqrt(2.0) * volume_inside(surface) / (largest * largest * largest);
  if (points > plc::most_vertices) plc::throw_too_many_vertices(points);
}

LatticePoints place_lattice_points(const DomainSurface& any_order, const LatticeOptions& options,
                                   const Progress& progress) {
  if (options.kind == Lattice::none || any_order.triangles.empty()) return {};
  const RawVector<SurfaceTriangle> triangles =
      in_morton_order(any_order.vertices, any_order.triangles, [](const SurfaceTriangle& t) { return t.vertices; });
  const RawVector<std::array<VertexId, 2>> subsegments =
      in_morton_order(any_order.vertices, any_order.subsegments, [](const std::array<VertexId, 2>& s) { return s; });
  const DomainSurface surface{any_order.vertices, triangles, subsegments};
  constexpr std::uint64_t steps = 4;
  report(progress, stage, 0, steps);
  const Octree tree = make_octree(surface, options);
  report(progress, stage, 1, steps);
  const std::vector<Site> sites = list_sites(tree, options.kind);
  report(progress, stage, 2, steps);
  const std::vector<std::uint8_t> stays = find_clear_sites(tree, surface, sites, options);
  report(progress, stage, 3, steps);

  LatticePoints result{{}, {}, {}, options.kind, tree.origin, tree.unit, tree.depth, share_in_one_level(tree)};
  std::vector<std::uint8_t> levels(sites.size(), outside);
  parallel_for(sites.size(), 1024, [&](std::size_t i) {
    if (!stays[i]) return;
    const auto coordinates = coordinates_of(sites[i]);
    const OctreeNode& leaf = tree.leaf_at(coordinates);
    if (is_site_inside(tree, surface, coordinates, leaf)) levels[i] = leaf.level;
  });
  const auto kept = parallel_select(sites.size(), 8192, [&](std::size_t i) { return levels[i] != outside; });
  result.points.resize(kept.size());
  result.levels.resize(kept.size());
  result.later_rounds.resize(kept.size());
  parallel_for(kept.size(), 4096, [&](std::size_t i) {
    result.points[i] = tree.point(coordinates_of(sites[kept[i]]));
    result.levels[i] = levels[kept[i]];
    result.later_rounds[i] = later_rounds(sites[kept[i]], tree.depth - levels[kept[i]]);
  });
  const auto vertices = static_cast<double>(surface.vertices.size() + result.points.size());
  if (vertices > plc::most_vertices) plc::throw_too_many_vertices(vertices);
  report(progress, stage, steps, steps);
  return result;
}

void keep_only(std::span<const std::uint32_t> those, LatticePoints& points) {
  std::size_t kept = 0;
  for (const std::uint32_t i : those) {
    points.points[kept] = points.points[i];
    points.levels[kept] = points.levels[i];
    points.later_rounds[kept++] = points.later_rounds[i];
  }
  points.points.resize(kept);
  points.levels.resize(kept);
  points.later_rounds.resize(kept);
}

}  // namespace ccdt::lattice
