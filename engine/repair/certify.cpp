#include "engine/repair/certify.h"

#include <algorithm>
#include <cmath>

#include "engine/base/parallel.h"
#include "engine/base/union_find.h"
#include "engine/geometry/surface_distance.h"
#include "engine/plc/edge_table.h"

namespace ccdt::repair {
namespace {

using plc::EdgeTable;

double area_of(const Corners& t) {
  return 0.5 * length(area_vector(t));
}

std::vector<Corners> corners_of(const plc::UncheckedPlc& soup) {
  std::vector<Corners> all;
  for (const plc::VertexTriple& t : soup.triangles.corners) all.push_back(plc::points_of(soup.plc.vertices, t));
  return all;
}

double sum_of_areas(std::span<const Corners> triangles) {
  double sum = 0;
  for (const Corners& t : triangles) sum += area_of(t);
  return sum;
}

std::uint64_t count_components(const EdgeTable& edges, std::size_t triangles) {
  UnionFind parts(triangles);
  std::uint64_t count = triangles;
  for (std::uint32_t e = 0; e < edges.size(); ++e) {
    const auto around = edges.around(e);
    for (const std::uint32_t t : around) {
      if (parts.find(t) == parts.find(around[0])) continue;
      parts.join(t, around[0]);
      --count;
    }
  }
  return count;
}

bool is_manifold(const EdgeTable& edges) {
  for (std::uint32_t e = 0; e < edges.size(); ++e)
    if (edges.sides_around(e).size() != 2) return false;
  return true;
}

/// By Euler's formula, over all components.
std::int64_t genus_of(const plc::UncheckedPlc& soup, const EdgeTable& edges, std::uint64_t components) {
  std::vector<char> is_used(soup.plc.vertices.size(), 0);
  for (const plc::VertexTriple& t : soup.triangles.corners)
    for (const VertexId v : t) is_used[v] = 1;
  const auto characteristic = static_cast<std::int64_t>(std::ranges::count(is_used, 1)) -
                              static_cast<std::int64_t>(edges.size()) +
                              static_cast<std::int64_t>(soup.triangles.size());
  return static_cast<std::int64_t>(components) - characteristic / 2;
}

/// By the orientation of the triangles; none if there are open edges.
std::optional<double> enclosed_volume(std::span<const Corners> triangles, const EdgeTable& edges) {
  for (std::uint32_t e = 0; e < edges.size(); ++e)
    if (edges.sides_around(e).size() % 2 != 0) return {};
  double sixfold = 0;
  for (const auto& [a, b, c] : triangles) sixfold += dot(a, cross(b, c));  // around the origin of the grid
  return std::fabs(sixfold) / 6;
}

}  // namespace

double reach_of(std::span<const Corners> lid, std::span<const Point3> rim) {
  std::vector<Corners> edges;  // as degenerate triangles
  for (std::size_t i = 0; i < rim.size(); ++i) {
    const Point3& next = rim[(i + 1) % rim.size()];
    edges.push_back({rim[i], next, next});
  }
  return farthest_point(lid, NearestTriangle(std::move(edges)), {.relative = 1.1}).bound;
}

Certificate certify(const plc::UncheckedPlc& given, const plc::UncheckedPlc& repaired, std::span<const Lid> lids) {
  const std::vector<Corners> before = corners_of(given), after = corners_of(repaired);
  std::vector<Corners> of_lids;
  Certificate result;
  const double unit = given.plc.grid.unit;
  for (const Lid& lid : lids) {
    result.largest_lid = std::max(result.largest_lid, unit * unit * sum_of_areas(lid.triangles));
    result.farthest_lid = std::max(result.farthest_lid, unit * lid.reach);
    of_lids.insert(of_lids.end(), lid.triangles.begin(), lid.triangles.end());
  }
  const NearestTriangle surface(before), filling(std::move(of_lids));
  std::vector<double> bounds(after.size());
  parallel_for(after.size(), 256, [&](std::size_t i) {
    bounds[i] = surface.squared_bound(after[i]);
    // A lid's pieces are on the lid, and not on the surface.
    if (bounds[i] > 0 && !lids.empty() && filling.squared_bound(after[i]) < bounds[i]) bounds[i] = -1;
  });
  double squared = 0;
  for (std::size_t i = 0; i < after.size(); ++i) {
    if (bounds[i] < 0) result.area_of_lids += unit * unit * area_of(after[i]);
    squared = std::max(squared, bounds[i]);
  }
  result.displacement = unit * std::sqrt(squared);
  result.area_before = unit * unit * sum_of_areas(before);
  result.area_after = unit * unit * sum_of_areas(after);
  result.area_removed = std::max(0.0, result.area_before + result.area_of_lids - result.area_after);
  const EdgeTable edges_before = plc::make_edge_table(given.triangles.corners),
                  edges_after = plc::make_edge_table(repaired.triangles.corners);
  if (const auto volume = enclosed_volume(before, edges_before)) result.volume_before = unit * unit * unit * *volume;
  result.components_before = count_components(edges_before, before.size());
  result.components_after = count_components(edges_after, after.size());
  if (is_manifold(edges_after)) result.genus = genus_of(repaired, edges_after, result.components_after);
  return result;
}

}  // namespace ccdt::repair
