#include "engine/sizes/interpolated_sizes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <ranges>
#include <string>
#include <vector>

#include "engine/base/check_arguments.h"
#include "engine/base/errors.h"

namespace ccdt::sizes {
namespace {

/// The part of a segment, from 0 to 1, where some linear functions are not negative.
struct Part {
  double from = 0, to = 1;

  /// \param a,b  the values of a linear function at the ends
  void clip(double a, double b) {
    if (a < 0 && b < 0) to = -1;
    if (a < 0 && b >= 0) from = std::max(from, a / (a - b));
    if (a >= 0 && b < 0) to = std::min(to, a / (a - b));
  }
  bool is_empty() const { return from > to; }
  double least(double a, double b) const { return std::min(a + from * (b - a), a + to * (b - a)); }
};

/// The distance of a point from the six planes of a box, positive inside.
std::array<double, 6> depths(const Box& box, const Point3& p) {
  return {p.x - box.low.x, p.y - box.low.y, p.z - box.low.z, box.high.x - p.x, box.high.y - p.y, box.high.z - p.z};
}

template <std::size_t Count>
Part common_part(const std::array<double, Count>& a, const std::array<double, Count>& b) {
  Part part;
  for (std::size_t i = 0; i < Count; ++i) part.clip(a[i], b[i]);
  return part;
}

/// Barycentric coordinates in one tetrahedron.
class Barycentric {
 public:
  explicit Barycentric(const std::array<Point3, 4>& corners) : origin_(corners[0]) {
    const Point3 b = corners[1] - origin_, c = corners[2] - origin_, d = corners[3] - origin_;
    sixfold_volume_ = dot(cross(b, c), d);
    if (is_flat()) return;
    normals_ = {(1 / sixfold_volume_) * cross(c, d), (1 / sixfold_volume_) * cross(d, b),
                (1 / sixfold_volume_) * cross(b, c)};
  }
  bool is_flat() const { return sixfold_volume_ == 0; }
  std::array<double, 4> at(const Point3& p) const {
    const Point3 q = p - origin_;
    const double b = dot(normals_[0], q), c = dot(normals_[1], q), d = dot(normals_[2], q);
    return {1 - b - c - d, b, c, d};
  }

