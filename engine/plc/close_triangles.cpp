#include "engine/plc/close_triangles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numeric>
#include <utility>

#include "engine/base/count_work.h"
#include "engine/base/parallel.h"
#include "engine/geometry/contacts.h"
#include "engine/geometry/integer_points.h"

namespace ccdt::plc {
namespace {

/// The plane of a triangle, in floating point.
class RoundedPlane {
 public:
  RoundedPlane() = default;
  explicit RoundedPlane(const std::array<Point3, 3>& t) : point_(t[0]), normal_(area_vector(t)) {
    const Point3 u = t[1] - t[0], v = t[2] - t[0];
    const auto sum = [](double p, double q) { return std::fabs(p) + std::fabs(q); };
    least_ = 4 * (sum(u.y * v.z, u.z * v.y) + sum(u.z * v.x, u.x * v.z) + sum(u.x * v.y, u.y * v.x));
  }

  const Point3& normal() const { return normal_; }

  /// The side that a point is certainly on; 0 if not known. Differences of points are exact and at most 2^52 + 2^21,
  /// and each product in the normal takes part in five roundings. So the error is below 2.51 times the sum of their
  /// magnitudes.
  int side_of(const Point3& p) const {
    const double height = dot(normal_, p - point_);
    return height > least_ ? 1 : height < -least_ ? -1 : 0;
  }

 private:
  Point3 point_, normal_;
  double least_;  ///< of magnitudes with a certain sign
};

/// Quick tests of pairs of triangles.
class TrianglePairs {
 public:
  TrianglePairs(std::span<const Point3> vertices, std::span<const VertexTriple> triangles)
      : vertices_(vertices), triangles_(triangles), planes_(triangles.size()) {
    parallel_for(planes_.size(), 4096,
                 [&](std::size_t t) { planes_[t] = RoundedPlane(points_of(vertices, triangles[t])); });
  }

  /// Do two triangles certainly share nothing but corners and edges of both?
  bool are_apart(std::uint32_t i, std::uint32_t j) const {
    if (is_on_one_side(i, j) || is_on_one_side(j, i)) return true;
    VertexTriple s = triangles_[i], t = triangles_[j];
    const int common = put_common_first(s, t);
    if (common == 3) return true;
    // Triangles in one plane are projected along the same axis. Otherwise, one may touch the other's plane from one
    // side.
    const std::array<Point3, 3> p = points_of(vertices_, s), q = points_of(vertices_, t);
    const int axis = dominant_axis(planes_[i].normal()), other_axis = dominant_axis(planes_[j].normal());
    return are_apart_seen_along(axis, p, q, common) ||
           (other_axis != axis && are_apart_seen_along(other_axis, p, q, common));
  }

  std::size_t bytes() const { return bytes_of(planes_); }

 private:
  /// Is a triangle certainly on one side of the other's plane, except for common corners?
  bool is_on_one_side(std::uint32_t triangle, std::uint32_t of) const {
    int side = 0;
    for (const VertexId v : triangles_[triangle]) {
      const int its_side = planes_[of].side_of(vertices_[v]);
      if (its_side == 0 ? !has_corner(triangles_[of], v) : its_side == -side) return false;
      if (its_side != 0) side = its_side;
    }
    return side != 0;
  }

  std::span<const Point3> vertices_;
  std::span<const VertexTriple> triangles_;
  RawVector<RoundedPlane> planes_;
};

}  // namespace

BoxTree tree_of(std::span<const Point3> vertices, const TriangleSet& triangles) {
  return {triangles.corners, [&](const VertexTriple& corners) { return bounding_box(points_of(vertices, corners)); }};
}

std::vector<TrianglePair> find_close_triangles(std::span<const Point3> vertices, const TriangleSet& triangles,
                                               std::span<const std::uint8_t> is_doubtful) {
  const auto may_cross = [&](std::uint32_t t) { return is_doubtful.empty() || is_doubtful[t] != 0; };
  std::vector<std::uint32_t> all(triangles.size()), doubtful;
  std::iota(all.begin(), all.end(), 0u);
  std::ranges::copy_if(all, std::back_inserter(doubtful), may_cross);
  // If few are doubtful, searching a tree of these for each triangle is faster than making a tree of all.
  constexpr std::size_t triangles_for_one = 64;
  const bool are_few = doubtful.size() < all.size() / triangles_for_one;
  const std::vector<std::uint32_t>&in_tree = are_few ? doubtful : all, &sought = are_few ? all : doubtful;
  const auto box = [&](std::uint32_t t) { return bounding_box(points_of(vertices, triangles.corners[t])); };
  const BoxTree tree(in_tree, box);
  const TrianglePairs pairs(vertices, triangles.corners);
  std::vector<TrianglePair> close = parallel_collect<TrianglePair>(
      sought.size(), 256, [&](std::size_t i, std::size_t end, std::vector<TrianglePair>& found) {
        for (; i < end; ++i) {
          const std::uint32_t s = sought[i];
          tree.for_each_meeting(box(s), [&](std::uint32_t place) {
            const std::uint32_t t = in_tree[place];
            if (t == s || (t < s && may_cross(s) && may_cross(t))) return;  // the pair is found from t
            if (!pairs.are_apart(s, t)) found.push_back({s, t});
          });
        }
      });
  note_bytes(bytes_of(vertices, triangles.corners, all, doubtful, close) + tree.bytes() + pairs.bytes());
  return close;
}

}  // namespace ccdt::plc
