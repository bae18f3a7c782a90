#pragma once

#include <array>
#include <cmath>
#include <map>
#include <random>

#include "engine/tests/shared/plc_test_solids.h"

/// Small inputs that a mesher has to get right, beyond those of plc_test_solids.h.
namespace ccdt::mesh_test {

using namespace plc_test;

/// An arbitrary rotation: after it nothing is axis-parallel and nothing flat is exactly flat.
inline const Matrix oblique = plc_test::rotation(0.3, 0.7, -0.2, 0.55);

inline Matrix random_rotation(std::mt19937& random) {
  std::normal_distribution<double> part;
  const double w = part(random), x = part(random), y = part(random), z = part(random);
  return plc_test::rotation(w, x, y, z);
}

template <class Map>
plc::InputPlc mapped(plc::InputPlc plc, const Map& map) {
  for (Point3& p : plc.vertices) p = map(p);
  for (Point3& p : plc.holes) p = map(p);
  for (auto& region : plc.regions) region.seed = map(region.seed);
  return plc;
}

/// A cube of side 3 whose inside is marked by seeds, so that it may contain facets.
inline plc::InputPlc seeded_cube() {
  plc::InputPlc plc = box({0, 0, 0}, {3, 3, 3});
  plc.inside = plc::InputPlc::Inside::seeds;
  return plc;
}

inline plc::InputPlc cube_with_cubic_hole() {
  plc::InputPlc plc = box({0, 0, 0}, {3, 3, 3});
  append(plc, box({1, 1, 1}, {2, 2, 2}));
  return plc;
}

/// The same, but the inner cube is filled: regions 3 and 4.
inline plc::InputPlc cube_within_cube() {
  plc::InputPlc plc = cube_with_cubic_hole();
  plc.inside = plc::InputPlc::Inside::seeds;
  plc.regions = {{{0.5, 0.4, 0.3}, 3, 0}, {{1.5, 1.4, 1.3}, 4, 0}};
  return plc;
}

/// Two unit cubes that share the face x = 1; regions 1 and 2.
inline plc::InputPlc two_cubes() {
  plc::InputPlc plc;
  plc.inside = plc::InputPlc::Inside::seeds;
  for (int x = 0; x < 3; ++x)
    for (int i = 0; i < 4; ++i) plc.vertices.push_back({double(x), double(i & 1), double(i >> 1)});
  for (std::uint32_t x = 0; x < 3; ++x) append_fan(plc, {4 * x, 4 * x + 1, 4 * x + 3, 4 * x + 2});
  for (std::uint32_t x = 0; x < 2; ++x)
    for (const auto& [a, b] : {std::array{0u, 1u}, {1u, 3u}, {3u, 2u}, {2u, 0u}})
      append_fan(plc, {4 * x + a, 4 * x + b, 4 * x + 4 + b, 4 * x + 4 + a});
  plc.regions = {{{0.5, 0.4, 0.3}, 1, 0}, {{1.5, 0.4, 0.3}, 2, 0}};
  return plc;
}

/// The same for a surface format, which has no seeds.
inline plc::InputPlc two_cubes_as_surface() {
  plc::InputPlc plc = two_cubes();
  plc.inside = plc::InputPlc::Inside::even_odd;
  plc.regions.clear();
  return plc;
}

/// A cube with a square slit that touches nothing.
inline plc::InputPlc cube_with_slit() {
  plc::InputPlc plc = seeded_cube();
  plc.vertices.insert(plc.vertices.end(), {{1, 1, 1.25}, {2, 1, 1.25}, {2, 2, 1.25}, {1, 2, 1.25}});
  append_fan(plc, {8, 9, 10, 11});
  return plc;
}

/// A cube with a facet that stands on a piece of one of its edges.
inline plc::InputPlc cube_with_dangling_facet() {
  plc::InputPlc plc = box({0, 0, 0}, {3, 3, 3});
  plc.inside = plc::InputPlc::Inside::seeds;
  plc.vertices.insert(plc.vertices.end(), {{2, 2, 1}, {2, 2, 2}});
  append_fan(plc, {0, 8, 9, 4});
  return plc;
}

inline plc::InputPlc cube_with_dangling_segment() {
  plc::InputPlc plc = seeded_cube();
  plc.vertices.push_back({2, 1.5, 1});
  plc.segments = {{0, 8}};
  return plc;
}

/// A segment that touches nothing, and three vertices so near to it that it has to be split.
inline plc::InputPlc cube_with_floating_segment() {
  plc::InputPlc plc = seeded_cube();
  plc.vertices.insert(plc.vertices.end(), {{1, 1.5, 1}, {2, 1.5, 2}, {1.5, 1.5, 1.625}, {1.5, 1.375, 1.5}});
  plc.vertices.push_back({1.5, 1.625, 1.4375});
  plc.segments = {{8, 9}};
  return plc;
}

/// Three slits around one edge, like the wings of a turnstile.
inline plc::InputPlc cube_with_turnstile() {
  plc::InputPlc plc = seeded_cube();
  for (const auto& [x, y] : {std::array{1.0, 1.0}, {2.0, 1.0}, {0.5, 1.5}, {0.75, 0.25}})
    plc.vertices.insert(plc.vertices.end(), {{x, y, 1}, {x, y, 2}});
  for (const std::uint32_t wing : {10u, 12u, 14u}) append_fan(plc, {8, wing, wing + 1, 9});
  return plc;
}

/// A prism over a regular polygon whose top is turned by a fraction of the angle between corners. Three corners and a
/// quarter make Schoenhardt's polyhedron. With a negative turn it is convex. All vertices are on one sphere.
inline plc::InputPlc twisted_prism(std::uint32_t corners, double turn, double height = 1) {
  plc::InputPlc plc;
  const double step = 2 * std::acos(-1.0) / corners;
  for (std::uint32_t k = 0; k < 2 * corners; ++k) {
    const double angle = step * (k % corners + (k < corners ? 0 : turn));
    plc.vertices.push_back({std::cos(angle), std::sin(angle), k < corners ? 0.0 : height});
  }
  std::vector<std::uint32_t> bottom, top;
  for (std::uint32_t k = 0; k < corners; ++k) {
    const std::uint32_t l = (k + 1) % corners;
    bottom.push_back((corners - k) % corners);
    top.push_back(corners + k);
    plc.triangles.push_back({k, l, corners + l});
    plc.triangles.push_back({k, corners + l, corners + k});
  }
  append_fan(plc, bottom);
  append_fan(plc, top);
  return plc;
}

/// Two bars that do not touch: a long one, and a short one so near to the middle of its long edges that these are not
/// Delaunay edges. All edges are convex.
inline plc::InputPlc two_bars() {
  plc::InputPlc plc = box({0, 0, 0}, {8, 1, 1});
  append(plc, box({3.5, 1.125, 0.25}, {4.5, 2, 0.75}));
  append(plc, box({3.5, 0.25, 1.125}, {4.5, 0.75, 2}));
  return plc;
}

/// An input, and what to call it in a message.
struct Named {
  const char* name;
  plc::InputPlc plc;
};

/// One of each kind.
inline std::vector<Named> small_inputs() {
  return {{"cube", unit_cube()},
          {"L", l_shape()},
          {"Schoenhardt's polyhedron", plc_test::schoenhardt()},
          {"cube with a cubic hole", cube_with_cubic_hole()},
          {"cube within a cube", cube_within_cube()},
          {"two cubes", two_cubes()},
          {"two cubes as a surface", two_cubes_as_surface()},
          {"slit", cube_with_slit()},
          {"dangling facet", cube_with_dangling_facet()},
          {"dangling segment", cube_with_dangling_segment()},
          {"floating segment", cube_with_floating_segment()},
          {"turnstile", cube_with_turnstile()},
          {"two bars", two_bars()}};
}

/// The convex hull of random points on the unit sphere.
inline plc::InputPlc random_convex(std::uint32_t points, std::mt19937& random) {
  plc::InputPlc plc;
  std::normal_distribution<double> part;
  for (std::uint32_t i = 0; i < points; ++i) {
    const double x = part(random), y = part(random), z = part(random);
    plc.vertices.push_back((1 / std::sqrt(x * x + y * y + z * z)) * Point3{x, y, z});
  }
  const auto is_outermost = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const Point3& origin = plc.vertices[a];
    const Point3 normal = cross(plc.vertices[b] - origin, plc.vertices[c] - origin);
    for (std::uint32_t d = 0; d < points; ++d)
      if (d != a && d != b && d != c && dot(normal, plc.vertices[d] - origin) > 0) return false;
    return true;
  };
  for (std::uint32_t a = 0; a < points; ++a)
    for (std::uint32_t b = a + 1; b < points; ++b)
      for (std::uint32_t c = a + 1; c < points; ++c)
        if (b != c && is_outermost(a, b, c)) plc.triangles.push_back({a, b, c});
  return plc;
}

