#include "bench/verify/piece_tree.h"

#include <cmath>

namespace ccdt::verification {

namespace {

namespace geometry = boost::geometry;
using Corner = geometry::model::point<double, 3, geometry::cs::cartesian>;
using Box = geometry::model::box<Corner>;

std::vector<std::pair<Box, std::uint32_t>> boxes_of(const Surface& surface) {
  std::vector<std::pair<Box, std::uint32_t>> items;
  items.reserve(surface.pieces());
  for (std::uint32_t p = 0; p < surface.pieces(); ++p) {
    Point3 low = surface.origin(p), high = low;
    for (std::uint32_t i = surface.piece_begin[p]; i < surface.piece_begin[p + 1]; ++i) {
      const Point3& v = surface.at(surface.directed[i][0]);
      low = {std::min(low.x, v.x), std::min(low.y, v.y), std::min(low.z, v.z)};
      high = {std::max(high.x, v.x), std::max(high.y, v.y), std::max(high.z, v.z)};
    }
    items.emplace_back(Box(Corner(low.x, low.y, low.z), Corner(high.x, high.y, high.z)), p);
  }
  return items;
}

double squared_distance(const Point3& p, const Point3& a, const Point3& b) {
  const double along = std::clamp(dot(p - a, b - a) / squared_length(b - a), 0.0, 1.0);
  return squared_length(p - a - along * (b - a));
}

}  // namespace

PieceTree::PieceTree(const Surface& surface) : tolerance_(surface.tolerances.flat), tree_(boxes_of(surface)) {}

Place place_of(const Surface& surface, std::uint32_t piece, const Point3& p) {
  const Point3& area = surface.area_vector[piece];
  const double size = std::sqrt(squared_length(area));
  if (std::fabs(dot(area, p - surface.origin(piece))) > surface.tolerances.flat * size) return Place::off;
  const double tolerance = surface.tolerances.place;
  // Across the plane's most upright axis, counting the edges to one side of the point.
  const auto n = as_array(area);
  std::size_t axis = 0;
  for (std::size_t i = 1; i < 3; ++i)
    if (std::fabs(n[i]) > std::fabs(n[axis])) axis = i;
  const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
  const auto c = as_array(p);
  bool inside = false;
  for (std::uint32_t i = surface.piece_begin[piece]; i < surface.piece_begin[piece + 1]; ++i) {
    const Point3 &from = surface.at(surface.directed[i][0]), &to = surface.at(surface.directed[i][1]);
    if (squared_distance(p, from, to) <= tolerance * tolerance) return Place::border;
    const auto a = as_array(from), b = as_array(to);
    if ((a[v] > c[v]) != (b[v] > c[v]) && c[u] < a[u] + (c[v] - a[v]) / (b[v] - a[v]) * (b[u] - a[u])) inside = !inside;
  }
  return inside ? Place::within : Place::off;
}

}  // namespace ccdt::verification
