#include "engine/steps/tetrahedralize_vertices.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "engine/base/errors.h"
#include "engine/base/hash_table.h"
#include "engine/delaunay/hilbert_order.h"
#include "engine/geometry/predicates.h"
#include "engine/plc/period.h"

namespace ccdt::steps {
namespace {

/// The points that repeat each other, one list for each place of the period, sorted by coordinates; the lists are in
/// the order of a Hilbert curve.
std::vector<std::vector<std::uint32_t>> repeated_points(std::span<const Point3> points, const plc::Period& period) {
  std::vector<Point3> places;
  std::vector<std::vector<std::uint32_t>> at_place;
  HashTable<std::array<std::int64_t, 3>, std::uint32_t> number_of;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    if (period.sides_of(points.subspan(i, 1)) == 0) continue;
    const Point3 place = period.folded(points[i]);
    const std::array key = {std::int64_t(place.x), std::int64_t(place.y), std::int64_t(place.z)};
    const auto [number, is_new] = number_of.insert(key, static_cast<std::uint32_t>(places.size()));
    if (is_new) places.push_back(place), at_place.emplace_back();
    at_place[*number].push_back(i);
  }
  std::vector<std::vector<std::uint32_t>> in_order;
  for (std::vector<std::uint32_t>& list : at_place)
    std::ranges::sort(list, {}, [&](std::uint32_t i) { return as_array(points[i]); });
  for (const std::uint32_t i : delaunay::hilbert_order(places)) in_order.push_back(std::move(at_place[i]));
  return in_order;
}

bool extends_simplex(std::span<const Point3> simplex, const Point3& p) {
  switch (simplex.size()) {
    case 0:
      return true;
    case 1:
      return !(p == simplex[0]);
    case 2:
      return !collinear(simplex[0], simplex[1], p);
    case 3:
      return orient3d(simplex[0], simplex[1], simplex[2], p) != 0;
    default:
      return false;
  }
}

/// An order in which the vertices of one side are as those of the opposite side. Insertion begins with the first four
/// that are not in one plane. Those that repeat these follow at once, so that this does not change the order of a side.
std::vector<std::uint32_t> repeated_order(std::span<const Point3> points, const plc::Period& period) {
  std::vector<std::vector<std::uint32_t>> lists = repeated_points(points, period);
  std::vector<Point3> simplex;
  std::ranges::stable_partition(lists, [&](const std::vector<std::uint32_t>& list) {
    const std::size_t before = simplex.size();
    for (const std::uint32_t i : list)
      if (extends_simplex(simplex, points[i])) simplex.push_back(points[i]);
    return simplex.size() > before;
  });
  std::vector<std::uint32_t> order;
  for (const std::vector<std::uint32_t>& list : lists) order.insert(order.end(), list.begin(), list.end());
  return order;
}

}  // namespace

std::optional<delaunay::Delaunay> tetrahedralize_vertices(std::span<const Point3> points, Run& run) {
  const bool stays = run.options.delaunay != DelaunayMethod::wrap;
  return run.measured(stays ? Stage::delaunay : Stage::protect, [&]() -> std::optional<delaunay::Delaunay> {
    try {
      if (run.options.periodic == plc::Periodicity::none) return delaunay::build_delaunay(points, run.progress);
      const plc::Period period = plc::period_of(points, run.options.periodic);
      return delaunay::build_delaunay(points, run.progress, repeated_order(points, period));
    } catch (const MeshError&) {
      return {};
    }
  });
}

}  // namespace ccdt::steps
