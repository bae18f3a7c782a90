#include "models/stars.h"

#include <array>
#include <cmath>
#include <numbers>
#include <random>

namespace ccdt::models {
namespace {

constexpr double half_cube = 4;
constexpr std::uint32_t apex = 8;  ///< after the corners of the cube

double radians(double degrees) {
  return degrees * std::numbers::pi / 180;
}

/// At an angle with the z axis, turned about it.
Point3 direction(double polar, double turn) {
  return {std::sin(polar) * std::cos(turn), std::sin(polar) * std::sin(turn), std::cos(polar)};
}

/// Three directions about the z axis, `step` degrees apart.
std::vector<Point3> three_around(double polar, double step) {
  std::vector<Point3> directions;
  for (int i = 0; i < 3; ++i) directions.push_back(direction(polar, 0.3 + radians(i * step)));
  return directions;
}

std::vector<Point3> pair(double degrees) {
  return {direction(0, 0), direction(radians(degrees), 0.3)};
}

std::vector<Point3> trio(double degrees) {
  // A regular triangle on the unit sphere with sides of the angle has this circumradius.
  return three_around(std::asin(2 / std::sqrt(3.0) * std::sin(radians(degrees) / 2)), 120);
}

std::vector<Point3> bundle(double degrees) {
  std::vector<Point3> directions = three_around(radians(degrees), 120);
  directions.insert(directions.begin(), direction(0, 0));
  return directions;
}

std::vector<Point3> fins(double degrees) {
  constexpr double tip = 60;  // degrees from the common edge
  return three_around(radians(tip), degrees);
}

std::vector<Point3> wheel(double degrees) {
  const double spokes = std::round(360 / degrees);
  std::vector<Point3> directions;
  for (int i = 0; i < spokes; ++i) directions.push_back(direction(radians(90), radians(i * 360 / spokes)));
  for (Point3& d : directions) d.z = 0;  // in a plane, exactly
  return directions;
}

/// Directions all over the sphere (a Fibonacci spiral; Gonzalez 2010). Their number is such that neighbors have about
/// the wanted angle.
std::vector<Point3> urchin(double degrees) {
  const double golden_angle = std::numbers::pi * (3 - std::sqrt(5.0));
  const double nearest = radians(degrees);
  const double count = std::round(4 * std::numbers::pi / (nearest * nearest));
  std::vector<Point3> directions;
  for (int i = 0; i < count; ++i) directions.push_back(direction(std::acos(1 - (2 * i + 1) / count), i * golden_angle));
  return directions;
}

constexpr std::array all_stars = {
    Star{"two segments", "Two segments that enclose the angle.", 1, false, pair},
    Star{"three segments", "Three segments, with the angle between any two of them.", 1, false, trio},
    Star{"bundle", "A segment in the middle of three others, with the angle to each of them.", 1, false, bundle},
    Star{"fins", "Three triangles at one common edge, with the angle between neighbors.", 1, true, fins},
    Star{"wheel", "Segments all around a point in a plane, with the angle between neighbors.", 1, false, wheel},
    Star{"urchin", "Segments all around a point in space, with about the angle between neighbors.", 5, false, urchin},
};

/// A cube around the apex.
plc::InputPlc cube_around_apex() {
  plc::InputPlc plc;
  plc.inside = plc::InputPlc::Inside::seeds;
  for (int i = 0; i < 8; ++i)
    plc.vertices.push_back(half_cube * Point3{i & 1 ? 1.0 : -1.0, i & 2 ? 1.0 : -1.0, i & 4 ? 1.0 : -1.0});
  constexpr std::array<std::array<std::uint32_t, 4>, 6> sides = {
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  for (const auto& [a, b, c, d] : sides) plc.triangles.insert(plc.triangles.end(), {{a, b, c}, {a, c, d}});
  plc.vertices.push_back({0, 0, 0});
  return plc;
}

}  // namespace

std::span<const Star> stars() {
  return all_stars;
}

plc::InputPlc make_star(const Star& star, double degrees, std::uint64_t variant) {
  plc::InputPlc plc = cube_around_apex();
  if (star.has_fins) plc.vertices.push_back(direction(0, 0));
  std::mt19937_64 random(variant);
  bool is_long = true;
  for (const Point3& toward : star.directions(degrees)) {
    const auto tip = static_cast<std::uint32_t>(plc.vertices.size());
    const double fraction = static_cast<double>(random() >> 11) * 0x1p-53;
    const double length = variant > 0 ? 0.4 + 1.2 * fraction : is_long ? 1 : std::numbers::sqrt2 / 2;
    plc.vertices.push_back(length * toward);
    if (star.has_fins)
      plc.triangles.push_back({apex, apex + 1, tip});
    else
      plc.segments.push_back({apex, tip});
    is_long = !is_long;
  }
  return plc;
}

}  // namespace ccdt::models
