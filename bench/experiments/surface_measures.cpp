#include "bench/experiments/surface_measures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "bench/statistics.h"

namespace ccdt {
namespace {

constexpr double degrees = 180 / std::numbers::pi;

constexpr double least_kept_angle = 25;
constexpr double largest_kept_ratio = 2;      ///< of the 95th percentile of the edges to the 5th
constexpr double largest_kept_change = 1.25;  ///< of the median edge to the wanted length, or the other way round

double angle_between(const Point3& a, const Point3& b) {
  return degrees * std::atan2(std::sqrt(squared_length(cross(a, b))), dot(a, b));
}

/// A triangle at an edge, as seen along the edge from its smaller end to its greater.
struct Leaf {
  std::array<VertexId, 2> edge;
  VertexId opposite;
  bool inside_ahead = false;  ///< counterclockwise of it is the inside of the domain
  double angle = 0;           ///< radians, from the first leaf of the edge
};

std::vector<Leaf> leaves_of(const Plc& plc) {
  std::vector<Leaf> leaves;
  for (const Facet& facet : plc.facets)
    for (const auto& triangle : facet.triangles)
      for (std::size_t i = 0; i < 3; ++i) {
        const VertexId a = triangle[i], b = triangle[(i + 1) % 3];
        // From a to b the normal, which points above, is counterclockwise of the triangle.
        const RegionId ahead = a < b ? facet.above : facet.below;
        leaves.push_back({{std::min(a, b), std::max(a, b)}, triangle[(i + 2) % 3], plc.regions[ahead].inside, 0});
      }
  std::ranges::sort(leaves, {}, &Leaf::edge);
  return leaves;
}

/// Sorts the leaves of one edge counterclockwise.
template <class Leaves>
void sort_around(const Plc& plc, Leaves leaves) {
  const Point3& a = plc.world[leaves[0].edge[0]];
  const Point3 along = plc.world[leaves[0].edge[1]] - a, axis = 1 / std::sqrt(squared_length(along)) * along;
  const Point3 first = cross(axis, plc.world[leaves[0].opposite] - a), turned = cross(axis, first);
  for (Leaf& leaf : leaves) {
    const Point3 normal = cross(axis, plc.world[leaf.opposite] - a);
    const double angle = std::atan2(dot(normal, turned), dot(normal, first));
    leaf.angle = angle < 0 ? angle + 2 * std::numbers::pi : angle;
  }
  std::ranges::sort(leaves, {}, &Leaf::angle);
}

void take_smaller(SurfaceAngle& smallest, double angle, const Point3& at) {
  if (angle < smallest.degrees) smallest = {angle, at};
}

SurfaceAngle smallest_dihedral(const Plc& plc) {
  SurfaceAngle smallest;
  std::vector<Leaf> leaves = leaves_of(plc);
  for (auto begin = leaves.begin(); begin != leaves.end();) {
    const auto end = std::find_if(begin, leaves.end(), [&](const Leaf& leaf) { return leaf.edge != begin->edge; });
    const std::span around(begin, end);
    sort_around(plc, around);
    for (std::size_t i = 0; i < around.size(); ++i) {
      const bool is_last = i + 1 == around.size();
      const double next = is_last ? around[0].angle + 2 * std::numbers::pi : around[i + 1].angle;
      if (around[i].inside_ahead)
        take_smaller(smallest, degrees * (next - around[i].angle), plc.world[around[i].edge[0]]);
    }
    begin = end;
  }
  return smallest;
}

std::vector<double> edge_lengths(const Plc& plc) {
  std::vector<double> lengths;
  for (const Facet& facet : plc.facets)
    for (const auto& t : facet.triangles)
      for (std::size_t i = 0; i < 3; ++i)
        lengths.push_back(std::sqrt(squared_length(plc.world[t[(i + 1) % 3]] - plc.world[t[i]])));
  return lengths;
}

}  // namespace

SurfaceAngles smallest_angles(const Plc& plc) {
  SurfaceAngles angles;
  for (const Facet& facet : plc.facets)
    for (const auto& triangle : facet.triangles)
      for (std::size_t i = 0; i < 3; ++i) {
        const Point3& corner = plc.world[triangle[i]];
        take_smaller(
            angles.planar,
            angle_between(plc.world[triangle[(i + 1) % 3]] - corner, plc.world[triangle[(i + 2) % 3]] - corner),
            corner);
      }
  angles.dihedral = smallest_dihedral(plc);
  return angles;
}

double enclosed_volume(const Plc& plc) {
  double volume = 0;
  for (const Facet& facet : plc.facets) {
    const int sides = static_cast<int>(plc.regions[facet.below].inside) - plc.regions[facet.above].inside;
    if (sides == 0) continue;
    for (const auto& t : facet.triangles)
      volume += sides * dot(cross(plc.world[t[0]], plc.world[t[1]]), plc.world[t[2]]) / 6;
  }
  return volume;
}

bool has_even_triangles(const Plc& plc, double edge_length) {
  const std::vector<double> lengths = edge_lengths(plc);
  const double change = median(lengths) / edge_length;
  return std::max(change, 1 / change) <= largest_kept_change &&
         quantile(lengths, 0.95) <= largest_kept_ratio * quantile(lengths, 0.05) &&
         smallest_angles(plc).planar.degrees >= least_kept_angle;
}

}  // namespace ccdt
