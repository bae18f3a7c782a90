#include "bench/verify/regions.h"

#include <algorithm>
#include <cmath>
#include <queue>

#include "bench/verify/exact.h"
#include "engine/base/union_find.h"

namespace ccdt::verify {

namespace {

enum class Crossing { no, up, down, grazes };

/// How the line through p and q crosses the triangle abc. Is it between p and q?
Crossing cross_triangle(const Point3& p, const Point3& q, const Point3& a, const Point3& b, const Point3& c) {
  const int ab = orientation(p, q, a, b), bc = orientation(p, q, b, c), ca = orientation(p, q, c, a);
  const int low = std::min({ab, bc, ca}), high = std::max({ab, bc, ca});
  if (low < 0 && high > 0) return Crossing::no;
  const int from = orientation(a, b, c, p), to = orientation(a, b, c, q);
  if (from * to > 0) return Crossing::no;
  if (from == 0 || to == 0 || low == 0 || high == 0) return Crossing::grazes;
  return from < 0 ? Crossing::up : Crossing::down;
}

/// How the line crosses a piece. For this test, a piece is the sum of the triangles that its directed edges make with
/// one of its vertices.
Crossing cross_piece(const Surface& surface, std::uint32_t piece, const Point3& p, const Point3& q) {
  const std::uint32_t origin = surface.directed[surface.piece_begin[piece]][0];
  int sum = 0;
  for (const auto& [a, b] : surface.edges_of(piece)) {
    if (a == origin || b == origin) continue;
    const Crossing crossing = cross_triangle(p, q, surface.at(origin), surface.at(a), surface.at(b));
    if (crossing == Crossing::grazes) return crossing;
    sum += crossing == Crossing::up ? 1 : crossing == Crossing::down ? -1 : 0;
  }
  return sum == 0 ? Crossing::no : sum > 0 ? Crossing::up : Crossing::down;
}

/// A number between -1 and 1 without a pattern that the input could share.
double scatter(int i) {
  const double x = std::sin(12.9898 * (i + 1)) * 43758.5453;
  return 2 * (x - std::floor(x)) - 1;
}

constexpr int attempts = 30;

struct Spoke {
  std::uint32_t use;
  double angle;
};

/// The side of a piece that faces growing angles around the edge of `use`, or falling angles.
std::uint32_t side(const Surface& surface, std::uint32_t use, bool growing) {
  return 2 * surface.piece_of[use] + (surface.is_forward(use) == growing ? 0 : 1);
}

/// The corner of a triangle opposite to one of its directed edges.
const Point3& apex(const Surface& surface, std::uint32_t use) {
  const std::uint32_t begin = surface.piece_begin[surface.piece_of[use]];
  return surface.at(surface.directed[begin + (use - begin + 2) % 3][0]);
}

/// Is `b` ahead of `a` around the edge? Nearly equal angles are decided exactly.
bool is_ahead(const Surface& surface, const Edge& edge, const Spoke& a, const Spoke& b) {
  const bool triangles = surface.is_triangle(surface.piece_of[a.use]) && surface.is_triangle(surface.piece_of[b.use]);
  if (!triangles || std::fabs(a.angle - b.angle) > 1e-6) return a.angle < b.angle;
  return orientation(surface.at(edge[0]), surface.at(edge[1]), apex(surface, a.use), apex(surface, b.use)) > 0;
}

/// The uses of an edge in the order of their angles around it, counterclockwise seen from its end.
std::vector<Spoke> spokes(const Surface& surface, std::uint32_t edge) {
  std::vector<Spoke> result;
  const Point3 axis = surface.at(surface.edges[edge][1]) - surface.at(surface.edges[edge][0]);
  Point3 first;
  for (const std::uint32_t use : surface.uses.of(edge)) {
    Point3 inward = cross(surface.area_vector[surface.piece_of[use]], axis);
    if (!surface.is_forward(use)) inward = -1.0 * inward;
    inward = normalized(inward);
    if (result.empty()) first = inward;
    const Point3 second = (1 / length(axis)) * cross(axis, first);
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
      const std::uint32_t a = surface.uses.of(e).front(), b = surface.uses.of(e).back();
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

/// Connected sets of pieces, and their nesting.
struct Shells {
  std::vector<std::uint32_t> of_piece;    ///< the shell of each piece, named by its first piece
  std::vector<std::uint32_t> outer_side;  ///< by shell: a side that faces outward
};

Shells find_shells(const Surface& surface) {
  UnionFind joined(surface.pieces());
  for (std::uint32_t e = 0; e < surface.edges.size(); ++e)
    for (const std::uint32_t use : surface.uses.of(e))
      joined.join(surface.piece_of[surface.uses.of(e).front()], surface.piece_of[use]);
  Shells shells;
  for (std::uint32_t p = 0; p < surface.pieces(); ++p) shells.of_piece.push_back(joined.find(p));
  shells.outer_side.assign(surface.pieces(), none);
  return shells;
}

/// A ray through a piece leaves its shell for the last time on the outside. From there to infinity, each piece faces
/// the one before. (The next piece alone is not enough: two shells may each be next to the other one.)
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
  const auto is_own = [&](const Hit& hit) { return shells.of_piece[hit.piece] == shell; };
  const auto last = std::ranges::find_if(hits->rbegin(), hits->rend(), is_own).base();
  if (last == hits->begin()) return false;  // a corner of a polygon that is not its own
  std::uint32_t left = shells.outer_side[shell] = (last - 1)->side_left();
  for (auto hit = last; hit != hits->end(); ++hit) {
    sides.join(left, hit->side_met());
    left = hit->side_left();
  }
  sides.join(left, infinity);
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
  number[sides.find(2 * surface.pieces())] = 0;
  std::uint32_t count = 1;
  for (std::uint32_t s = 0; s < 2 * surface.pieces(); ++s) {
    std::uint32_t& n = number[sides.find(s)];
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
  std::vector<std::vector<std::uint32_t>> neighbors(regions.count());
  for (std::size_t s = 0; s < regions.of_side.size(); s += 2) {
    const std::uint32_t above = regions.of_side[s], below = regions.of_side[s + 1];
    if (above == below) continue;
    neighbors[above].push_back(below);
    neighbors[below].push_back(above);
  }
  std::vector<std::uint32_t> depth(regions.count(), none);
  std::queue<std::uint32_t> queue({0});
  depth[0] = 0;
  for (; !queue.empty(); queue.pop())
    for (const std::uint32_t c : neighbors[queue.front()])
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

std::array<Point3, 3> corners_of(const Surface& surface, std::uint32_t triangle) {
  const auto edges = surface.edges_of(triangle);
  return {surface.at(edges[0][0]), surface.at(edges[1][0]), surface.at(edges[2][0])};
}

/// Sorts hits by their places on a ray: exactly, if they are triangles near each other.
/// \return  false if two are at the same place
bool sort_along(const Surface& surface, const Point3& start, const Point3& end, std::vector<Hit>& hits) {
  std::ranges::sort(hits, {}, &Hit::along);
  for (auto first = hits.begin(); first != hits.end();) {
    const auto is_far = [](const Hit& a, const Hit& b) { return b.along - a.along > 1e-6; };
    auto last = std::adjacent_find(first, hits.end(), is_far);
    if (last != hits.end()) ++last;
    const auto compare = [&](const Hit& a, const Hit& b) {
      return compare_along(start, end, corners_of(surface, a.piece), corners_of(surface, b.piece));
    };
    const bool are_triangles = std::all_of(first, last, [&](const Hit& hit) { return surface.is_triangle(hit.piece); });
    if (are_triangles && last - first > 1)
      std::sort(first, last, [&](const Hit& a, const Hit& b) { return compare(a, b) < 0; });
    const auto are_equal = [&](const Hit& a, const Hit& b) {
      return are_triangles ? compare(a, b) == 0 : b.along - a.along < 1e-12;
    };
    if (std::adjacent_find(first, last, are_equal) != last) return false;
    first = last;
  }
  return true;
}

void place_seeds(const plc::InputPlc& input, const Surface& surface, const RayShooter& rays, Regions& regions) {
  for (const auto& region : input.regions)
    for (const std::uint32_t c : regions_at(surface, regions, rays, region.seed))
      regions.attributes[c].push_back(region.attribute);
  for (const Point3& hole : input.holes)
    for (const std::uint32_t c : regions_at(surface, regions, rays, hole)) ++regions.hole_seeds[c];
}

}  // namespace

RayShooter::RayShooter(const Surface& surface)
    : surface_(surface), high_z_(-HUGE_VAL), tree_(surface.boxes_of_pieces(), surface.tolerances) {
  for (const Edge& e : surface.directed) high_z_ = std::max(high_z_, surface.at(e[0]).z);
}

Point3 RayShooter::direction(int attempt) {
  return {0.05 * scatter(2 * attempt), 0.05 * scatter(2 * attempt + 1), 1};
}

std::optional<std::vector<Hit>> RayShooter::shoot(const Point3& start, int attempt) const {
  const Point3 end = start + length(start.z) * direction(attempt);
  const Box around = hull(box_of(start), box_of(end));
  std::vector<Hit> hits;
  bool grazes = false;
  tree_.for_each_meeting(around, [&](std::uint32_t p) {
    const Crossing crossing = grazes ? Crossing::no : cross_piece(surface_, p, start, end);
    if (crossing == Crossing::no) return;
    const Point3& n = surface_.area_vector[p];
    const double rise = dot(n, end - start);
    grazes = crossing == Crossing::grazes || rise == 0;
    hits.push_back({p, dot(n, surface_.origin(p) - start) / rise, crossing == Crossing::down});
  });
  if (grazes) return std::nullopt;
  return sort_along(surface_, start, end, hits) ? std::optional(hits) : std::nullopt;
}

std::vector<std::uint32_t> RayShooter::pieces_near(const Point3& point) const {
  std::vector<std::uint32_t> near;
  tree_.for_each_meeting(expanded(box_of(point), surface_.tolerances.flat), [&](std::uint32_t p) {
    const Point3& n = surface_.area_vector[p];
    if (std::fabs(dot(n, point - surface_.origin(p))) <= surface_.tolerances.flat * ccdt::length(n)) near.push_back(p);
  });
  return near;
}

bool RayShooter::is_on_piece_across_axis(const Point3& point, const std::function<bool(std::uint32_t)>& counts) const {
  const double tolerance = surface_.tolerances.place;
  const auto shares = [&](std::uint32_t site, std::size_t axis) {
    return as_array(surface_.at(site))[axis] == as_array(point)[axis];
  };
  const auto shares_line = [&](const Edge& e) {  // one along an axis
    int shared = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) shared += shares(e[0], axis) && shares(e[1], axis);
    return shared >= 2;
  };
  const auto is_near = [&](const Edge& e) {
    const Point3 &a = surface_.at(e[0]), &b = surface_.at(e[1]);
    const double along = std::clamp(dot(point - a, b - a) / squared_length(b - a), 0.0, 1.0);
    return squared_length(point - a - along * (b - a)) <= tolerance * tolerance;
  };
  const auto is_on = [&](std::uint32_t p) {
    const auto edges = surface_.edges_of(p);
    const auto across = [&](std::size_t axis) {
      return std::ranges::all_of(edges, [&](const Edge& e) { return shares(e[0], axis); });
    };
    if (!across(0) && !across(1) && !across(2)) return false;
    if (std::ranges::any_of(edges, is_near))
      return std::ranges::any_of(edges, [&](const Edge& e) { return is_near(e) && shares_line(e); });
    return encloses(surface_.area_vector[p], edges, surface_.sites.position, point);
  };
  bool found = false;
  tree_.for_each_meeting(box_of(point), [&](std::uint32_t p) { found = found || (counts(p) && is_on(p)); });
  return found;
}

Regions find_regions(const plc::InputPlc& input, const Surface& surface) {
  const RayShooter rays(surface);
  UnionFind sides = glue_sides(surface);
  Shells shells = find_shells(surface);
  nest_shells(surface, rays, shells, sides);
  Regions regions;
  number_regions(surface, sides, regions);
  if (input.inside == plc::InputPlc::Inside::even_odd) {
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
    // Starts a little below the point, so that the ray meets a piece on which the point lies.
    const double back = 2 * surface.tolerances.place;
    const auto hits = rays.shoot(point - back * RayShooter::direction(i), i);
    if (!hits) continue;
    std::vector<std::uint32_t> found = {0};
    if (!hits->empty()) found[0] = regions.of_side[hits->front().side_met()];
    const double slope = length(RayShooter::direction(i));
    for (const Hit& hit : *hits) {
      if (hit.along * rays.length(point.z - back) * slope > 2 * back) break;
      found.push_back(regions.of_side[hit.side_left()]);
    }
    sort_and_unique(found);
    return found;
  }
  return {};
}

}  // namespace ccdt::verify
