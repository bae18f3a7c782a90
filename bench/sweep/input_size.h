#pragma once

#include <utility>

#include "bench/sweep/expand.h"

namespace ccdt::sweep {

/// The size of a shape before it is meshed.
struct ShapeSize {
  double volume = 0;     ///< enclosed
  double area = 0;       ///< of all facets
  double triangles = 0;  ///< of the surface
};

/// The size of a file, or of a model with the triangles of the case. Each shape is read once. None if it cannot be
/// read.
ShapeSize size_of(const CaseInput& input);

/// The approximate number of tetrahedra that fill a shape.
///
/// \param options  of the case: lattice, edge-length and surface matter
double estimated_tetrahedra(const ShapeSize& size, const std::vector<std::pair<std::string, std::string>>& options);

}  // namespace ccdt::sweep