/// Unit cubes with random labels: facets are where labels differ, so there are edges and vertices of every kind.
/// Label 0 means empty, but empty cubes that others enclose are filled, because no hole is marked there.
inline plc::InputPlc random_voxels(int n, int labels, std::mt19937& random) {
  std::vector<int> label(n * n * n);
  for (int& l : label) l = static_cast<int>(random() % labels);
  label[0] = 1;  // so that not all cubes are empty
  using Place = std::array<int, 3>;
  const auto label_at = [&](const Place& p) {
    for (const int c : p)
      if (c < 0 || c >= n) return 0;
    return label[(p[2] * n + p[1]) * n + p[0]];
  };
  plc::InputPlc plc;
  plc.inside = plc::InputPlc::Inside::seeds;
  std::map<Place, std::uint32_t> numbers;
  const auto vertex = [&](const Place& p) {
    const auto [entry, is_new] = numbers.try_emplace(p, static_cast<std::uint32_t>(plc.vertices.size()));
    if (is_new) plc.vertices.push_back({double(p[0]), double(p[1]), double(p[2])});
    return entry->second;
  };
  const int m = n + 1;
  for (int axis = 0; axis < 3; ++axis)
    for (int i = 0; i < m * m * m; ++i) {
      const Place here = {i % m, i / m % m, i / m / m};
      Place before = here, u = here, v = here, w = here;
      --before[axis], ++u[(axis + 1) % 3], ++v[(axis + 2) % 3], ++w[(axis + 1) % 3], ++w[(axis + 2) % 3];
      if (label_at(here) != label_at(before)) append_fan(plc, {vertex(here), vertex(u), vertex(w), vertex(v)});
    }
  return plc;
}

