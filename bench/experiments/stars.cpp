#include "bench/experiments/stars.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace ccdt {
namespace {

constexpr double half_cube = 4;
constexpr std::uint32_t apex = 8;  ///< after the corners of the cube

double radians(double degrees) {
  return degrees * std::numbers::pi / 180;
}

/// A cube around the apex.
InputPlc cube_around_apex() {
  InputPlc plc;
  plc.inside = InputPlc::Inside::seeds;
  for (int i = 0; i < 8; ++i)
    plc.vertices.push_back(half_cube * Point3{i & 1 ? 1.0 : -1.0, i & 2 ? 1.0 : -1.0, i & 4 ? 1.0 : -1.0});
  constexpr std::array<std::array<std::uint32_t, 4>, 6> sides = {
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  for (const auto& [a, b, c, d] : sides) {
    plc.triangles.push_back({a, b, c});
    plc.triangles.push_back({a, c, d});
  }
  plc.vertices.push_back({0, 0, 0});
  return plc;
}

std::vector<double> lengths(std::size_t count, std::uint64_t variant) {
  std::vector<double> result;
  std::mt19937_64 random(variant);
  for (std::size_t i = 0; i < count; ++i) {
    const double fraction = static_cast<double>(random() >> 11) * 0x1p-53;
    result.push_back(variant > 0 ? 0.4 + 1.2 * fraction : i % 2 == 0 ? 1 : std::numbers::sqrt2 / 2);
  }
  return result;
}

/// Segments from the apex in the given directions, of length one.
InputPlc segments_along(const std::vector<Point3>& directions, std::uint64_t variant) {
  InputPlc plc = cube_around_apex();
  const std::vector<double> length = lengths(directions.size(), variant);
  for (std::size_t i = 0; i < directions.size(); ++i) {
    plc.segments.push_back({apex, static_cast<std::uint32_t>(plc.vertices.size())});
    plc.vertices.push_back(length[i] * directions[i]);
  }
  return plc;
}

/// At an angle with the z axis, turned about it.
Point3 direction(double polar, double turn) {
  return {std::sin(polar) * std::cos(turn), std::sin(polar) * std::sin(turn), std::cos(polar)};
}

InputPlc pair(double degrees, std::uint64_t variant) {
  return segments_along({direction(0, 0), direction(radians(degrees), 0.3)}, variant);
}

/// Three directions, each two of which enclose the angle.
std::vector<Point3> three_directions(double degrees) {
  // A regular triangle on the unit sphere with sides of the angle has this circumradius.
  const double polar = std::asin(2 / std::sqrt(3.0) * std::sin(radians(degrees) / 2));
  std::vector<Point3> directions;
  for (int i = 0; i < 3; ++i) directions.push_back(direction(polar, 0.3 + radians(120 * i)));
  return directions;
}

InputPlc trio(double degrees, std::uint64_t variant) {
  return segments_along(three_directions(degrees), variant);
}

InputPlc bundle(double degrees, std::uint64_t variant) {
  std::vector<Point3> directions = {direction(0, 0)};
  for (int i = 0; i < 3; ++i) directions.push_back(direction(radians(degrees), 0.3 + radians(120 * i)));
  return segments_along(directions, variant);
}

InputPlc fins(double degrees, std::uint64_t variant) {
  constexpr std::uint32_t count = 3;
  constexpr double tip = 60;  // degrees from the common edge
  InputPlc plc = cube_around_apex();
  const std::vector<double> length = lengths(count, variant);
  plc.vertices.push_back(direction(0, 0));
  for (std::uint32_t i = 0; i < count; ++i) {
    plc.triangles.push_back({apex, apex + 1, static_cast<std::uint32_t>(plc.vertices.size())});
    plc.vertices.push_back(length[i] * direction(radians(tip), 0.3 + radians(i * degrees)));
  }
  return plc;
}

InputPlc wheel(double degrees, std::uint64_t variant) {
  const double spokes = std::round(360 / degrees);
  std::vector<Point3> directions;
  for (int i = 0; i < spokes; ++i) directions.push_back(direction(radians(90), radians(i * 360 / spokes)));
  for (Point3& d : directions) d.z = 0;  // in a plane, exactly
  return segments_along(directions, variant);
}

/// Directions all over the sphere (a Fibonacci spiral; Gonzalez 2010), so many that the angles to the nearest are about
/// as wanted.
InputPlc urchin(double degrees, std::uint64_t variant) {
  const double golden_angle = std::numbers::pi * (3 - std::sqrt(5.0));
  const double nearest = radians(degrees);
  const double count = std::round(4 * std::numbers::pi / (nearest * nearest));
  std::vector<Point3> directions;
  for (int i = 0; i < count; ++i) directions.push_back(direction(std::acos(1 - (2 * i + 1) / count), i * golden_angle));
  return segments_along(directions, variant);
}

constexpr std::array all_stars = {
    Star{"two segments", "Two segments that enclose the angle.", 1, pair},
    Star{"three segments", "Three segments, each two of which enclose the angle.", 1, trio},
    Star{"bundle", "A segment in the middle of three others, which have the angle with it.", 1, bundle},
    Star{"fins", "Three triangles at one common edge, with the angle between neighbours.", 1, fins},
    Star{"wheel", "Segments all around a point in a plane, with the angle between neighbours.", 1, wheel},
    Star{"urchin", "Segments all around a point in space, with about the angle between neighbours.", 5, urchin},
};

}  // namespace

std::span<const Star> stars() {
  return all_stars;
}

double smallest_angle(const Plc& plc) {
  std::vector<std::vector<Point3>> at(plc.vertices.size());
  for (const Segment& s : plc.segments)
    for (int i = 0; i < 2; ++i) at[s.ends[i]].push_back(plc.world[s.ends[1 - i]] - plc.world[s.ends[i]]);
  double smallest = 180;
  for (const auto& directions : at)
    for (std::size_t i = 0; i < directions.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const double sine = std::sqrt(squared_length(cross(directions[i], directions[j])));
        smallest = std::min(smallest, std::atan2(sine, dot(directions[i], directions[j])) * 180 / std::numbers::pi);
      }
  return smallest;
}

}  // namespace ccdt
