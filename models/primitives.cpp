#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "models/parts.h"
#include "models/revolve.h"

namespace ccdt::models {
namespace {

int parts_of(double length, double edge_length) {
  return std::max(1, static_cast<int>(std::lround(length / edge_length)));
}

/// The point of the great circle from a to b at the fraction i / n, the same bits from either end.
Point3 between(const Point3& a, const Point3& b, int i, int n) {
  const double angle = std::acos(dot(a, b));
  return normalized(std::sin(angle * (n - i) / n) * a + std::sin(angle * i / n) * b);
}

struct Icosahedron {
  std::array<Point3, 12> vertices;
  std::array<std::array<std::uint32_t, 3>, 20> triangles;
};

/// Poles on the z axis and two rings of five.
Icosahedron icosahedron() {
  Icosahedron ico{};
  const double z = 1 / std::sqrt(5.0), r = 2 / std::sqrt(5.0);
  ico.vertices[0] = {0, 0, 1};
  ico.vertices[11] = {0, 0, -1};
  for (std::uint32_t i = 0; i < 5; ++i) {
    ico.vertices[1 + i] = {r * cosine(72.0 * i), r * sine(72.0 * i), z};
    ico.vertices[6 + i] = {r * cosine(72.0 * i + 36), r * sine(72.0 * i + 36), -z};
    const std::uint32_t upper = 1 + i, upper_next = 1 + (i + 1) % 5, lower = 6 + i, lower_next = 6 + (i + 1) % 5;
    ico.triangles[4 * i] = {0, upper, upper_next};
    ico.triangles[4 * i + 1] = {upper, lower, upper_next};
    ico.triangles[4 * i + 2] = {lower, lower_next, upper_next};
    ico.triangles[4 * i + 3] = {11, lower_next, lower};
  }
  return ico;
}

/// A point of the spherical triangle abc with integer weights that add up to n: the mean of the three ways to go along
/// great circles.
Point3 inside_triangle(const Point3& a, const Point3& b, const Point3& c, int i, int j, int n) {
  const int k = n - i - j;  // weights: k of a, i of b, j of c
  const Point3 p = between(between(a, b, n - k, n), between(a, c, n - k, n), j, i + j);
  const Point3 q = between(between(b, c, n - i, n), between(b, a, n - i, n), k, j + k);
  const Point3 r = between(between(c, a, n - j, n), between(c, b, n - j, n), i, k + i);
  return normalized(p + q + r);
}

}  // namespace

plc::InputPlc make_cube(double edge_length) {
  const int n = parts_of(1, edge_length);
  ModelSurface surface;
  const auto at = [&](Axis axis, int i, int j, int k) {
    const auto coordinate = [n](int step) { return static_cast<double>(step) / n; };
    return corner(surface, to_model(axis, {coordinate(i), coordinate(j), coordinate(k)}));
  };
  int marker = 0;
  for (const Axis axis : {Axis::x, Axis::y, Axis::z}) {
    for (const int k : {0, n}) {
      ++marker;
      for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
          std::array<std::uint32_t, 4> square{at(axis, i, j, k), at(axis, i + 1, j, k), at(axis, i + 1, j + 1, k),
                                              at(axis, i, j + 1, k)};
          if (k == 0) std::swap(square[1], square[3]);
          add_triangle(surface, square[0], square[1], square[2], marker);
          add_triangle(surface, square[0], square[2], square[3], marker);
        }
      }
    }
  }
  return to_input(std::move(surface), plc::InputPlc::Inside::even_odd);
}

plc::InputPlc make_sphere(double edge_length) {
  const Icosahedron ico = icosahedron();
  // With this length over n as their edge length, 20 n^2 equilateral triangles have the area of the sphere.
  const double rough_edge = 4 * std::sqrt(std::numbers::pi / (20 * std::numbers::sqrt3));
  const int n = parts_of(rough_edge, edge_length);
  ModelSurface surface;
  std::map<std::pair<std::uint32_t, std::uint32_t>, Chain> edges;
  for (const Point3& p : ico.vertices) add_vertex(surface, p);
  const auto edge = [&](std::uint32_t from, std::uint32_t to) {
    const auto key = std::minmax(from, to);
    Chain& chain = edges[key];
    if (chain.empty()) {
      chain.push_back(key.first);
      for (int i = 1; i < n; ++i) {
        chain.push_back(add_vertex(surface, between(ico.vertices[key.first], ico.vertices[key.second], i, n)));
      }
      chain.push_back(key.second);
    }
    return from < to ? chain : reversed(chain);
  };
  for (const auto& [a, b, c] : ico.triangles) {
    const Chain ab = edge(a, b), ac = edge(a, c), bc = edge(b, c);
    Chain before{a};
    for (int row = 1; row <= n; ++row) {
      Chain here{ab[static_cast<std::size_t>(row)]};
      for (int j = 1; j < row; ++j) {
        here.push_back(row == n ? bc[static_cast<std::size_t>(j)]
                                : add_vertex(surface, inside_triangle(ico.vertices[a], ico.vertices[b], ico.vertices[c],
                                                                      row - j, j, n)));
      }
      here.push_back(ac[static_cast<std::size_t>(row)]);
      for (std::size_t j = 0; j + 1 < here.size(); ++j) {
        add_triangle(surface, before[j], here[j], here[j + 1], 1);
        if (j + 1 < before.size()) add_triangle(surface, before[j], here[j + 1], before[j + 1], 1);
      }
      before = std::move(here);
    }
  }
  return to_input(std::move(surface), plc::InputPlc::Inside::even_odd);
}

plc::InputPlc make_torus(double edge_length) {
  constexpr double major = 1, minor = 0.4;
  const int rows = std::max(8, static_cast<int>(std::lround(2 * std::numbers::pi * minor / edge_length / 0.866)));
  ModelSurface surface;
  const Revolution revolution{Axis::z, {}, edge_length, 1};
  std::vector<Ring> rings;
  for (int i = 0; i < rows; ++i) {
    const double angle = 360.0 * i / rows;
    const ProfilePoint at{major + minor * cosine(angle), minor * sine(angle)};
    rings.push_back(inner_ring(surface, revolution, at, std::min(edge_length, at.radius / 2), 0.5 * (i % 2)));
  }
  add_closed_rows(surface, rings, revolution);
  return to_input(std::move(surface), plc::InputPlc::Inside::even_odd);
}

plc::InputPlc make_schoenhardt(double) {
  plc::InputPlc input;
  for (const double height : {0.0, 1.0}) {
    for (const double degrees : {0.0, 120.0, 240.0}) {
      input.vertices.push_back(on_circle(Axis::z, {0, 0, height}, 1, degrees + 30 * height));
    }
  }
  // Each side is folded inward along one of its two diagonals, which is a reflex edge.
  input.triangles = {{0, 2, 1}, {3, 4, 5}};
  for (std::uint32_t i = 0; i < 3; ++i) {
    const std::uint32_t next = (i + 1) % 3;
    input.triangles.push_back({i, next, next + 3});
    input.triangles.push_back({i, next + 3, i + 3});
  }
  input.triangle_markers = {1, 2, 3, 3, 3, 3, 3, 3};
  return input;
}

}  // namespace ccdt::models
