#pragma once

#include <cstdint>
#include <vector>

#include "engine/geometry/surface_distance.h"
#include "engine/plc/input.h"

namespace ccdt::plc {

/// All facets as triangles, in the units of the input.
struct FacetTriangles {
  std::vector<TrianglePoints> corners;
  std::vector<std::uint32_t> numbers;  ///< of their facets in the file
};

/// \param input  its polygons are planar (`triangulate_warped_facets`)
/// \throw InputError  a polygon is invalid
FacetTriangles facet_triangles(const InputPlc& input);

}  // namespace ccdt::plc
