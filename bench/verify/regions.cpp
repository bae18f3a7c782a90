#include "bench/verify/regions.h"

#include <algorithm>
#include <cmath>
#include <queue>

#include "bench/verify/exact.h"
#include "bench/verify/union_find.h"

namespace ccdt::verification {

namespace {

constexpr int attempts = 30;

struct Spoke {
  std::uint32_t use;
  double angle;
};

/// The side of a piece that looks in the direction of growing angles around the edge of `use`, or of falling ones.
std::uint32_t side(const Surface& surface, std::uint32_t use, bool growing) {
  return 2 * surface.piece_of[use] + (surface.is_forward(use) == growing ? 0 : 1);
}

/// The corner of a triangle opposite to one of its directed edges.
const Point3& apex(const Surface& surface, std::uint32_t use) {
  const std::uint32_t begin = surface.piece_begin[surface.piece_of[use]];
  return surface.at(surface.directed[begin + (use - begin + 2) % 3][0]);
}

/// Is `b` ahead of `a` around the edge? Nearly equal angles are decided exactly.
bool is_ahead(const Surface& surface, const std::array<std::uint32_t, 2>& edge, const Spoke& a, const Spoke& b) {
  const bool triangles = surface.is_triangle(surface.piece_of[a.use]) && surface.is_triangle(surface.piece_of[b.use]);
  if (!triangles || std::fabs(a.angle - b.angle) > 1e-6) return a.angle < b.angle;
  return orientation(surface.at(edge[0]), surface.at(edge[1]), apex(surface, a.use), apex(surface, b.use)) > 0;
}

/// The uses of an edge in the order of their angles around it, counterclockwise seen from its end.
std::vector<Spoke> spokes(const Surface& surface, std::uint32_t edge) {
  std::vector<Spoke> result;
  const Point3 axis = surface.at(surface.edges[edge][1]) - surface.at(surface.edges[edge][0]);
  Point3 first;
  for (std::uint32_t i = surface.use_begin[edge]; i < surface.use_begin[edge + 1]; ++i) {
    const std::uint32_t use = surface.uses[i];
    Point3 inward = cross(surface.area_vector[surface.piece_of[use]], axis);
    if (!surface.is_forward(use)) inward = -1.0 * inward;
    if (const double length = std::sqrt(squared_length(inward)); length > 0) inward = (1 / length) * inward;
    if (result.empty()) first = inward;
    const Point3 second = (1 / std::sqrt(squared_length(axis))) * cross(axis, first);
    result.push_back({use, result.empty() ? 0 : std::atan2(dot(inward, second), dot(inward, first))});
  }
  std::sort(result.begin(), result.end(),
            [&](const Spoke& a, const Spoke& b) { return is_ahead(surface, surface.edges[edge], a, b); });
  return result;
}

/// Glues the sides that look at each other around each edge.
UnionFind glue_sides(const Surface& surface) {
  UnionFind sides(2 * surface.pieces() + 1);
  for (std::uint32_t e = 0; e < surface.edges.size(); ++e) {
    if (surface.use_count(e) <= 2) {
      const std::uint32_t a = surface.uses[surface.use_begin[e]], b = surface.uses[surface.use_begin[e + 1] - 1];
      sides.join(side(surface, a, true), side(surface, b, false));
      sides.join(side(surface, b, true), side(surface, a, false));
      continue;
    }
    const std::vector<Spoke> around = spokes(surface, e);
    for (std::size_t i = 0; i < around.size(); ++i)
      sides.join(side(surface, around[i].use, true), side(surface, around[(i + 1) % around.size()].use, false));
  }
  return sides;
}

/// Connected sets of pieces, and how they lie in each other.
struct Shells {
  std::vector<std::uint32_t> of_piece;
  std::vector<std::uint32_t> outer_side;  ///< a side of the shell that looks at what is around it
};

Shells find_shells(const Surface& surface) {
  UnionFind joined(surface.pieces());
  for (std::uint32_t e = 0; e < surface.edges.size(); ++e)
    for (std::uint32_t i = surface.use_begin[e] + 1; i < surface.use_begin[e + 1]; ++i)
      joined.join(surface.piece_of[surface.uses[i - 1]], surface.piece_of[surface.uses[i]]);
  Shells shells;
  std::vector<std::uint32_t> number(surface.pieces(), none);
  for (std::uint32_t p = 0; p < surface.pieces(); ++p) {
    std::uint32_t& n = number[joined.root(p)];
    if (n == none) {
      n = static_cast<std::uint32_t>(shells.outer_side.size());
      shells.outer_side.push_back(none);
    }
    shells.of_piece.push_back(n);
  }
  return shells;
}

/// A ray through a piece leaves its shell for the last time on the shell's outside. What it meets next is around the
/// shell.
bool nest_shell(const Surface& surface, const RayShooter& rays, std::uint32_t piece, int attempt, Shells& shells,
                UnionFind& sides) {
  const std::uint32_t begin = surface.piece_begin[piece], corners = surface.piece_begin[piece + 1] - begin;
  const auto corner = static_cast<std::uint32_t>(attempt) % corners;
  const auto [a, b] = surface.directed[begin + corner];
  const std::uint32_t c = surface.directed[begin + (corner + 1) % corners][1];
  const Point3 through = 0.29 * surface.at(a) + 0.37 * surface.at(b) + 0.34 * surface.at(c);
  const auto hits = rays.shoot(through - 0.01 * surface.tolerances.box * RayShooter::direction(attempt), attempt);
  if (!hits) return false;
  const std::uint32_t infinity = 2 * surface.pieces(), shell = shells.of_piece[piece];
  std::uint32_t around = infinity;
  for (const Hit& hit : *hits) {
    if (shells.of_piece[hit.piece] == shell) {
      shells.outer_side[shell] = 2 * hit.piece + (hit.from_above ? 1 : 0);
      around = infinity;
    } else if (around == infinity) {
      around = 2 * hit.piece + (hit.from_above ? 0 : 1);
    }
  }
  if (shells.outer_side[shell] == none) return false;  // a corner of a polygon that is not its own
  sides.join(shells.outer_side[shell], around);
  return true;
}

void nest_shells(const Surface& surface, const RayShooter& rays, Shells& shells, UnionFind& sides) {
  for (std::uint32_t p = 0; p < surface.pieces(); ++p)
    for (int i = 0; i < attempts && shells.outer_side[shells.of_piece[p]] == none; ++i)
      nest_shell(surface, rays, p, i, shells, sides);
}

/// Numbers the regions; the one at infinity is 0.
void number_regions(const Surface& surface, UnionFind& sides, Regions& regions) {
  std::vector<std::uint32_t> number(2 * surface.pieces() + 1, none);
  number[sides.root(2 * surface.pieces())] = 0;
  std::uint32_t count = 1;
  for (std::uint32_t s = 0; s < 2 * surface.pieces(); ++s) {
    std::uint32_t& n = number[sides.root(s)];
    if (n == none) n = count++;
    regions.of_side.push_back(n);
  }
  regions.inside.assign(count, Inside::yes);
  regions.inside[0] = Inside::no;
  regions.attributes.resize(count);
  regions.hole_seeds.assign(count, 0);
}

/// Of each region, the fewest pieces between it and infinity.
std::vector<std::uint32_t> depth_by_pieces(const Regions& regions) {
  std::vector<std::vector<std::uint32_t>> neighbours(regions.count());
  for (std::size_t s = 0; s < regions.of_side.size(); s += 2) {
    const std::uint32_t above = regions.of_side[s], below = regions.of_side[s + 1];
    if (above == below) continue;
    neighbours[above].push_back(below);
    neighbours[below].push_back(above);
  }
  std::vector<std::uint32_t> depth(regions.count(), none);
  std::queue<std::uint32_t> queue({0});
  depth[0] = 0;
  for (; !queue.empty(); queue.pop())
    for (const std::uint32_t c : neighbours[queue.front()])
      if (depth[c] == none) {
        depth[c] = depth[queue.front()] + 1;
        queue.push(c);
      }
  return depth;
}

/// Of each region, the number of shells that separate it from infinity: one more than the region around its own shell
/// has.
std::vector<std::uint32_t> depth_by_shells(const Regions& regions, const Shells& shells) {
  std::vector<std::uint32_t> shell_of(regions.count(), none);
  const auto region_around = [&](std::uint32_t shell) {
    return shells.outer_side[shell] == none ? 0 : regions.of_side[shells.outer_side[shell]];
  };
  for (std::uint32_t s = 0; s < regions.of_side.size(); ++s) {
    const std::uint32_t shell = shells.of_piece[s / 2], region = regions.of_side[s];
    if (region != 0 && region != region_around(shell)) shell_of[region] = shell;
  }
  std::vector<std::uint32_t> depth(regions.count(), 0);
  for (std::uint32_t c = 0; c < regions.count(); ++c)
    for (std::uint32_t outer = c; shell_of[outer] != none && depth[c] < regions.count(); ++depth[c])
      outer = region_around(shell_of[outer]);
  return depth;
}

void place_seeds(const InputPlc& input, const Surface& surface, const RayShooter& rays, Regions& regions) {
  for (const auto& region : input.regions)
    for (const std::uint32_t c : regions_at(surface, regions, rays, region.seed))
      regions.attributes[c].push_back(region.attribute);
  for (const Point3& hole : input.holes)
    for (const std::uint32_t c : regions_at(surface, regions, rays, hole)) ++regions.hole_seeds[c];
}

}  // namespace

Regions find_regions(const InputPlc& input, const Surface& surface) {
  const RayShooter rays(surface);
  UnionFind sides = glue_sides(surface);
  Shells shells = find_shells(surface);
  nest_shells(surface, rays, shells, sides);
  Regions regions;
  number_regions(surface, sides, regions);
  if (input.inside == InputPlc::Inside::even_odd) {
    const auto by_pieces = depth_by_pieces(regions), by_shells = depth_by_shells(regions, shells);
    for (std::uint32_t c = 0; c < regions.count(); ++c) {
      const bool odd = by_shells[c] % 2 == 1;
      regions.inside[c] = odd != (by_pieces[c] % 2 == 1) ? Inside::unknown : odd ? Inside::yes : Inside::no;
    }
  }
  place_seeds(input, surface, rays, regions);
  for (std::uint32_t c = 0; c < regions.count(); ++c)
    if (regions.hole_seeds[c] > 0) regions.inside[c] = Inside::no;
  return regions;
}

std::vector<std::uint32_t> regions_at(const Surface& surface, const Regions& regions, const RayShooter& rays,
                                      const Point3& point) {
  for (int i = 0; i < attempts; ++i) {
    // From a little below the point, so that a piece that it lies on is met.
    const double back = 2 * surface.tolerances.place;
    const auto hits = rays.shoot(point - back * RayShooter::direction(i), i);
    if (!hits) continue;
    std::vector<std::uint32_t> found = {0};
    if (!hits->empty()) found[0] = regions.of_side[2 * hits->front().piece + (hits->front().from_above ? 0 : 1)];
    const double slope = std::sqrt(squared_length(RayShooter::direction(i)));
    for (const Hit& hit : *hits) {
      if (hit.along * rays.length(point.z - back) * slope > 2 * back) break;
      found.push_back(regions.of_side[2 * hit.piece + (hit.from_above ? 1 : 0)]);
    }
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
  }
  return {};
}

}  // namespace ccdt::verification
