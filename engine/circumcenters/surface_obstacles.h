#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "engine/base/box.h"
#include "engine/base/raw_vector.h"
#include "engine/geometry/box_tree.h"
#include "engine/lattice/domain_surface.h"

namespace ccdt::circumcenters {

/// Finds out whether a point is too near to the surface. The rule is that of the sites of a lattice, see
/// `lattice::find_clear_sites`, for one point at a time.
class SurfaceObstacles {
 public:
  /// \param surface        in grid units
  /// \param sphere_factor  of the radii of the smallest balls of triangles and subsegments
  SurfaceObstacles(const lattice::DomainSurface& surface, double sphere_factor);

  /// Is a point in the smallest ball of a triangle or a subsegment, or not farther than this from a triangle, a
  /// subsegment or a vertex?
  bool reach(const Point3& p, double clearance) const;

  std::size_t bytes() const { return bytes_of(obstacles_) + tree_.bytes(); }

 private:
  /// A triangle, or a subsegment or a vertex as a degenerate one.
  struct Obstacle {
    lattice::TrianglePoints corners;
    Point3 ball_center;
    double squared_ball_radius;
    bool needs_clearance;  ///< not if triangles at the obstacle take care of that
  };

  static RawVector<Obstacle> list(const lattice::DomainSurface& surface, double sphere_factor);
  static RawVector<Box> boxes_of(const RawVector<Obstacle>& obstacles);

  RawVector<Obstacle> obstacles_;
  BoxTree tree_;  ///< of each obstacle with its ball
};

}  // namespace ccdt::circumcenters
