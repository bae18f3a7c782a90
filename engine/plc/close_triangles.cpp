#include "engine/plc/close_triangles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "engine/base/parallel.h"
#include "engine/numbers/filters.h"

namespace ccdt::plc {
namespace {

/// The corners of two triangles, those that they share first.
struct CornerPairs {
  std::array<VertexTriple, 2> corners;
  int common = 0;

  CornerPairs(const VertexTriple& s, const VertexTriple& t) : corners{s, t} {
    for (int i = 0; i < 3; ++i)
      for (int j = common; j < 3; ++j)
        if (corners[0][i] == corners[1][j]) {
          std::swap(corners[0][i], corners[0][common]);
          std::swap(corners[1][j], corners[1][common]);
          ++common;
          break;
        }
  }
};

/// Are the corners of a triangle, from the given one on, certainly on the same side of another's plane? Like
/// `orient3d_filter`, with one normal for all.
bool are_on_one_side(std::span<const Point3> vertices, const VertexTriple& plane, const VertexTriple& corners,
                     int from) {
  using numbers::filter::larger;
  const Point3& a = vertices[plane[0]];
  const Point3 u = vertices[plane[1]] - a, v = vertices[plane[2]] - a, normal = cross(u, v);
  const auto largest = [](double s, double t) { return larger(std::fabs(s), std::fabs(t)); };
  const Point3 most = {largest(u.x, v.x), largest(u.y, v.y), largest(u.z, v.z)};
  bool is_above = false, is_below = false;
  for (int i = from; i < 3; ++i) {
    const Point3 w = vertices[corners[i]] - a;
    const double height = dot(w, normal),
                 bound = numbers::orient3d_error * largest(most.x, w.x) * largest(most.y, w.y) * largest(most.z, w.z);
    if (std::fabs(height) <= bound) return false;
    (height > 0 ? is_above : is_below) = true;
  }
  return is_above != is_below;
}

/// Does a plane through the only common corner, across an axis, show that the triangles share nothing else?
bool are_apart_at_corner(std::span<const Point3> vertices, const CornerPairs& pair) {
  const auto& [s, t] = pair.corners;
  const auto divides = [&](auto axis) {
    const double at = vertices[s[0]].*axis;
    const auto [s_low, s_high] = std::minmax({vertices[s[1]].*axis, vertices[s[2]].*axis});
    const auto [t_low, t_high] = std::minmax({vertices[t[1]].*axis, vertices[t[2]].*axis});
    return (s_high <= at && at <= t_low && s_high < t_low) || (t_high <= at && at <= s_low && t_high < s_low);
  };
  return divides(&Point3::x) || divides(&Point3::y) || divides(&Point3::z);
}

/// With what they share, for which both signs would be zero, in that plane.
bool are_apart(std::span<const Point3> vertices, const CornerPairs& pair) {
  const auto& [s, t] = pair.corners;
  if (pair.common == 3 || (pair.common == 1 && are_apart_at_corner(vertices, pair))) return true;
  return are_on_one_side(vertices, t, s, pair.common) || are_on_one_side(vertices, s, t, pair.common);
}

}  // namespace

RawVector<Box> boxes_of(std::span<const Point3> vertices, const TriangleSet& triangles) {
  RawVector<Box> boxes(triangles.size());
  parallel_for(boxes.size(), 4096,
               [&](std::size_t t) { boxes[t] = bounding_box(points_of(vertices, triangles.corners[t])); });
  return boxes;
}

std::vector<TrianglePair> find_close_triangles(std::span<const Point3> vertices, const TriangleSet& triangles,
                                               const BoxTree& tree, std::span<const std::uint8_t> is_doubtful) {
  return tree.collect_from_pairs<TrianglePair>(is_doubtful,
                                               [&](std::vector<TrianglePair>& close, std::uint32_t i, std::uint32_t j) {
                                                 if (!are_apart(vertices, {triangles.corners[i], triangles.corners[j]}))
                                                   close.push_back({i, j});
                                               });
}

}  // namespace ccdt::plc
