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

// Triangles are found again as faces after vertices were added: the same codes as those of a search without any
// knowledge of before.

namespace ccdt {
namespace {

using Triangle = std::array<VertexId, 3>;

/// Points of a small grid, many of them cospherical and coplanar.
std::vector<Point3> random_points(std::mt19937& random, std::size_t count) {
  std::vector<Point3> points;
  while (points.size() < count) {
    const Point3 p{double(random() % 16), double(random() % 16), double(random() % 16)};
    if (std::ranges::find(points, p) == points.end()) points.push_back(p);
  }
  return points;
}

/// Faces of the tetrahedralization, seen from any side, and as many triangles that are mostly none.
std::vector<Triangle> some_triangles(const delaunay::Delaunay& d, std::size_t count, std::mt19937& random) {
  std::vector<Triangle> triangles;
  const auto add = [&](const std::array<std::uint32_t, 3>& corners) {
    const Triangle t{VertexId(corners[0]), VertexId(corners[1]), VertexId(corners[2])};
    const bool is_new =
        std::ranges::none_of(triangles, [&](const Triangle& old) { return std::ranges::is_permutation(t, old); });
    if (is_new && t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) triangles.push_back(t);
  };
  const auto any = [&](std::size_t end) { return static_cast<std::uint32_t>(random() % end); };
  while (triangles.size() < count) {
    const std::uint32_t c = any(d.cells.size());
    if (!d.is_finite(c)) continue;
    auto corners = delaunay::corners_of_face(d.cells[c].vertices, any(4));
    std::ranges::shuffle(corners, random);
    add(corners);
    add({any(d.vertices.size()), any(d.vertices.size()), any(d.vertices.size())});
  }
  return triangles;
}

TEST(DelaunayFaces, AreFoundAgainAfterVerticesWereAdded) {
  std::mt19937 random(17);
  std::size_t stayed = 0, changed = 0;
  for (int i = 0; i < 200; ++i) {
    const std::vector<Point3> points = random_points(random, 150);
    const std::size_t first = 100, added = random() % 8;
    delaunay::Delaunay d = delaunay::build_delaunay(std::span(points).first(first));
    // A few are searched in the stars of their vertices, many in all cells.
    const std::vector<Triangle> triangles = some_triangles(d, i % 2 == 0 ? 8 : 120, random);
    std::vector<std::uint32_t> earlier = front::find_delaunay_faces(triangles, d);
    for (std::uint32_t& code : earlier)
      if (code != delaunay::no_neighbor && random() % 2 == 0) code = d.across(code);
    delaunay::insert_points(d, std::span(points).subspan(first, added));
    const std::vector<std::uint32_t> codes = front::find_delaunay_faces(triangles, d);
    EXPECT_EQ(front::find_delaunay_faces_again(triangles, earlier, d), codes) << "input " << i;
    for (std::size_t t = 0; t < triangles.size(); ++t)
      ++((codes[t] == delaunay::no_neighbor) == (earlier[t] == delaunay::no_neighbor) ? stayed : changed);
  }
  EXPECT_GT(stayed, 1000u);
  EXPECT_GT(changed, 100u);
}

TEST(DelaunayFaces, AreFoundAgainWhereTheCodesAreThoseOfOtherFaces) {
  std::mt19937 random(18);
  const delaunay::Delaunay d = delaunay::build_delaunay(random_points(random, 200));
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