 private:
  Point3 origin_;
  double sixfold_volume_ = 0;
  std::array<Point3, 3> normals_;
};

Point3 corner(const Box& box, unsigned i) {
  return {i & 1 ? box.high.x : box.low.x, i & 2 ? box.high.y : box.low.y, i & 4 ? box.high.z : box.low.z};
}

}  // namespace

// The least value is at a corner of the common part, and each such corner is on an edge of one of the two.
double least_value(const std::array<Point3, 4>& corners, const std::array<double, 4>& values, const Box& box) {
  double least = HUGE_VAL;
  const Barycentric barycentric(corners);
  if (barycentric.is_flat()) return least;
  std::array<std::array<double, 6>, 4> depth;
  for (unsigned i = 0; i < 4; ++i) depth[i] = depths(box, corners[i]);
  for (unsigned i = 0; i < 4; ++i) {
    for (unsigned j = 0; j < i; ++j) {
      const Part part = common_part(depth[i], depth[j]);
      if (!part.is_empty()) least = std::min(least, part.least(values[i], values[j]));
    }
  }
  std::array<std::array<double, 4>, 8> weights;
  std::array<double, 8> value_at;
  for (unsigned i = 0; i < 8; ++i) {
    weights[i] = barycentric.at(corner(box, i));
    value_at[i] = 0;
    for (unsigned k = 0; k < 4; ++k) value_at[i] += weights[i][k] * values[k];
  }
  for (unsigned i = 0; i < 8; ++i) {
    for (unsigned axis = 1; axis < 8; axis *= 2) {
      const unsigned j = i | axis;
      if (j == i) continue;
      const Part part = common_part(weights[i], weights[j]);
      if (!part.is_empty()) least = std::min(least, part.least(value_at[i], value_at[j]));
    }
  }
  return least;
}

void check_background(const BackgroundSizes& background) {
  const auto require = [&](bool holds, const std::string& what) {
    if (!holds)
      throw InputError(what, {.file = background.name},
                       "give each vertex of the background a place and the edge length there");
  };
  require(background.sizes.size() == background.vertices.size(), "the background has not one size for each vertex");
  require(std::ranges::all_of(background.vertices, is_finite), "a vertex of the background is not finite");
  require(std::ranges::all_of(background.sizes, [](double size) { return size > 0 && size <= largest_argument; }),
          "a size is not a positive number");
  require(are_below(background.vertices.size(), background.tetrahedra),
          "a tetrahedron of the background has a corner that is not a vertex");
}

InterpolatedSizes::InterpolatedSizes(const BackgroundSizes& background) : background_(&background) {
  const auto box = [&](std::uint32_t v) { return box_of(background.vertices[v]); };
  const auto size = [&](std::uint32_t v) { return background.sizes[v]; };
  using Corners = std::array<std::uint32_t, 4>;
  tetrahedra_ = BoxTree(
      background.tetrahedra,
      [&](const Corners& v) { return hull(hull(box(v[0]), box(v[1])), hull(box(v[2]), box(v[3]))); },
      [&](const Corners& v) {
        return std::min({size(v[0]), size(v[1]), size(v[2]), size(v[3])});
      });
  vertices_ = BoxTree(std::views::iota(std::uint32_t{0}, background.vertices.size()), box, size);
}

double InterpolatedSizes::least_in(const Box& box, std::uint32_t tetrahedron) const {
  std::array<Point3, 4> corners;
  std::array<double, 4> sizes;
  for (unsigned i = 0; i < 4; ++i) {
    const std::uint32_t v = background_->tetrahedra[tetrahedron][i];
    corners[i] = background_->vertices[v];
    sizes[i] = background_->sizes[v];
  }
  return least_value(corners, sizes, box);
}

bool InterpolatedSizes::is_below(const Box& box, double bound) const {
  const auto least_if_meeting = [&](const Box& other, double size) { return other.meets(box) ? size : HUGE_VAL; };
  if (tetrahedra_.any_below(bound, least_if_meeting,
                            [&](const BoxTree::Item& item) { return least_in(box, item.number) < bound; }))
    return true;
  const bool meets = tetrahedra_.any_below(
      HUGE_VAL, least_if_meeting, [&](const BoxTree::Item& item) { return least_in(box, item.number) < HUGE_VAL; });
  return !meets && is_below_outside(box, bound);
}

double InterpolatedSizes::at(const Point3& p) const {
  double least = HUGE_VAL;
  tetrahedra_.for_each_meeting(box_of(p), [&](std::uint32_t t) { least = std::min(least, least_in(box_of(p), t)); });
  if (least < HUGE_VAL) return least;
  double nearest = HUGE_VAL;
  vertices_.any_below(
      nearest, [&](const Box& box, double) { return squared_distance(box, p); },
      [&](const BoxTree::Item& item) {
        nearest = squared_distance(item.box, p), least = item.size;
        return false;
      });
  return least;
}

/// A vertex is nearest to no point of the box if its least distance to the box exceeds another's greatest distance.
bool InterpolatedSizes::is_below_outside(const Box& box, double bound) const {
  double farthest = HUGE_VAL;
  const auto distance = [&](const Box& other, double) { return squared_distance(other, box); };
  vertices_.any_below(farthest, distance, [&](const BoxTree::Item& item) {
    farthest = std::min(farthest, squared_farthest_distance(box, item.box.low));
    return false;
  });
  const auto size_if_near = [&](const Box& other, double size) {
    return distance(other, size) <= farthest ? size : HUGE_VAL;
  };
  return vertices_.any_below(bound, size_if_near, [](const BoxTree::Item&) { return true; });
}

}  // namespace ccdt::sizes
