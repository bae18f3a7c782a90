#include "engine/geometry/surface_distance.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/base/box.h"
#include "engine/base/parallel.h"
#include "engine/geometry/closest_point.h"

namespace ccdt {
namespace {

/// A convex polygon in a plane.
using Polygon = std::vector<Point3>;

Point3 center_of(const TrianglePoints& t) {
  return (1.0 / 3) * (t[0] + t[1] + t[2]);
}

/// The corner from which the longest edge begins.
std::size_t longest_edge_of(const TrianglePoints& t) {
  const auto squared = [&](std::size_t k) { return squared_length(t[(k + 1) % 3] - t[k]); };
  std::size_t longest = 0;
  for (std::size_t k = 1; k < 3; ++k)
    if (squared(k) > squared(longest)) longest = k;
  return longest;
}

double squared_size_of(const TrianglePoints& t) {
  const std::size_t k = longest_edge_of(t);
  return squared_length(t[(k + 1) % 3] - t[k]);
}

/// Cuts a polygon along a plane through `origin`. What is within the tolerance of the plane counts as on it.
///
/// \param inward  the plane's normal, of length one
void cut(const Polygon& polygon, const Point3& origin, const Point3& inward, double tolerance, Polygon& inside,
         Polygon& outside) {
  inside.clear(), outside.clear();
  const auto height_of = [&](const Point3& p) {
    const double height = dot(inward, p - origin);
    return std::fabs(height) <= tolerance ? 0 : height;
  };
  bool is_in = false, is_out = false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point3 &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const double from = height_of(p), to = height_of(q);
    is_in = is_in || from > 0, is_out = is_out || from < 0;
    if (from >= 0) inside.push_back(p);
    if (from <= 0) outside.push_back(p);
    if (from * to >= 0) continue;
    const Point3 crossing = p + (from / (from - to)) * (q - p);
    inside.push_back(crossing), outside.push_back(crossing);
  }
  if (!is_in) inside.clear();
  if (!is_out) outside.clear();
}

/// Bounds the distance of a triangle from a surface, part by part.
class Parts {
 public:
  /// \param limit      squared: what is not farther is near enough
  /// \param tolerance  for points on a plane
  Parts(const NearestTriangle& to, double limit, const DistancePrecision& precision, double tolerance)
      : to_(to), limit_(limit), precision_(precision), tolerance_(tolerance) {}

  /// \param near  a triangle of the surface that may be near
  /// \return  one that is near
  std::uint32_t add(const TrianglePoints& t, std::uint32_t near) {
    parts_.push_back({t, near});
    for (std::size_t count = 0; !parts_.empty(); ++count) {
      const Part part = parts_.back();
      parts_.pop_back();
      bound(part, count < most_parts);
    }
    return near_;
  }

  double squared_bound() const { return bound_; }
  double squared_reached() const { return reached_; }
  const Point3& at() const { return at_; }

 private:
  struct Part {
    TrianglePoints corners;
    std::uint32_t near;
  };
  static constexpr std::size_t most_parts = 1 << 20;  ///< of a triangle; then the bounds are those that are known

  /// Looks at a point, and returns a triangle that is near to it.
  std::uint32_t see(const Point3& p, std::uint32_t near) {
    const double relative = precision_.relative * precision_.relative;
    auto found = to_.walk(p, near);
    if (relative * found.squared_distance <= limit_) return found.number;
    found = to_.nearest(p, found.number);
    if (relative * found.squared_distance > limit_) {
      reached_ = found.squared_distance, at_ = p;
      limit_ = relative * reached_;
    }
    return found.number;
  }

  /// Is no point of the polygon farther from the triangle than the limit? If so, notes the bound.
  template <class Corners>
  bool accept(const Corners& polygon, std::uint32_t number) {
    double most = 0;
    for (const Point3& p : polygon) most = std::max(most, squared_distance(to_[number], p));
    if (most > limit_) return false;
    bound_ = std::max(bound_, most), near_ = number;
    return true;
  }

  void bound(const Part& part, bool may_divide) {
    if (accept(part.corners, part.near)) return;
    const Point3 center = center_of(part.corners);
    Part same{part.corners, see(center, part.near)};
    if (same.near != part.near && accept(same.corners, same.near)) return;
    if (may_divide && divide_along(same, false)) return;
    const std::uint32_t walked_to = std::exchange(same.near, to_.nearest(center, same.near).number);
    if (same.near != walked_to && accept(same.corners, same.near)) return;
    if (may_divide && divide_along(same, true)) return;
    for (const Point3& p : part.corners) see(p, same.near);  // what is really so far away raises the limit
    if (accept(part.corners, same.near)) return;
    if (may_divide)
      halve(same);
    else
      bound_ = std::max(bound_, to_.squared_bound(part.corners));
  }

