#include "engine/repair/find_cuts.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "engine/base/parallel.h"
#include "engine/geometry/contacts.h"
#include "engine/geometry/integer_points.h"
#include "engine/geometry/predicates.h"

namespace ccdt::repair {
namespace {

using plc::VertexTriple;
using Triangle = std::array<Point3, 3>;

/// A triangle of a pair, and what is known about it.
struct Member {
  std::uint32_t number;
  VertexTriple corners;
  Triangle points;
  Sides sides;                         ///< of the corners, against the plane of the other triangle
  std::array<bool, 3> is_common = {};  ///< is it also a corner of the other triangle?
};

Member make_member(std::span<const Point3> vertices, std::uint32_t number, const VertexTriple& corners,
                   const VertexTriple& other) {
  Member member{number, corners, plc::points_of(vertices, corners), {}, {}};
  const Triangle plane = plc::points_of(vertices, other);
  for (std::size_t k = 0; k < 3; ++k) {
    member.is_common[k] = plc::has_corner(other, corners[k]);
    member.sides[k] = member.is_common[k] ? 0 : orient3d(plane[0], plane[1], plane[2], member.points[k]);
  }
  return member;
}

/// Distinct points, at most two of which are kept. The points where two triangles meet are on a line.
struct EndPoints {
  std::array<ExactPoint, 2> points;
  std::size_t count = 0;
  bool is_only_common = true;  ///< is there nothing but a common corner?

  void add(ExactPoint p, bool is_corner) {
    for (std::size_t i = 0; i < count; ++i)
      if (are_equal(points[i], p)) return;
    if (count == 2) return;  // does not happen: an interval has two ends
    points[count++] = std::move(p);
    is_only_common = is_only_common && is_corner;
  }
};

bool has_edge(const VertexTriple& t, VertexId a, VertexId b) {
  return plc::has_corner(t, a) && plc::has_corner(t, b);
}

/// Adds the points where an edge of one triangle, in the plane of the other, crosses the other's edges.
void add_crossings(const Member& one, std::size_t k, const Member& other, int axis, EndPoints& ends) {
  const Point3 &p = one.points[k], &q = one.points[plc::next_corner(k)];
  for (std::size_t j = 0; j < 3; ++j) {
    const Point3 &a = other.points[j], &b = other.points[plc::next_corner(j)];
    if (orient_along(axis, a, b, p) * orient_along(axis, a, b, q) < 0 &&
        orient_along(axis, p, q, a) * orient_along(axis, p, q, b) < 0)
      ends.add(meet_line(axis, p, q, a, b), false);
  }
}

/// Adds the points where the edges of one triangle meet the other, which is in another plane.
void add_ends(const Member& one, const Member& other, EndPoints& ends) {
  std::optional<ExactPlane> plane;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t l = plc::next_corner(k);
    if (one.is_common[k]) ends.add(exactly(one.points[k]), true);
    if (one.sides[k] == 0 && one.sides[l] == 0) {
      add_crossings(one, k, other, dominant_axis(other.points), ends);
    } else if (one.sides[k] * one.sides[l] < 0 && passes_through(one.points[k], one.points[l], other.points)) {
      if (!plane) plane = plane_of(other.points);
      ends.add(meet_plane(one.points[k], one.points[l], *plane), false);
    }
  }
}

void cut_across(const Member& s, const Member& t, std::vector<Cut>& cuts) {
  EndPoints ends;
  add_ends(s, t, ends);
  add_ends(t, s, ends);
  if (ends.is_only_common) return;
  if (ends.count == 1) ends.points[1] = ends.points[0];
  cuts.push_back({s.number, t.number, Cut::in_plane, ends.points});
  cuts.push_back({t.number, s.number, Cut::in_plane, std::move(ends.points)});
}

/// Cuts one triangle along the edges of the other, which is in the same plane.
void cut_along_edges(const Member& one, const Member& other, std::vector<Cut>& cuts) {
  const int axis = dominant_axis(one.points);
  for (std::size_t k = 0; k < 3; ++k) {
    if (has_edge(one.corners, other.corners[k], other.corners[plc::next_corner(k)])) continue;
    EndPoints ends;
    add_crossings(other, k, one, axis, ends);
    if (ends.count == 0) continue;
    for (const std::size_t end : {k, plc::next_corner(k)})
      if (other.is_common[end]) ends.add(exactly(other.points[end]), true);
    if (ends.count == 2) cuts.push_back({one.number, other.number, static_cast<int>(k), std::move(ends.points)});
  }
}

void find_cuts_of(std::span<const Point3> vertices, const plc::TriangleSet& triangles, const plc::TrianglePair& pair,
                  std::vector<Cut>& cuts) {
  const VertexTriple &first = triangles.corners[pair.first], &second = triangles.corners[pair.second];
  const Member s = make_member(vertices, pair.first, first, second);
  if (are_on_one_side(s.sides)) return;
  if (s.sides == Sides{}) {
    const Member t = make_member(vertices, pair.second, second, first);
    cut_along_edges(s, t, cuts);
    cut_along_edges(t, s, cuts);
    return;
  }
  if (std::ranges::count(s.is_common, true) >= 2) return;
  const Member t = make_member(vertices, pair.second, second, first);
  if (!are_on_one_side(t.sides)) cut_across(s, t, cuts);
}

}  // namespace

Cuts find_cuts(std::span<const Point3> vertices, const plc::TriangleSet& triangles,
               std::span<const plc::TrianglePair> close) {
  Cuts result;
  result.cuts =
      parallel_collect<Cut>(close.size(), 256, [&](std::size_t begin, std::size_t end, std::vector<Cut>& found) {
        for (; begin < end; ++begin) find_cuts_of(vertices, triangles, close[begin], found);
      });
  std::array<std::uint32_t, 2> last = {plc::no_face, plc::no_face};
  for (const Cut& cut : result.cuts) {
    const std::array<std::uint32_t, 2> pair = {std::min(cut.triangle, cut.by), std::max(cut.triangle, cut.by)};
    if (pair != last) ++result.pairs;
    last = pair;
  }
  return result;
}

}  // namespace ccdt::repair
