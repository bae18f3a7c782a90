#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <utility>

#include "engine/base/point.h"

/// Where triangles and segments meet. All decisions are exact, for any points of the grid (grid.h).
namespace ccdt {

/// A point where two elements meet but should not; the decision is exact, the point is rounded.
struct Contact {
  Point3 where;
  bool coplanar = false;
};

/// Where a segment meets a triangle, both closed; nothing if they are apart.
std::optional<Contact> meet_segment_triangle(const Point3& p, const Point3& q, const std::array<Point3, 3>& triangle);

/// Where two triangles without a common vertex meet, both closed.
std::optional<Contact> meet_triangles(const std::array<Point3, 3>& s, const std::array<Point3, 3>& t);

/// Where two triangles with only the common corner s[0] = t[0] meet elsewhere.
std::optional<Contact> meet_triangles_at_corner(const std::array<Point3, 3>& s, const std::array<Point3, 3>& t);

/// Where two triangles meet besides their common corners and the edge between these. The common corners, up to two,
/// come first in both.
std::optional<Contact> meet_elsewhere(const std::array<Point3, 3>& s, const std::array<Point3, 3>& t, int common);

/// Where a segment from a corner of a triangle, t[0], meets the triangle elsewhere.
std::optional<Contact> meet_segment_at_corner(const Point3& end, const std::array<Point3, 3>& t);

/// Where two segments meet, both closed; they need not be in one plane.
std::optional<Contact> meet_segments(const Point3& p, const Point3& q, const Point3& a, const Point3& b);

/// Is the point within the closed triangle, in space?
///
/// \param axis  an axis that the triangle's plane is not parallel to
bool is_on_triangle(int axis, const Point3& p, const std::array<Point3, 3>& triangle);

/// Is the point between the ends of the segment, in space, ends excluded?
bool is_within_segment(const Point3& p, const Point3& a, const Point3& b);

/// Seen along an axis, does the line of an edge of one of two triangles separate the two, so that they share only
/// common corners? False does not mean that they meet.
///
/// \param common  the number of common corners, up to two, which come first in both
bool are_apart_seen_along(int axis, const std::array<Point3, 3>& s, const std::array<Point3, 3>& t, int common);

// ---- Steps of these ------------------------------------------------------------------------------------------------

/// Rotates the corners of two triangles, given by ids, until the common ones come first in both.
///
/// \return  their number
template <class Id>
int put_common_first(std::array<Id, 3>& s, std::array<Id, 3>& t) {
  std::array<bool, 3> in_t, in_s;
  int common = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    in_t[i] = s[i] == t[0] || s[i] == t[1] || s[i] == t[2];
    in_s[i] = t[i] == s[0] || t[i] == s[1] || t[i] == s[2];
    common += in_t[i] ? 1 : 0;
  }
  const auto turn = [](std::array<Id, 3>& corners, const std::array<bool, 3>& is_common) {
    for (std::size_t i = 0; i < 3; ++i)
      if (is_common[i] && !is_common[(i + 2) % 3]) {
        corners = {corners[i], corners[(i + 1) % 3], corners[(i + 2) % 3]};
        return;
      }
  };
  turn(s, in_t), turn(t, in_s);
  return common;
}

/// Do two triangles, given by ids, share more than corners and edges?
///
/// \param point  `point(id)`
template <class Id, class PointOf>
bool cross_or_fold(std::array<Id, 3> s, std::array<Id, 3> t, const PointOf& point) {
  const int common = put_common_first(s, t);
  const auto points_of = [&](const std::array<Id, 3>& c) { return std::array{point(c[0]), point(c[1]), point(c[2])}; };
  return common == 3 || meet_elsewhere(points_of(s), points_of(t), common).has_value();
}

/// The sides of a plane that three points are on: 1, 0 or -1.
using Sides = std::array<int, 3>;

/// The sides of a triangle's plane that the corners of another triangle are on.
Sides sides_of(const std::array<Point3, 3>& plane, const std::array<Point3, 3>& corners);

constexpr bool are_on_one_side(const Sides& sides) {
  return sides[0] == sides[1] && sides[1] == sides[2] && sides[0] != 0;
}

/// Does the line from p to q pass the plane of a triangle inside the triangle?
bool passes_through(const Point3& p, const Point3& q, const std::array<Point3, 3>& triangle);

}  // namespace ccdt
