#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <utility>

#include "engine/geometry/box_tree.h"
#include "engine/geometry/contacts.h"
#include "engine/geometry/integer_points.h"
#include "engine/geometry/predicates.h"
#include "engine/plc/close_triangles.h"
#include "engine/plc/edge_table.h"
#include "engine/plc/find_overlaps.h"
#include "engine/tests/shared/plc_test_solids.h"

namespace ccdt {
namespace {

using Triangle = std::array<Point3, 3>;

Point3 random_point(std::mt19937& random, int extent) {
  const auto coordinate = [&] { return DyadicGrid::quantum * double(int(random() % extent)); };
  return {coordinate(), coordinate(), coordinate()};
}

Triangle random_triangle(std::mt19937& random, int extent) {
  Triangle t;
  do {
    t = {random_point(random, extent), random_point(random, extent), random_point(random, extent)};
  } while (collinear(t[0], t[1], t[2]));
  return t;
}

/// Are the points of one set strictly beyond those of the other along the axis? Exact for small integers as used here.
bool separates(const Point3& axis, const std::vector<Point3>& s, const std::vector<Point3>& t) {
  const auto range = [&](const std::vector<Point3>& points) {
    double low = dot(axis, points[0]), high = low;
    for (const Point3& p : points) {
      low = std::min(low, dot(axis, p));
      high = std::max(high, dot(axis, p));
    }
    return std::pair{low, high};
  };
  const auto [s_low, s_high] = range(s);
  const auto [t_low, t_high] = range(t);
  return s_high < t_low || t_high < s_low;
}

/// The separating axis theorem: the axes are the normals of the faces of the Minkowski difference.
bool are_disjoint(std::vector<Point3> s, std::vector<Point3> t) {
  for (auto* points : {&s, &t})
    for (Point3& p : *points) p = (1 / DyadicGrid::quantum) * p;
  std::vector<Point3> s_edges, t_edges, axes;
  for (std::size_t i = 0; i < s.size(); ++i) s_edges.push_back(s[(i + 1) % s.size()] - s[i]);
  for (std::size_t i = 0; i < t.size(); ++i) t_edges.push_back(t[(i + 1) % t.size()] - t[i]);
  std::vector<Point3> edges = s_edges;
  edges.insert(edges.end(), t_edges.begin(), t_edges.end());
  edges.push_back(t[0] - s[0]);  // for two parallel segments, which leave no other direction across
  for (const Point3& e : edges)
    for (const Point3& f : edges) axes.push_back(cross(e, f));
  const std::size_t normals = axes.size();
  for (std::size_t i = 0; i < normals; ++i)  // within the plane, if all is in one plane
    for (const Point3& e : edges) axes.push_back(cross(axes[i], e));
  axes.insert(axes.end(), edges.begin(), edges.end());  // on the line, if all is on one line
  return std::any_of(axes.begin(), axes.end(), [&](const Point3& axis) { return separates(axis, s, t); });
}

std::vector<Point3> list(const Triangle& t) {
  return {t.begin(), t.end()};
}

TEST(PlcIntersections, TrianglesMeetIfNoAxisSeparatesThem) {
  std::mt19937 random(3);
  int apart = 0, rounds = 60000;
  for (int i = 0; i < rounds; ++i) {
    const int extent = 2 + i % 5;
    const Triangle s = random_triangle(random, extent), t = random_triangle(random, extent);
    const bool disjoint = are_disjoint(list(s), list(t));
    ASSERT_EQ(!meet_triangles(s, t).has_value(), disjoint) << "round " << i;
    apart += disjoint;
  }
  EXPECT_GT(apart, rounds / 10);
  EXPECT_LT(apart, rounds * 9 / 10);
}

TEST(PlcIntersections, SegmentsMeetTrianglesAndSegmentsIfNoAxisSeparatesThem) {
  std::mt19937 random(4);
  for (int i = 0; i < 60000; ++i) {
    const int extent = 2 + i % 5;
    const Triangle t = random_triangle(random, extent), s = random_triangle(random, extent);
    ASSERT_EQ(!meet_segment_triangle(s[0], s[1], t).has_value(), are_disjoint({s[0], s[1]}, list(t))) << "round " << i;
    ASSERT_EQ(!meet_segments(s[0], s[1], t[0], t[1]).has_value(), are_disjoint({s[0], s[1]}, {t[0], t[1]}))
        << "round " << i;
  }
}

// Cuts off a hundredth of each triangle at the common corner. If the rest still meets, the triangles meet elsewhere.
TEST(PlcIntersections, TrianglesWithACommonCornerMeetElsewhereIfTheyDoWithoutTheirTips) {
  std::mt19937 random(5);
  int meeting = 0;
  for (int i = 0; i < 40000; ++i) {
    Triangle s = random_triangle(random, 4), t = random_triangle(random, 4);
    t[0] = s[0];
    if (collinear(t[0], t[1], t[2])) continue;
    const bool shared_twice = s[1] == t[1] || s[1] == t[2] || s[2] == t[1] || s[2] == t[2];
    if (shared_twice) continue;
    // Scaled by a hundred, the cut triangles have integer corners. A meeting beyond the corner reaches an opposite
    // edge.
    std::vector<Point3> s_cut, t_cut;
    const auto cut = [](const Triangle& u, std::vector<Point3>& points) {
      for (int k : {1, 2}) points.push_back(100 * u[k]);
      for (int k : {2, 1}) points.push_back(99 * u[0] + u[k]);
    };
    cut(s, s_cut);
    cut(t, t_cut);
    const std::vector<Point3> s_all = {100 * s[0], 100 * s[1], 100 * s[2]},
                              t_all = {100 * t[0], 100 * t[1], 100 * t[2]};
    const bool disjoint = are_disjoint(s_cut, t_all) && are_disjoint(s_all, t_cut);
    ASSERT_EQ(!meet_triangles_at_corner(s, t).has_value(), disjoint) << "round " << i;
    meeting += !disjoint;
  }
  EXPECT_GT(meeting, 1000);
}

TEST(PlcIntersections, TheQuickTestAlongAnAxisIsNeverWrongAndMostlyAnswersInAPlane) {
  std::mt19937 random(6);
  int disjoint = 0, separated = 0;
  for (int i = 0; i < 60000; ++i) {
    const int axis = i % 3, common = i / 3 % 2;
    const bool flat = i % 5 != 0;
    Triangle s, t;
    const auto flatten = [&](Point3& p) { (axis == 0 ? p.x : axis == 1 ? p.y : p.z) = 0; };
    do {
      s = random_triangle(random, 5);
      t = random_triangle(random, 5);
      if (common == 1) t[0] = s[0];
      if (flat)
        for (Triangle* u : {&s, &t})
          for (Point3& p : *u) flatten(p);
    } while (collinear(s[0], s[1], s[2]) || collinear(t[0], t[1], t[2]));
    if (common == 1 && (s[1] == t[1] || s[1] == t[2] || s[2] == t[1] || s[2] == t[2])) continue;
    const bool meet = common == 1 ? meet_triangles_at_corner(s, t).has_value() : meet_triangles(s, t).has_value();
    const bool apart = are_apart_seen_along(axis, s, t, common);
    ASSERT_FALSE(apart && meet) << "round " << i;
    disjoint += flat && !meet;
    separated += flat && apart;
  }
  EXPECT_GT(separated, disjoint * 97 / 100);
}

TEST(PlcIntersections, TrianglesWithACommonEdgeAreApartIfItDividesThem) {
  const double q = DyadicGrid::quantum;
  const Point3 a, b = {4 * q, 0, 0}, c = {q, q, 0};
  for (int y = -3; y <= 3; ++y) EXPECT_EQ(are_apart_seen_along(2, {a, b, c}, {a, b, {2 * q, y * q, q}}, 2), y < 0) << y;
  EXPECT_FALSE(are_apart_seen_along(0, {a, b, c}, {a, b, {q, -q, 0}}, 2)) << "they are not seen from there";
}

TEST(PlcIntersections, TurnsAboutAnEdgeAreThoseOfTheirAngles) {
  std::mt19937 random(8);
  const double q = DyadicGrid::quantum;
  for (int i = 0; i < 20000; ++i) {  // about the z axis, so that plain integers tell the angle
    const auto direction = [&] {
      int x = 0, y = 0;
      while (x == 0 && y == 0) {
        x = int(random() % 7) - 3;
        y = int(random() % 7) - 3;
      }
      return std::array{x, y};
    };
    const auto c = direction(), d = direction();
    const int across = c[0] * d[1] - c[1] * d[0], along = c[0] * d[0] + c[1] * d[1];
    const plc::Turn expected = across > 0   ? plc::Turn::below_180
                               : across < 0 ? plc::Turn::above_180
                               : along > 0  ? plc::Turn::zero
                                            : plc::Turn::exactly_180;
    const auto lifted = [&](const std::array<int, 2>& p) {
      return q * Point3{double(p[0]), double(p[1]), double(random() % 9)};
    };
    EXPECT_EQ(plc::turn_about({0, 0, q}, {0, 0, 4 * q}, lifted(c), lifted(d)), expected);
  }
}

TEST(PlcIntersections, TheBoxTreeFindsAllPairsAndAllBoxesOnce) {
  std::mt19937 random(9);
  for (const std::size_t count : {0, 1, 3, 4, 5, 17, 200}) {
    RawVector<Box> boxes;
    for (std::size_t i = 0; i < count; ++i)
      boxes.push_back(hull(box_of(random_point(random, 12)), box_of(random_point(random, 12))));
    if (count == 17) boxes.assign(count, box_of({1, 2, 3}));
    std::vector<std::pair<std::uint32_t, std::uint32_t>> expected, found;
    for (std::uint32_t i = 0; i < count; ++i)
      for (std::uint32_t j = i + 1; j < count; ++j)
        if (boxes[i].meets(boxes[j])) expected.emplace_back(i, j);
    BoxTree tree(boxes);
    tree.for_each_pair([&](std::uint32_t i, std::uint32_t j) { found.push_back(std::minmax(i, j)); });
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, expected);

    const Box query = hull(box_of(random_point(random, 12)), box_of(random_point(random, 12)));
    std::vector<std::uint32_t> met, should_meet;
    tree.for_each_meeting(query, [&](std::uint32_t i) { met.push_back(i); });
    for (std::uint32_t i = 0; i < count; ++i)
      if (boxes[i].meets(query)) should_meet.push_back(i);
    std::sort(met.begin(), met.end());
    EXPECT_EQ(met, should_meet);

    if (count == 0) continue;
    const auto item = static_cast<std::uint32_t>(random() % count);
    tree.enlarge(item, box_of(query.low));
    met.clear();
    tree.for_each_meeting(query, [&](std::uint32_t i) { met.push_back(i); });
    if (std::ranges::find(should_meet, item) == should_meet.end()) should_meet.push_back(item);
    std::ranges::sort(should_meet);
    std::ranges::sort(met);
    EXPECT_EQ(met, should_meet);
  }
}

TEST(PlcIntersections, TheBoxTreeFindsTheLeastBoundOfAllItems) {
  std::mt19937 random(10);
  for (const std::size_t count : {0, 1, 4, 5, 17, 200}) {
    RawVector<Box> boxes;
    RawVector<double> sizes;
    for (std::size_t i = 0; i < count; ++i) {
      boxes.push_back(hull(box_of(random_point(random, 12)), box_of(random_point(random, 12))));
      sizes.push_back(double(random() % 20) * DyadicGrid::quantum);
    }
    const Point3 p = random_point(random, 12);
    const auto bound = [&](const Box& box, double size) { return size + std::sqrt(squared_distance(box, p)); };
    double expected = HUGE_VAL, least = HUGE_VAL;
    for (std::size_t i = 0; i < count; ++i) expected = std::min(expected, bound(boxes[i], sizes[i]));
    const BoxTree tree(boxes, sizes);
    EXPECT_FALSE(tree.any_below(least, bound, [&](const BoxTree::Item& item) {
      EXPECT_EQ(item.size, sizes[item.number]);
      least = bound(item.box, item.size);
      return false;
    }));
    EXPECT_EQ(least, expected);
    EXPECT_FALSE(tree.any_below(expected, bound, [](const BoxTree::Item&) { return true; })) << "none is below";
    EXPECT_EQ(tree.any_below(HUGE_VAL, bound, [](const BoxTree::Item&) { return true; }), count > 0);
  }
}

TEST(PlcIntersections, CommonCornersComeFirstInTheirOrder) {
  std::array<int, 3> s = {5, 7, 9}, t = {9, 8, 5};
  EXPECT_EQ(put_common_first(s, t), 2);
  EXPECT_EQ(s, (std::array{9, 5, 7}));
  EXPECT_EQ(t, (std::array{5, 9, 8}));
  t = {1, 2, 7};
  EXPECT_EQ(put_common_first(s, t), 1);
  EXPECT_EQ(s, (std::array{7, 9, 5}));
  EXPECT_EQ(t, (std::array{7, 1, 2}));
  t = {1, 2, 3};
  EXPECT_EQ(put_common_first(s, t), 0);
}

TEST(PlcIntersections, TrianglesOnOneSideOfTheirCommonEdgeMeetElsewhere) {
  constexpr double q = DyadicGrid::quantum;
  const Point3 a{0, 0, 0}, b{4 * q, 0, 0}, c{q, 3 * q, 0};
  EXPECT_TRUE(meet_elsewhere({a, b, c}, {b, a, {3 * q, q, 0}}, 2));
  EXPECT_FALSE(meet_elsewhere({a, b, c}, {b, a, {3 * q, -q, 0}}, 2)) << "on the other side";
  EXPECT_FALSE(meet_elsewhere({a, b, c}, {b, a, {3 * q, q, 1}}, 2)) << "not in one plane";
}

TEST(PlcIntersections, CloseTrianglesAreThoseOfAllPairsWithADoubtfulOne) {
  std::mt19937 random(8);
  std::vector<Point3> vertices(600);
  for (Point3& p : vertices) p = random_point(random, 12);
  std::uniform_int_distribution<std::uint32_t> vertex(0, 599);
  plc::TriangleSet triangles;
  while (triangles.size() < 1000) {
    const plc::VertexTriple t = {VertexId(vertex(random)), VertexId(vertex(random)), VertexId(vertex(random))};
    if (!has_no_area(plc::points_of(vertices, t))) triangles.add(t, 0, 0);
  }
  const auto sorted_pairs = [&](std::span<const std::uint8_t> is_doubtful) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
    for (const auto& [s, t] : plc::find_close_triangles(vertices, triangles, is_doubtful))
      pairs.push_back(std::minmax(s, t));
    std::ranges::sort(pairs);
    return pairs;
  };
  const auto all = sorted_pairs({});
  EXPECT_GT(all.size(), 10000u);
  for (std::uint32_t i = 0; i < 200; ++i)
    for (std::uint32_t j = i + 1; j < triangles.size(); ++j) {
      const plc::VertexTriple &s = triangles.corners[i], &t = triangles.corners[j];
      const bool have_common = std::ranges::find_first_of(s, t) != s.end();
      if (!have_common && meet_triangles(plc::points_of(vertices, s), plc::points_of(vertices, t))) {
        EXPECT_TRUE(std::ranges::binary_search(all, std::pair(i, j))) << i << " " << j;
      }
    }
  for (const unsigned one_of : {1, 2, 40, 100, 400}) {
    std::vector<std::uint8_t> is_doubtful(triangles.size());
    for (std::uint8_t& doubtful : is_doubtful) doubtful = random() % one_of == 0;
    auto expected = all;
    std::erase_if(expected, [&](const auto& pair) { return !is_doubtful[pair.first] && !is_doubtful[pair.second]; });
    EXPECT_EQ(sorted_pairs(is_doubtful), expected) << "one of " << one_of;
  }
}

}  // namespace
}  // namespace ccdt
