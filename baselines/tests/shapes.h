#pragma once

#include <array>
#include <cstdint>

#include "engine/mesh/tet_mesh.h"
#include "engine/plc/input.h"

namespace ccdt::shapes {

/// A cube from `low` to `high` with twelve triangles, appended to a PLC.
inline void add_cube(plc::InputPlc& plc, double low, double high) {
  const auto first = static_cast<std::uint32_t>(plc.vertices.size());
  for (int i = 0; i < 8; ++i) plc.vertices.push_back({i & 1 ? high : low, i & 2 ? high : low, i & 4 ? high : low});
  constexpr std::array<std::array<std::uint32_t, 3>, 12> triangles = {{{0, 2, 1},
                                                                       {1, 2, 3},
                                                                       {4, 5, 6},
                                                                       {5, 7, 6},
                                                                       {0, 1, 4},
                                                                       {1, 5, 4},
                                                                       {2, 6, 3},
                                                                       {3, 6, 7},
                                                                       {0, 4, 2},
                                                                       {2, 4, 6},
                                                                       {1, 3, 5},
                                                                       {3, 7, 5}}};
  for (auto triangle : triangles) {
    for (auto& v : triangle) v += first;
    plc.triangles.push_back(triangle);
  }
}

inline plc::InputPlc cube() {
  plc::InputPlc plc;
  plc.name = "cube";
  add_cube(plc, 0, 1);
  return plc;
}

/// A cube of six tetrahedra.
inline mesh::TetMesh cube_mesh() {
  mesh::TetMesh mesh;
  mesh.vertices = cube().vertices;
  mesh.tetrahedra = {{0, 1, 3, 7}, {0, 3, 2, 7}, {0, 2, 6, 7}, {0, 6, 4, 7}, {0, 4, 5, 7}, {0, 5, 1, 7}};
  mesh.regions.assign(6, 0);
  return mesh;
}

/// A cube of side 3 around a cubic hole of side 1: volume 26.
inline plc::InputPlc cube_with_hole() {
  plc::InputPlc plc;
  plc.name = "cube with a hole";
  add_cube(plc, 0, 3);
  add_cube(plc, 1, 2);
  return plc;
}

/// A unit cube whose faces are grids of n x n squares, each face with its own vertices.
inline plc::InputPlc cube_with_grid(std::uint32_t n) {
  plc::InputPlc plc;
  plc.name = "cube with a grid";
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const bool high : {false, true}) {
      const auto first = static_cast<std::uint32_t>(plc.vertices.size());
      for (std::uint32_t i = 0; i <= n; ++i)
        for (std::uint32_t j = 0; j <= n; ++j) {
          std::array<double, 3> p{};
          p[axis] = high ? 1 : 0;
          p[(axis + 1) % 3] = static_cast<double>(i) / n;
          p[(axis + 2) % 3] = static_cast<double>(j) / n;
          plc.vertices.push_back({p[0], p[1], p[2]});
        }
      for (std::uint32_t i = 0; i < n; ++i)
        for (std::uint32_t j = 0; j < n; ++j) {
          const std::uint32_t a = first + i * (n + 1) + j, b = a + n + 1;
          plc.triangles.push_back(high ? std::array{a, b, b + 1} : std::array{a, b + 1, b});
          plc.triangles.push_back(high ? std::array{a, b + 1, a + 1} : std::array{a, a + 1, b + 1});
        }
    }
  return plc;
}

/// Every triangle has its own vertices, as in an STL file.
inline plc::InputPlc with_repeated_vertices(const plc::InputPlc& plc) {
  plc::InputPlc repeated;
  repeated.name = plc.name;
  for (const auto& triangle : plc.triangles) {
    const auto v = static_cast<std::uint32_t>(repeated.vertices.size());
    for (const auto corner : triangle) repeated.vertices.push_back(plc.vertices[corner]);
    repeated.triangles.push_back({v, v + 1, v + 2});
  }
  return repeated;
}

}  // namespace ccdt::shapes
