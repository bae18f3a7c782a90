#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <vector>

#include "engine/geometry/grid.h"
#include "engine/lattice/place_lattice_points.h"

namespace ccdt::test {

/// A domain for the lattice, in grid units, and how large a unit of its description is.
struct Shape {
  std::vector<Point3> vertices;
  std::vector<lattice::SurfaceTriangle> triangles;
  std::vector<std::array<VertexId, 2>> subsegments;
  double unit = 1;

  std::vector<Point3> place(const lattice::LatticeOptions& options) const {
    return lattice::place_lattice_points({vertices, triangles, subsegments}, options).points;
  }
};

inline constexpr std::array lattices = {lattice::Lattice::fcc, lattice::Lattice::bcc, lattice::Lattice::sc};

inline lattice::DomainSurface surface_of(const Shape& shape) {
  return {shape.vertices, shape.triangles, shape.subsegments};
}

/// Puts vertices on the dyadic grid.
inline void put_on_grid(Shape& shape) {
  const DyadicGrid grid = make_grid(shape.vertices);
  for (Point3& p : shape.vertices) p = grid.snap(p);
  shape.unit = 1 / grid.unit;
}

/// A rotation without symmetry.
inline Point3 turned(const Point3& p) {
  const Point3 x{2.0 / 3, -1.0 / 3, 2.0 / 3}, y{2.0 / 3, 2.0 / 3, -1.0 / 3}, z{-1.0 / 3, 2.0 / 3, 2.0 / 3};
  const double c = std::cos(0.3), s = std::sin(0.3);
  const Point3 q{c * p.x - s * p.y, s * p.x + c * p.y, p.z};
  return q.x * x + q.y * y + q.z * z;
}

/// Unit cubes in a box of n^3, each in the region that `region_of` says; 0 is outside. Squares between different
/// regions are triangles of the surface.
inline Shape cubes(int n, const std::function<int(int, int, int)>& region_of, bool turn = false) {
  Shape shape;
  std::map<std::array<int, 3>, VertexId> ids;
  const auto vertex = [&](std::array<int, 3> p) {
    const auto [at, fresh] = ids.try_emplace(p, VertexId(shape.vertices.size()));
    if (fresh) {
      const Point3 place{double(p[0]), double(p[1]), double(p[2])};
      shape.vertices.push_back(turn ? turned(place) : place);
    }
    return at->second;
  };
  const auto region = [&](std::array<int, 3> c) {
    for (int k : c) {
      if (k < 0 || k >= n) return 0;
    }
    return region_of(c[0], c[1], c[2]);
  };
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (int i = 0; i < (n + 1) * n * n; ++i) {
      std::array<int, 3> high{};
      high[axis] = i % (n + 1), high[u] = i / (n + 1) % n, high[v] = i / (n + 1) / n;
      auto low = high;
      --low[axis];
      const int above = region(high), below = region(low);
      if (above == below) continue;
      auto b = high, c = high, d = high;
      ++b[u], ++c[u], ++c[v], ++d[v];
      for (const auto& t : {std::array{high, b, c}, std::array{high, c, d}})
        shape.triangles.push_back({{vertex(t[0]), vertex(t[1]), vertex(t[2])}, above != 0, below != 0});
    }
  }
  put_on_grid(shape);
  return shape;
}

inline Shape cube(int n, bool turn = false) {
  return cubes(
      n, [](int, int, int) { return 1; }, turn);
}

/// Adds a sphere of 20 * 4^subdivisions triangles, before `put_on_grid`.
inline void add_sphere(Shape& shape, int subdivisions, double radius, bool inside_above, bool inside_below) {
  const double t = std::numbers::phi;
  const std::size_t first = shape.vertices.size();
  std::vector<Point3> v = {{-1, t, 0},  {1, t, 0},  {-1, -t, 0}, {1, -t, 0}, {0, -1, t},  {0, 1, t},
                           {0, -1, -t}, {0, 1, -t}, {t, 0, -1},  {t, 0, 1},  {-t, 0, -1}, {-t, 0, 1}};
  std::vector<std::array<int, 3>> faces = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                           {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                           {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                           {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
  for (int s = 0; s < subdivisions; ++s) {
    std::map<std::array<int, 2>, int> middles;
    std::vector<std::array<int, 3>> finer;
    const auto middle = [&](int a, int b) {
      const auto [at, fresh] = middles.try_emplace({std::min(a, b), std::max(a, b)}, int(v.size()));
      if (fresh) v.push_back(v[a] + v[b]);
      return at->second;
    };
    for (auto& p : v) p = (1 / std::sqrt(squared_length(p))) * p;
    for (const auto& [a, b, c] : faces) {
      const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    faces = finer;
  }
  for (const Point3& p : v) shape.vertices.push_back((radius / std::sqrt(squared_length(p))) * p);
  for (const auto& f : faces)
    shape.triangles.push_back(
        {{VertexId(first + f[0]), VertexId(first + f[1]), VertexId(first + f[2])}, inside_above, inside_below});
}

inline Shape sphere(int subdivisions) {
  Shape shape;
  add_sphere(shape, subdivisions, 1, false, true);
  put_on_grid(shape);
  return shape;
}

/// How often the domain's boundary winds around p, by solid angles (van Oosterom and Strackee 1983): 1 inside, 0
/// outside.
inline double winding_number(const Shape& shape, const Point3& p) {
  double angle = 0;
  for (const lattice::SurfaceTriangle& t : shape.triangles) {
    const int side = int{t.inside_below} - int{t.inside_above};
    if (side == 0) continue;
    const Point3 a = shape.vertices[t.vertices[0]] - p, b = shape.vertices[t.vertices[1]] - p,
                 c = shape.vertices[t.vertices[2]] - p;
    const double la = std::sqrt(squared_length(a)), lb = std::sqrt(squared_length(b)),
                 lc = std::sqrt(squared_length(c));
    const double below = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
    angle += side * 2 * std::atan2(dot(a, cross(b, c)), below);
  }
  return angle / (4 * std::numbers::pi);
}

/// Fine squares near one corner of a large cube.
inline Shape cube_with_a_fine_corner() {
  Shape shape = cube(8);
  const double fine = shape.unit / 16;
  const Point3 corner = shape.unit * Point3{-3.5, -3.5, -3.5};
  for (int i = 0; i < 3; ++i) {
    shape.vertices.push_back(corner + Point3{i == 0 ? fine : 0, i == 1 ? fine : 0, i == 2 ? fine : 0});
  }
  const auto last = shape.vertices.size();
  shape.triangles.push_back({{VertexId(last - 3), VertexId(last - 2), VertexId(last - 1)}, true, true});
  return shape;
}

}  // namespace ccdt::test
