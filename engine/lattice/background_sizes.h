#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/numbers/point.h"

namespace ccdt {

/// Target edge lengths that are given at the vertices of a background: a tetrahedral mesh, or vertices alone. Empty:
/// there is none.
struct BackgroundSizes {
  std::string name;       ///< path as the user gave it
  std::string mesh_name;  ///< of the file that the vertices come from
  std::vector<Point3> vertices;
  std::vector<std::array<std::uint32_t, 4>> tetrahedra;  ///< may be empty; any orientation
  std::vector<double> sizes;                             ///< of each vertex, > 0

  bool empty() const { return vertices.empty(); }
};

}  // namespace ccdt
