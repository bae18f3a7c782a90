#include "bench/verify/crossings.h"

#include <algorithm>
#include <utility>

#include "bench/verify/exact.h"
#include "engine/base/parallel.h"
#include "engine/geometry/box_tree.h"

namespace ccdt::verify {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

Box box_of(const plc::InputPlc& surface, const Triangle& triangle) {
  Box box = empty_box;
  for (const std::uint32_t v : triangle) box = hull(box, ccdt::box_of(surface.vertices[v]));
  return box;
}

/// The corners of a triangle, beginning with those that it shares with another.
Triangle shared_first(Triangle triangle, const Triangle& other) {
  std::ranges::stable_partition(triangle, [&](std::uint32_t v) { return std::ranges::find(other, v) != other.end(); });
  return triangle;
}

class CrossingTest {
 public:
  explicit CrossingTest(const plc::InputPlc& surface) : surface_(surface) {}

  bool operator()(const Triangle& one, const Triangle& other) const {
    const Triangle a = shared_first(one, other), b = shared_first(other, one);
    const auto shared = std::ranges::count_if(a, [&](std::uint32_t v) { return std::ranges::find(b, v) != b.end(); });
    switch (shared) {
      case 0:
        return do_meet(whole(a), whole(b));
      case 1:  // if they share more than the vertex, this reaches the opposite edge in one of them
        return do_meet(far_edge(a), whole(b)) || do_meet(far_edge(b), whole(a));
      case 2:  // they lie on each other, on one side of the edge
        return orientation(at(a[0]), at(a[1]), at(a[2]), at(b[2])) == 0 &&
               are_on_one_side(at(a[0]), at(a[1]), at(a[2]), at(b[2]));
      default:
        return true;
    }
  }

 private:
  const Point3& at(std::uint32_t v) const { return surface_.vertices[v]; }
  std::array<Point3, 3> whole(const Triangle& t) const { return {at(t[0]), at(t[1]), at(t[2])}; }
  std::array<Point3, 2> far_edge(const Triangle& t) const { return {at(t[1]), at(t[2])}; }

  const plc::InputPlc& surface_;
};

}  // namespace

std::vector<std::array<std::uint32_t, 2>> find_crossings(const plc::InputPlc& surface) {
  const auto& triangles = surface.triangles;
  const BoxTree tree(triangles, [&](const Triangle& triangle) { return box_of(surface, triangle); });
  const CrossingTest cross(surface);
  using Pairs = std::vector<std::array<std::uint32_t, 2>>;
  const auto found = parallel_chunks(triangles.size(), 4096, [&](std::size_t begin, std::size_t end) {
    Pairs crossings;
    for (std::size_t i = begin; i < end; ++i)
      tree.for_each_meeting(box_of(surface, triangles[i]), [&](std::uint32_t j) {
        if (i < j && cross(triangles[i], triangles[j])) crossings.push_back({static_cast<std::uint32_t>(i), j});
      });
    return crossings;
  });
  Pairs all;
  for (const Pairs& pairs : found) all.insert(all.end(), pairs.begin(), pairs.end());
  return all;
}

}  // namespace ccdt::verify
