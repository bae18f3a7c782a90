#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/base/point.h"

namespace ccdt::sizes {

/// Target edge lengths given at the vertices of a background: a tetrahedral mesh, or vertices alone. Empty if there is
/// no background.
struct BackgroundSizes {
  std::string name;       ///< path as the user gave it
  std::string mesh_name;  ///< path of the file that the vertices come from
  std::vector<Point3> vertices;
  std::vector<std::array<std::uint32_t, 4>> tetrahedra;  ///< may be empty; any orientation
  std::vector<double> sizes;                             ///< of each vertex, > 0

  bool empty() const { return vertices.empty(); }
};

}  // namespace ccdt::sizes