  void halve(const Part& part) {
    const auto& t = part.corners;
    const std::size_t k = longest_edge_of(t);
    const Point3 &a = t[k], &b = t[(k + 1) % 3], &c = t[(k + 2) % 3];
    const Point3 middle = 0.5 * (a + b);
    parts_.push_back({{a, middle, c}, part.near});
    parts_.push_back({{middle, b, c}, part.near});
  }

  void add_polygon(const Polygon& polygon, std::uint32_t near) {
    for (std::size_t i = 2; i < polygon.size(); ++i) parts_.push_back({{polygon[0], polygon[i - 1], polygon[i]}, near});
  }

  /// Cuts off what is not above or below the triangle that is thought to be near.
  /// \param is_nearest  is it known to be? If not, what is left must be near enough.
  /// \return  false if that is all or nothing, or if the part is much larger, so that it would be cut into splinters
  bool divide_along(const Part& part, bool is_nearest) {
    constexpr double much_larger = 16;  // of squares
    const TrianglePoints& near = to_[part.near];
    if (squared_size_of(part.corners) > much_larger * squared_size_of(near)) return false;
    const Point3 normal = cross(near[1] - near[0], near[2] - near[0]);
    within_.assign(part.corners.begin(), part.corners.end());
    for (std::size_t k = 0; k < 3; ++k) {
      const Point3 inward = cross(normal, near[(k + 1) % 3] - near[k]);
      const double size = length(inward);
      if (size == 0) return false;
      cut(within_, near[k], (1 / size) * inward, tolerance_, inside_, outside_[k]);
      std::swap(within_, inside_);
      if (within_.empty()) return false;
    }
    if (std::ranges::all_of(outside_, &Polygon::empty)) return false;
    if (!accept(within_, part.near)) {
      if (!is_nearest) return false;
      add_polygon(within_, part.near);
    }
    for (std::size_t k = 0; k < 3; ++k) add_polygon(outside_[k], to_.across(part.near, k));
    return true;
  }

