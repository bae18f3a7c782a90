#pragma once

#include <algorithm>
#include <cstdint>
#include <random>
#include <vector>

#include "engine/tests/shared/plc_test_solids.h"

namespace ccdt::plc_test {

/// Merges vertices at the same place.
inline void merge_equal_vertices(plc::InputPlc& plc) {
  for (auto& corners : plc.triangles)
    for (std::uint32_t& v : corners)
      v = static_cast<std::uint32_t>(std::ranges::find(plc.vertices, plc.vertices[v]) - plc.vertices.begin());
}

/// Gives each triangle its own vertices, as in an STL file.
inline void separate_triangles(plc::InputPlc& plc) {
  std::vector<Point3> vertices;
  for (auto& corners : plc.triangles)
    for (std::uint32_t& v : corners) {
      vertices.push_back(plc.vertices[v]);
      v = static_cast<std::uint32_t>(vertices.size() - 1);
    }
  plc.vertices = std::move(vertices);
}

/// A number below n.
inline std::uint32_t draw(std::mt19937_64& random, std::size_t n) {
  return static_cast<std::uint32_t>(random() % n);
}

/// Damages an input in one of the ways in which files are broken.
inline void damage(std::mt19937_64& random, plc::InputPlc& plc) {
  const std::uint32_t t = draw(random, plc.triangles.size()), v = draw(random, plc.vertices.size());
  switch (random() % 8) {
    case 0:
      plc.triangles.erase(plc.triangles.begin() + t);
      break;
    case 1:
      plc.triangles.push_back(plc.triangles[t]);
      break;
    case 2:
      std::swap(plc.triangles[t][0], plc.triangles[t][1]);
      break;
    case 3:
      plc.triangles[t][0] = v;
      break;
    case 4:
      plc.vertices[v] = plc.vertices[draw(random, plc.vertices.size())];
      break;
    case 5:
      plc.vertices[v].x += 0.125 * draw(random, 9) - 0.5;
      break;
    case 6:
      plc.vertices.push_back(plc.vertices[v]);
      plc.triangles[t][1] = static_cast<std::uint32_t>(plc.vertices.size() - 1);
      break;
    default:
      separate_triangles(plc);
      break;
  }
}

/// A solid or two, damaged up to three times.
inline plc::InputPlc damaged_solid(std::mt19937_64& random) {
  plc::InputPlc plc = random() % 2 == 0   ? gridded_cube(1 + draw(random, 3))
                      : random() % 2 == 0 ? l_shape()
                                          : schoenhardt();
  merge_equal_vertices(plc);
  if (random() % 4 == 0) {
    const double low = 0.25 * draw(random, 9), high = low + 0.25 * (1 + draw(random, 4));
    append(plc, box({low, low, low}, {high, high, high}));
  }
  for (std::uint64_t i = random() % 4; i > 0; --i) damage(random, plc);
  return plc;
}

}  // namespace ccdt::plc_test
