#pragma once

#include "engine/base/point.h"
#include "engine/base/portable_math.h"

namespace ccdt::surface {

/// Says which edges between two facets are sharp: those where the normals differ by more than an angle.
class SharpAngle {
 public:
  /// \param degrees  see RemeshOptions; an edge of just this angle is not sharp
  explicit SharpAngle(double degrees) : cosine_(portable::cosine(to_radians(degrees + 1e-6))) {}

  /// \param normals         of length one
  /// \param oriented_alike  do both facets run along the edge in opposite directions?
  bool is_exceeded(const Point3& first_normal, const Point3& second_normal, bool oriented_alike) const {
    const double cosine = dot(first_normal, second_normal);
    return (oriented_alike ? cosine : -cosine) < cosine_;
  }

 private:
  double cosine_;
};

}  // namespace ccdt::surface