/// A projective map of the cube [0, size]^3: planes stay planes, but right angles do not stay right.
inline plc::InputPlc in_perspective(const plc::InputPlc& plc, double size) {
  return mapped(plc, [size](const Point3& p) {
    const Point3 q = (1 / size) * p;
    return (1 / (1 + 0.4 * q.x + 0.3 * q.y + 0.7 * q.z)) * q;
  });
}

/// Moves every vertex of a surface around the origin toward it, by a random amount: reflex edges everywhere.
inline plc::InputPlc roughened(plc::InputPlc plc, double least, std::mt19937& random) {
  std::uniform_real_distribution<double> factor(least, 1);
  for (Point3& p : plc.vertices) p = factor(random) * p;
  return plc;
}

/// A box of height `height` with a grid on each face.
inline plc::InputPlc gridded_plate(std::uint32_t n, double height) {
  return mapped(gridded_cube(n), [height](const Point3& p) { return Point3{p.x, p.y, height * p.z}; });
}

/// A plate whose vertices are moved by up to a third of its height.
inline plc::InputPlc rough_plate(double height, std::mt19937& random) {
  std::uniform_real_distribution<double> part(-height / 3, height / 3);
  std::map<std::array<double, 3>, Point3> moved;
  return mapped(gridded_plate(2, height), [&](const Point3& p) {
    const auto found = moved.find(as_array(p));
    if (found != moved.end()) return found->second;
    return moved[as_array(p)] = p + Point3{part(random), part(random), part(random)};
  });
}

/// Two cones on one circle, or one cone if a height is 0. Their sides run from the rim to the tips.
inline plc::InputPlc double_cone(int sides, double up, double down) {
  plc::InputPlc plc;
  const auto n = static_cast<std::uint32_t>(sides);
  for (int i = 0; i < sides; ++i)
    plc.vertices.push_back({std::cos(2 * std::acos(-1.0) * i / sides), std::sin(2 * std::acos(-1.0) * i / sides), 0});
  plc.vertices.push_back({0, 0, up});
  plc.vertices.push_back({0, 0, -down});
  for (std::uint32_t i = 0; i < n; ++i) {
    plc.triangles.push_back({i, (i + 1) % n, n});
    plc.triangles.push_back({(i + 1) % n, i, n + 1});
  }
  return plc;
}

}  // namespace ccdt::mesh_test
