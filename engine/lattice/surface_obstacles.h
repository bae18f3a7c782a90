#pragma once

#include <array>
#include <cstddef>

#include "engine/base/box.h"
#include "engine/base/index.h"
#include "engine/base/raw_vector.h"
#include "engine/geometry/box_tree.h"
#include "engine/lattice/domain_surface.h"

namespace ccdt::lattice {

/// A triangle of a surface that interior points keep away from; subsegments and vertices count as degenerate triangles.
struct Obstacle {
  std::array<VertexId, 3> vertices;
  bool needs_clearance;        ///< false if triangles at the obstacle take care of that
  Ball ball;                   ///< no point may be in this ball
  double squared_ball_radius;  ///< less than 0 if there is none
};

/// \param sphere_factor  of the radii of the smallest balls of triangles and subsegments; 0: no balls
RawVector<Obstacle> list_obstacles(const DomainSurface& surface, double sphere_factor);

/// Finds out whether a point is too near the surface, one point at a time. The rule is the one for the sites of a
/// lattice, see `find_clear_sites`.
class SurfaceObstacles {
 public:
  /// \param surface  in grid units; must outlive this
  SurfaceObstacles(const DomainSurface& surface, double sphere_factor);

  /// Is a point in the ball of an obstacle, or at most this far from an obstacle?
  bool reach(const Point3& p, double clearance) const;

  std::size_t bytes() const { return bytes_of(obstacles_) + tree_.bytes(); }

 private:
  const DomainSurface& surface_;
  RawVector<Obstacle> obstacles_;
  BoxTree tree_;  ///< of each obstacle with its ball
};

}  // namespace ccdt::lattice
