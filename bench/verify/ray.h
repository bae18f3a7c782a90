#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "bench/verify/surface.h"

namespace ccdt::verification {

/// Where a ray meets a piece of the surface.
struct Hit {
  std::uint32_t piece;
  double along;     ///< 0 at the start of the ray, 1 at its end
  bool from_above;  ///< the ray comes from the side that the piece's normal points to
};

/// Shoots rays at the surface. Which pieces a ray meets is decided by exact signs.
class RayShooter {
 public:
  explicit RayShooter(const Surface& surface);

  /// All pieces that the ray from `start` out of the box meets, in their order along it; nothing if the ray grazes an
  /// edge or two pieces are too close to be put in order. There are as many rays to choose from as one likes.
  std::optional<std::vector<Hit>> shoot(const Point3& start, int attempt) const;

  /// How far a ray that starts at this height rises.
  double length(double z) const { return std::max(high_z_ - z, 0.0) + surface_.tolerances.box; }
  /// Direction of a ray; its z is 1.
  static Point3 direction(int attempt);

 private:
  struct Rectangle {
    double low_x, low_y, high_x, high_y, high_z;
  };
  const Surface& surface_;
  std::vector<Rectangle> rectangles_;  // of each piece
  double high_z_ = 0;
};

}  // namespace ccdt::verification
