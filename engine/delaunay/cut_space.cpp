#include "engine/delaunay/cut_space.h"

#include <algorithm>
#include <ranges>

namespace ccdt::delaunay {

SpaceCut::SpaceCut(std::span<const Point3> points, std::uint32_t parts, const Basis& basis) : basis_(basis) {
  std::vector<std::array<double, 3>> places;
  places.reserve(points.size());
  for (const Point3& p : points) places.push_back({dot(basis[0], p), dot(basis[1], p), dot(basis[2], p)});
  cut(places, parts);
}

void SpaceCut::cut(std::span<std::array<double, 3>> places, std::uint32_t parts) {
  if (parts == 1) {
    nodes_.push_back({3, part_count_++, 0});
    return;
  }
  std::uint32_t longest = 0;
  double most = -1;
  for (std::uint32_t axis = 0; axis < 3; ++axis) {
    const auto [low, high] =
        std::ranges::minmax(places | std::views::transform([&](const auto& p) { return p[axis]; }));
    if (high - low > most) most = high - low, longest = axis;
  }
  const std::uint32_t near_parts = parts / 2;
  const auto middle = places.begin() + static_cast<std::ptrdiff_t>(places.size() * near_parts / parts);
  std::ranges::nth_element(places, middle, {}, [&](const auto& p) { return p[longest]; });
  const std::size_t node = nodes_.size();
  nodes_.push_back({longest, 0, (*middle)[longest]});
  cut({places.begin(), middle}, near_parts);
  nodes_[node].after = static_cast<std::uint32_t>(nodes_.size());
  cut({middle, places.end()}, parts - near_parts);
}

}  // namespace ccdt::delaunay