  const NearestTriangle& to_;
  double limit_;
  const DistancePrecision& precision_;
  double tolerance_;
  std::vector<Part> parts_;
  Polygon within_, inside_;  // kept for their memory
  std::array<Polygon, 3> outside_;
  std::uint32_t near_ = 0;
  double bound_ = 0, reached_ = 0;  // squared
  Point3 at_;
};

/// The rounding of points on the triangles.
double rounding_of(std::span<const TrianglePoints> triangles) {
  double largest = 0;
  for (const TrianglePoints& t : triangles)
    for (const Point3& p : t) largest = std::max({largest, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
  return 8 * std::numeric_limits<double>::epsilon() * largest;
}

/// Equal for equal points.
std::uint64_t hash_of(const Point3& p) {
  std::uint64_t hash = 0;
  for (const double x : {p.x, p.y, p.z}) {
    hash = (hash ^ std::bit_cast<std::uint64_t>(x + 0.0)) * 0x9E3779B97F4A7C15u;  // + 0.0: there are two zeros
    hash ^= hash >> 32;
  }
  return hash;
}

/// The triangles across the sides of each; the triangle itself where there is none. Sides are told apart by hashes of
/// their ends: an error only makes a search begin at a wrong place.
std::vector<std::array<std::uint32_t, 3>> neighbors_of(const std::vector<TrianglePoints>& triangles) {
  struct Side {
    std::uint64_t hash;
    std::uint32_t triangle, number;
  };
  std::vector<Side> sides;
  std::vector<std::array<std::uint32_t, 3>> neighbors;
  sides.reserve(3 * triangles.size()), neighbors.reserve(triangles.size());
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    std::array<std::uint64_t, 3> hashes;
    for (std::size_t k = 0; k < 3; ++k) hashes[k] = hash_of(triangles[t][k]);
    for (std::uint32_t k = 0; k < 3; ++k) sides.push_back({hashes[k] + hashes[(k + 1) % 3], t, k});
    neighbors.push_back({t, t, t});
  }
  std::ranges::sort(
      sides, [](const Side& a, const Side& b) { return a.hash != b.hash ? a.hash < b.hash : a.triangle < b.triangle; });
  for (std::size_t i = 1; i < sides.size(); ++i) {
    const Side &one = sides[i - 1], &other = sides[i];
    if (one.hash != other.hash) continue;
    neighbors[one.triangle][one.number] = other.triangle;
    neighbors[other.triangle][other.number] = one.triangle;
  }
  return neighbors;
}

constexpr std::size_t triangles_at_a_time = 256;

/// The point that is farthest away among the centers and the corners of some of the triangles; its distance squared.
FarthestPoint first_look(std::span<const TrianglePoints> from, const NearestTriangle& to) {
  constexpr std::size_t some = 8;  // of so many, one is looked at
  const auto farthest_of = [&](std::size_t begin, std::size_t end) {
    FarthestPoint farthest;
    std::uint32_t near = 0;
    for (std::size_t i = begin; i < end; i += some)
      for (const Point3& p : {center_of(from[i]), from[i][0], from[i][1], from[i][2]}) {
        const auto found = to.nearest(p, near);
        near = found.number;
        if (found.squared_distance > farthest.reached) farthest.reached = found.squared_distance, farthest.at = p;
      }
    return farthest;
  };
  FarthestPoint farthest;
  if (!from.empty()) farthest.at = from[0][0];
  for (const FarthestPoint& one : parallel_chunks(from.size(), triangles_at_a_time, farthest_of))
    if (one.reached > farthest.reached) farthest = one;
  return farthest;
}

}  // namespace

NearestTriangle::NearestTriangle(std::vector<TrianglePoints> triangles)
    : triangles_(std::move(triangles)),
      neighbors_(neighbors_of(triangles_)),
      tree_(triangles_, [](const TrianglePoints& t) { return bounding_box(t); }) {}

NearestTriangle::Found NearestTriangle::walk(const Point3& p, std::uint32_t near) const {
  Found found{near, squared_distance(triangles_[near], p)};
  for (bool is_nearer = true; is_nearer;) {
    is_nearer = false;
    for (const std::uint32_t next : neighbors_[found.number])
      if (const double squared = squared_distance(triangles_[next], p); squared < found.squared_distance) {
        found = {next, squared};
        is_nearer = true;
        break;
      }
  }
  return found;
}

NearestTriangle::Found NearestTriangle::nearest(const Point3& p, std::uint32_t near) const {
  Found found = walk(p, near);  // the nearer the first one is, the faster the search
  const auto lower = [&](const Box& box, double) { return squared_distance(box, p); };
  tree_.any_below(found.squared_distance, lower, [&](const BoxTree::Item& item) {
    if (const double squared = squared_distance(triangles_[item.number], p); squared < found.squared_distance)
      found = {item.number, squared};
    return found.squared_distance == 0;
  });
  return found;
}

double NearestTriangle::squared_bound(const TrianglePoints& t) const {
  double least = std::numeric_limits<double>::infinity();
  const auto lower = [&](const Box& box, double) {
    double most = 0;
    for (const Point3& p : t) most = std::max(most, squared_distance(box, p));
    return most;
  };
  tree_.any_below(least, lower, [&](const BoxTree::Item& item) {
    double most = 0;
    for (const Point3& p : t) most = std::max(most, squared_distance(triangles_[item.number], p));
    least = std::min(least, most);
    return least == 0;
  });
  return least;
}

FarthestPoint farthest_point(std::span<const TrianglePoints> from, const NearestTriangle& to,
                             const DistancePrecision& precision) {
  FarthestPoint farthest = first_look(from, to);
  // All triangles have the limit that follows from these points, so that the result does not depend on threads.
  const double limit =
      std::max(precision.absolute * precision.absolute, precision.relative * precision.relative * farthest.reached);
  const double rounding = rounding_of(from);
  const auto bound_some = [&](std::size_t begin, std::size_t end) {
    FarthestPoint found;
    std::uint32_t near = 0;
    for (std::size_t i = begin; i < end; ++i) {
      Parts parts(to, limit, precision, rounding);
      near = parts.add(from[i], near);
      found.bound = std::max(found.bound, parts.squared_bound());
      if (parts.squared_reached() > found.reached) found.reached = parts.squared_reached(), found.at = parts.at();
    }
    return found;
  };
  for (const FarthestPoint& one : parallel_chunks(from.size(), triangles_at_a_time, bound_some)) {
    farthest.bound = std::max(farthest.bound, one.bound);
    if (one.reached > farthest.reached) farthest.reached = one.reached, farthest.at = one.at;
  }
  farthest.bound = std::sqrt(farthest.bound) + (farthest.bound > 0 ? rounding : 0);
  farthest.reached = std::sqrt(farthest.reached);
  return farthest;
}

std::vector<Point3> points_beyond(std::span<const TrianglePoints> from, const NearestTriangle& to, double limit) {
  const DistancePrecision precision;
  const double rounding = rounding_of(from);
  const auto find_some = [&](std::size_t begin, std::size_t end) {
    std::vector<Point3> found;
    std::uint32_t near = 0;
    for (std::size_t i = begin; i < end; ++i) {
      Parts parts(to, limit * limit, precision, rounding);
      near = parts.add(from[i], near);
      if (parts.squared_reached() > 0)
        found.push_back(parts.at());
      else if (parts.squared_bound() > limit * limit)
        found.push_back(center_of(from[i]));
    }
    return found;
  };
  std::vector<Point3> all;
  for (const std::vector<Point3>& some : parallel_chunks(from.size(), triangles_at_a_time, find_some))
    all.insert(all.end(), some.begin(), some.end());
  return all;
}

}  // namespace ccdt
