#include <algorithm>
#include <array>
#include <functional>
#include <utility>
#include <vector>

#include "bench/verify/surface.h"

namespace ccdt::verify {

namespace {

/// A side of a piece: its first corner and the sites that split it.
using Side = std::vector<std::uint32_t>;

void append_edges(const Side& side, std::uint32_t end, std::vector<Edge>& edges) {
  for (std::size_t k = 0; k < side.size(); ++k) edges.push_back({side[k], k + 1 < side.size() ? side[k + 1] : end});
}

/// Adds a triangle with split sides in parts. A site very near a corner cuts off a needle, which may lie flat with the
/// facet across its long side.
class PartsOfTriangle {
 public:
  using Add = std::function<void(std::span<const Edge>)>;

  PartsOfTriangle(const Surface& surface, Add add) : surface_(surface), add_(std::move(add)) {}

  void add(std::array<Side, 3> sides) const {
    for (int turn = 0; turn < 3; ++turn) {
      const auto& [ab, bc, ca] = sides;
      const std::uint32_t b = bc[0], c = ca[0];
      if (ab.size() > 1 && is_needle(ab[0], ab[1], c)) {
        add_whole({Side{ab[0]}, Side{ab[1]}, ca});
        return add({Side(ab.begin() + 1, ab.end()), bc, Side{c}});
      }
      if (ab.size() > 1 && is_needle(ab.back(), b, c)) {
        add_whole({Side{ab.back()}, bc, Side{c}});
        return add({Side(ab.begin(), ab.end() - 1), Side{ab.back()}, ca});
      }
      std::rotate(sides.begin(), sides.begin() + 1, sides.end());
    }
    add_whole(sides);
  }

 private:
  void add_whole(const std::array<Side, 3>& sides) const {
    std::vector<Edge> outline;
    for (std::size_t i = 0; i < 3; ++i) append_edges(sides[i], sides[(i + 1) % 3][0], outline);
    add_(outline);
  }

  /// Is the triangle, whose side ab is short, so low that it may lie flat with a triangle across a sharp edge?
  bool is_needle(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    const Point3 ab = surface_.at(b) - surface_.at(a), ac = surface_.at(c) - surface_.at(a);
    const double most = 10 * surface_.tolerances.flat;
    return squared_length(ab) < 0.01 * squared_length(ac) &&
           squared_length(cross(ab, ac)) <= most * most * squared_length(ac);
  }

  const Surface& surface_;
  Add add_;
};

}  // namespace

void split_directed(const std::function<std::vector<std::uint32_t>(std::uint32_t edge)>& within, Surface& surface) {
  const auto side_of = [&](std::uint32_t use) {
    Side side = within(surface.edge_of[use]);
    if (!surface.is_forward(use)) std::reverse(side.begin(), side.end());
    side.insert(side.begin(), surface.directed[use][0]);
    return side;
  };
  Pieces split;
  for (std::uint32_t p = 0; p < surface.pieces(); ++p) {
    const auto add = [&](std::span<const Edge> edges) { split.add(edges, surface.marker[p], surface.number[p]); };
    const auto uses = surface.uses_of(p);
    if (surface.is_triangle(p)) {
      PartsOfTriangle(surface, add).add({side_of(uses[0]), side_of(uses[1]), side_of(uses[2])});
      continue;
    }
    std::vector<Edge> edges;  // of several loops, perhaps
    for (const std::uint32_t use : uses) append_edges(side_of(use), surface.directed[use][1], edges);
    add(edges);
  }
  if (split.directed.size() > surface.directed.size()) set_pieces(std::move(split), surface);
}

}  // namespace ccdt::verify
