#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <random>
#include <span>
#include <vector>

#include "engine/delaunay/delaunay.h"
#include "engine/front/find_delaunay_faces.h"
#include "engine/tests/delaunay/delaunay_point_sets.h"

// After vertices were added, triangles are found again as faces. The codes must be the same as those of a search that
// knows nothing of the state before.

namespace ccdt {
namespace {

using Triangle = std::array<VertexId, 3>;

/// Faces of the tetrahedralization, seen from any side, and as many random triangles, which are seldom faces. Some
/// occur twice.
std::vector<Triangle> some_triangles(const delaunay::Delaunay& d, std::size_t count, std::mt19937& random) {
  std::vector<Triangle> triangles;
  const auto any = [&](std::size_t end) { return static_cast<std::uint32_t>(random() % end); };
  const auto add = [&](std::array<std::uint32_t, 3> corners) {
    std::ranges::shuffle(corners, random);
    triangles.push_back({VertexId(corners[0]), VertexId(corners[1]), VertexId(corners[2])});
  };
  while (triangles.size() < count) {
    const std::uint32_t c = any(d.cells.size());
    if (!d.is_finite(c)) continue;
    add(delaunay::corners_of_face(d.cells[c].vertices, any(4)));
    const std::uint32_t u = any(d.vertices.size()), v = any(d.vertices.size()), w = any(d.vertices.size());
    if (u != v && v != w && w != u) add({u, v, w});
    const auto [p, q, r] = triangles[any(triangles.size())];
    if (any(8) == 0) add({p, q, r});
  }
  return triangles;
}

/// The codes of some of the triangles in a state of the tetrahedralization, for the cell on either side. If triangles
/// are equal, any or all of them may have a code.
std::vector<std::uint32_t> some_codes(const std::vector<Triangle>& triangles, const delaunay::Delaunay& d,
                                      std::mt19937& random) {
  std::vector<std::uint32_t> codes;
  for (const auto& [a, b, c] : triangles) {
    std::uint32_t code = random() % 4 == 0 ? delaunay::no_neighbor : delaunay::find_face(d, a, b, c);
    if (code != delaunay::no_neighbor && random() % 2 == 0) code = d.across(code);
    codes.push_back(code);
  }
  return codes;
}

TEST(DelaunayFaces, AreFoundAgainAfterVerticesWereAdded) {
  std::mt19937 random(17);
  std::size_t stayed = 0, changed = 0;
  for (int i = 0; i < 400; ++i) {
    const std::vector<Point3> points = test::shuffled(test::simple_cubic(5), random());
    const std::size_t first = 100, added = random() % 8;
    delaunay::Delaunay d = delaunay::build_delaunay(std::span(points).first(first));
    // A few are searched in the stars of their vertices, many in all cells.
    const std::vector<Triangle> triangles = some_triangles(d, i % 2 == 0 ? 8 : 120, random);
    const std::vector<std::uint32_t> earlier = some_codes(triangles, d, random);
    delaunay::insert_points(d, std::span(points).subspan(first, added));
    const std::vector<std::uint32_t> codes = front::find_delaunay_faces(triangles, d);
    EXPECT_EQ(front::find_delaunay_faces_again(triangles, earlier, d), codes) << "input " << i;
    for (std::size_t t = 0; t < triangles.size(); ++t)
      if (earlier[t] != delaunay::no_neighbor) ++(codes[t] != delaunay::no_neighbor ? stayed : changed);
  }
  EXPECT_GT(stayed, 1000u);
  EXPECT_GT(changed, 1000u);
}

TEST(DelaunayFaces, AreFoundAgainWhereTheCodesAreThoseOfOtherFaces) {
  std::mt19937 random(18);
  const delaunay::Delaunay d = delaunay::build_delaunay(test::shuffled(test::simple_cubic(5), random()));
  const std::vector<Triangle> triangles = some_triangles(d, 200, random);
  const std::vector<std::uint32_t> codes = front::find_delaunay_faces(triangles, d);
  std::vector<std::uint32_t> wrong = codes;
  std::ranges::rotate(wrong, wrong.begin() + 1);
  EXPECT_EQ(front::find_delaunay_faces_again(triangles, wrong, d), codes);
  std::ranges::fill(wrong, 4 * static_cast<std::uint32_t>(d.cells.size()) + 1);
  EXPECT_EQ(front::find_delaunay_faces_again(triangles, wrong, d), codes);
}

}  // namespace
}  // namespace ccdt
