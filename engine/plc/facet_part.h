#pragma once

#include <array>
#include <cmath>

#include "engine/base/box.h"
#include "engine/base/point.h"

namespace ccdt::plc {

/// A face of a facet that is flat only within the tolerance, in grid units.
struct FacetPart {
  std::array<Point3, 3> corners;
  Point3 normal;  ///< of the facet, of any length
};

/// May two parts belong to the same facet, before and after it was divided? The two sides of a plate have opposite
/// normals.
inline bool have_close_normals(const FacetPart& one, const FacetPart& other) {
  constexpr double least_cosine = 0.99;
  return dot(one.normal, other.normal) >
         least_cosine * std::sqrt(squared_length(one.normal) * squared_length(other.normal));
}

}  // namespace ccdt::plc
