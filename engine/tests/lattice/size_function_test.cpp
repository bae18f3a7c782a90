#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

#include "engine/base/errors.h"
#include "engine/lattice/target_sizes.h"
#include "engine/tests/lattice/lattice_shapes.h"

namespace ccdt::test {
namespace {

/// A cube of n^3 small cubes, of six tetrahedra each, around [-half, half]^3.
template <class Size>
sizes::BackgroundSizes background_cube(int n, double half, const Size& size_at) {
  sizes::BackgroundSizes b;
  const auto vertex = [n](int x, int y, int z) { return std::uint32_t(x + (n + 1) * (y + (n + 1) * z)); };
  for (int z = 0; z <= n; ++z)
    for (int y = 0; y <= n; ++y)
      for (int x = 0; x <= n; ++x) {
        b.vertices.push_back(half * (2.0 / n * Point3{double(x), double(y), double(z)} - Point3{1, 1, 1}));
        b.sizes.push_back(size_at(b.vertices.back()));
        if (x == n || y == n || z == n) continue;
        std::array axes = {0, 1, 2};  // Kuhn's way: one tetrahedron for each order of the axes
        do {
          std::array<int, 3> at = {x, y, z};
          std::array<std::uint32_t, 4> t{vertex(x, y, z)};
          for (int i = 0; i < 3; ++i) {
            ++at[axes[i]];
            t[i + 1] = vertex(at[0], at[1], at[2]);
          }
          b.tetrahedra.push_back(t);
        } while (std::ranges::next_permutation(axes).found);
      }
  return b;
}

sizes::BackgroundSizes without_tetrahedra(sizes::BackgroundSizes b) {
  b.tetrahedra.clear();
  return b;
}

/// The least target in a box, by bisection.
template <class Field>
double least_target(const Field& field, const Box& box) {
  double low = 0, high = 1;
  while (!field.is_below(box, high)) high *= 2;
  for (int i = 0; i < 60; ++i) {
    const double bound = 0.5 * (low + high);
    (field.is_below(box, bound) ? high : low) = bound;
  }
  return high;
}

/// The edge length of the lattice at a point, from the distance to the nearest of the others.
double edge_length_at(const std::vector<Point3>& points, const Point3& p) {
  double nearest = HUGE_VAL;
  for (const Point3& q : points)
    if (q != p) nearest = std::min(nearest, squared_length(q - p));
  return std::sqrt(nearest);
}

TEST(InterpolatedSizes, AreLinearInATetrahedronCutByABox) {
  const std::array<Point3, 4> corners = {Point3{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}};
  const std::array<double, 4> values = {1, 5, 9, 13};  // 1 + x + 2 y + 3 z
  EXPECT_NEAR(sizes::least_value(corners, values, {{0.5, 0.5, 0.5}, {1, 1, 1}}), 4, 1e-12);
  EXPECT_NEAR(sizes::least_value(corners, values, {{-1, -1, -1}, {9, 9, 9}}), 1,
              1e-12);  // the tetrahedron is in the box
  EXPECT_NEAR(sizes::least_value(corners, values, {{2, -1, -1}, {9, 9, 9}}), 3, 1e-12);  // a corner is cut off
  EXPECT_NEAR(sizes::least_value(corners, values, {{-1, -1, 1}, {9, 9, 1}}), 4, 1e-12);  // a flat box
  EXPECT_EQ(sizes::least_value(corners, values, {{2, 2, 2}, {3, 3, 3}}), HUGE_VAL);      // only the bounding boxes meet
  const std::array<Point3, 4> flat = {corners[0], corners[1], corners[2], Point3{1, 1, 0}};
  EXPECT_EQ(sizes::least_value(flat, values, {{0, 0, 0}, {1, 1, 1}}), HUGE_VAL);
}

TEST(InterpolatedSizes, AreTheLeastOverAnyBoxOfAFineOrACoarseBackground) {
  const auto size_at = [](const Point3& p) { return 10 + p.x + 2 * p.y - 3 * p.z; };
  std::mt19937 random(3);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  for (const int n : {1, 3, 10}) {
    const sizes::BackgroundSizes background = background_cube(n, 1, size_at);
    const sizes::InterpolatedSizes sizes(background);
    for (int i = 0; i < 200; ++i) {
      const Point3 p{coordinate(random), coordinate(random), coordinate(random)};
      const Point3 q{coordinate(random), coordinate(random), coordinate(random)};
      const Box box = bounding_box(std::array{p, q});
      EXPECT_NEAR(least_target(sizes, box), size_at({box.low.x, box.low.y, box.high.z}), 1e-9);
    }
  }
}

TEST(InterpolatedSizes, AreThoseOfTheNearestVertexOutside) {
  const sizes::BackgroundSizes background = background_cube(1, 1, [](const Point3& p) { return p.x > 0 ? 5.0 : 2.0; });
  const sizes::InterpolatedSizes sizes(background);
  EXPECT_NEAR(least_target(sizes, {{7, 1, 1}, {8, 2, 2}}), 5, 1e-9);
  EXPECT_NEAR(least_target(sizes, {{-8, 1, 1}, {-7, 2, 2}}), 2, 1e-9);
  EXPECT_NEAR(least_target(sizes, {{-1, 7, 1}, {1, 8, 2}}), 2, 1e-9);  // half and half
}

TEST(SizeField, IsTheLeastOverPlacesOfSizePlusGradingTimesDistance) {
  std::mt19937 random(1);
  const auto number = [&] { return static_cast<double>(random() % 1000); };
  std::vector<sizes::SizedPlace> places;
  for (int i = 0; i < 500; ++i) {
    const Point3 low{number(), number(), number()};
    places.push_back({{low, low + 0.1 * Point3{number(), number(), number()}}, number()});
  }
  const sizes::SizeField field(90, 0.3, places);
  sizes::SizeWalk walk(field);
  for (int i = 0; i < 500; ++i) {
    const Point3 p{number(), number(), number()};
    double least = 90;
    for (const sizes::SizedPlace& place : places)
      least = std::min(least, place.size + 0.3 * std::sqrt(squared_distance(place.box, p)));
    EXPECT_EQ(field.at(p), least);
    EXPECT_EQ(walk.at(p), least);
    EXPECT_NEAR(least_target(field, box_of(p)), least, 1e-9 * least);
  }
}

TEST(SizeField, OfABackgroundIsTheLeastOverVerticesOfSizePlusGradingTimesDistance) {
  const Shape shape = cube(2);
  const sizes::WantedSizes two{{}, {{}, {}, {{0, 0, 0}, {100, 0, 0}}, {}, {1, 3}}};
  const sizes::SizeField field = lattice::target_sizes(surface_of(shape), 0, 0.5, &two).field;
  EXPECT_NEAR(least_target(field, {{0, 0, 0}, {0, 0, 0}}), 1, 1e-9);
  EXPECT_NEAR(least_target(field, {{0, 10, 0}, {0, 10, 0}}), 6, 1e-9);
  EXPECT_NEAR(least_target(field, {{100, 0, 0}, {100, 0, 0}}), 3, 1e-9);
  EXPECT_NEAR(least_target(field, {{90, 0, -5}, {110, 9, 5}}), 3, 1e-9);
}

TEST(SizeField, OfABackgroundIsBoundedByTheEdgeLength) {
  const Shape shape = cube(2);
  const sizes::BackgroundSizes background = background_cube(2, 1, [](const Point3& p) { return 3 + 2 * p.x; });
  for (const sizes::BackgroundSizes& b : {background, without_tetrahedra(background)}) {
    const sizes::WantedSizes wanted{{}, b};
    const auto [field, reference] = lattice::target_sizes(surface_of(shape), 1.5, 0.5, &wanted);
    EXPECT_NEAR(least_target(field, {{0.9, 0, 0}, {1, 0.1, 0.1}}), 1.5, 1e-9);
    EXPECT_NEAR(least_target(field, {{-1, 0, 0}, {-0.9, 0.1, 0.1}}), 1, 1e-9);
    EXPECT_EQ(reference, 1.5);
  }
}

TEST(SizeFunction, ThatIsConstantMakesTheLatticeOfThatEdgeLength) {
  const Shape shape = cube(6);
  for (const double part : {0.3, 0.45, 0.7}) {
    const double edge_length = part * shape.unit;
    const sizes::WantedSizes constant{{},
                                      background_cube(3, 4 * shape.unit, [&](const Point3&) { return edge_length; })};
    for (const lattice::Lattice kind : lattices) {
      lattice::LatticeOptions options{kind, edge_length, 0};
      const auto wanted = shape.place(options);
      options = {kind, 0, 0.5};
      options.wanted = &constant;
      EXPECT_EQ(shape.place(options), wanted);
    }
  }
}

TEST(SizeFunction, ThatIsLinearIsFollowedWithinTheSquareRootOfTwo) {
  const Shape shape = cube(12);
  const double half = 6 * shape.unit;
  const auto size_at = [&](const Point3& p) { return shape.unit * (0.7 + 0.5 * p.x / half); };
  for (const int n : {1, 9}) {  // a coarse background says the same as a fine one
    const sizes::WantedSizes wanted{{}, background_cube(n, half, size_at)};
    lattice::LatticeOptions options;
    options.wanted = &wanted;
    options.sphere_factor = 0;
    const auto points = shape.place(options);
    std::size_t compared = 0;
    for (std::size_t i = 0; i < points.size(); i += 37) {
      // A leaf is there because its parent, which reaches this far, was too large for its finest corner.
      const Point3 reach{4 * size_at(points[i]), 0, 0};
      const double found = edge_length_at(points, points[i]);
      EXPECT_GE(found, 0.99 * size_at(points[i] - reach) / std::sqrt(2.0));
      EXPECT_LE(found, 1.01 * size_at(points[i]) * std::sqrt(2.0));
      ++compared;
    }
    EXPECT_GT(compared, 50u);
  }
}

TEST(SizeFunction, OfVerticesAloneIsFineAroundTheOneThatIs) {
  const Shape shape = cube(12);
  const sizes::WantedSizes wanted{{},
                                  {{},
                                   {},
                                   {shape.unit * Point3{2, 2, 2}, shape.unit * Point3{-4, -4, -4}},
                                   {},
                                   {0.1 * shape.unit, 2 * shape.unit}}};
  lattice::LatticeOptions options;
  options.wanted = &wanted;
  options.grading = 0.5;
  std::size_t fine = 0;
  for (const Point3& p : shape.place(options))
    if (squared_length(p - wanted.background.vertices[0]) < std::pow(0.2 * shape.unit, 2)) ++fine;
  const double count = std::sqrt(2.0) * 4.0 / 3 * std::numbers::pi * std::pow(0.2 / 0.15, 3);
  EXPECT_GT(static_cast<double>(fine), count / 3);
  EXPECT_LT(static_cast<double>(fine), count * 6);
}

TEST(SizeFunction, TakesThePlaceOfTheSurfacesOwnEdgeLengths) {
  const Shape coarse = cube(2), fine = cube(8);  // the same cube in grid units, twice
  const sizes::WantedSizes wanted{{},
                                  background_cube(2, coarse.unit, [&](const Point3&) { return coarse.unit * 0.125; })};
  lattice::LatticeOptions options;
  options.wanted = &wanted;
  options.sphere_factor = 0;
  EXPECT_EQ(coarse.place(options), fine.place(options));
  EXPECT_GT(coarse.place(options).size(), 1000u);
}

TEST(SizeFunction, ThatAsksForTooMuchIsDeclinedBeforeItFillsTheMemory) {
  const Shape shape = cube(2);
  const sizes::WantedSizes tiny{{}, background_cube(1, shape.unit, [&](const Point3&) { return 1e-4 * shape.unit; })};
  lattice::LatticeOptions options;
  options.wanted = &tiny;
  EXPECT_THROW(shape.place(options), LimitError);
}

TEST(SphereFactor, ScalesTheSpheresThatNoPointMayBeIn) {
  const Shape shape = cube(4);
  const double edge_length = 0.2 * shape.unit;
  std::size_t last = 0;
  for (const double factor : {1.5, 1.0, 0.7, 0.0}) {
    lattice::LatticeOptions options{lattice::Lattice::fcc, edge_length, 0};
    options.sphere_factor = factor;
    const auto points = shape.place(options);
    EXPECT_GT(points.size(), last);
    last = points.size();
    for (const Point3& p : points)
      for (std::uint32_t t = 0; t < shape.triangles.size(); ++t) {
        // All triangles are half squares, so their spheres are those of their longest edges.
        const lattice::TrianglePoints c = surface_of(shape).corners(t);
        const Box box = bounding_box(c);
        EXPECT_GT(std::sqrt(squared_length(p - box.center())), factor * std::sqrt(0.5) * shape.unit);
      }
  }
}

TEST(Clearance, IsTheLeastDistanceToTheSurfaceInEdgeLengths) {
  const Shape shape = cube(10);
  const double edge_length = 0.4 * shape.unit;
  for (const double clearance : {0.0, 0.25, 0.55, 1.2}) {
    lattice::LatticeOptions options{lattice::Lattice::fcc, edge_length, 0};
    options.sphere_factor = 0;
    options.clearance = clearance;
    double least = HUGE_VAL;
    for (const Point3& p : shape.place(options))
      for (const double c : as_array(p)) least = std::min(least, 5 * shape.unit - std::abs(c));
    EXPECT_GE(least, 0.99 * clearance * edge_length);
    EXPECT_LE(least, (clearance + 0.75) * edge_length);
  }
}

}  // namespace
}  // namespace ccdt::test
