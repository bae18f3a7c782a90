#pragma once

#include "engine/base/point.h"
#include "engine/plc/input.h"
#include "engine/plc/plc.h"

namespace ccdt::bench {

/// The length of the longest edge over that of the shortest; 1 if there is none.
double edge_ratio(const plc::InputPlc& plc);

/// An angle in degrees and a corner at which it is.
struct SurfaceAngle {
  double degrees = 180;
  Point3 at = {};
};

/// The smallest angles of a surface, which limit those of the tetrahedra.
struct SurfaceAngles {
  SurfaceAngle planar;    ///< of its triangles
  SurfaceAngle dihedral;  ///< between two triangles at an edge, on the side of the domain
};

SurfaceAngles smallest_angles(const plc::Plc& plc);

/// The volume of all that is inside, in the units of the input cubed.
double enclosed_volume(const plc::Plc& plc);

/// Are the triangles of a surface good enough to be kept? All their angles have 25 degrees or more, nine tenths of the
/// edges differ by a factor of less than 2, and the median edge is within a quarter of the wanted length.
bool has_even_triangles(const plc::Plc& plc, double edge_length);

/// The angle that two segments enclose where they meet, in degrees: the smallest; 180 if none meet.
double smallest_segment_angle(const plc::Plc& plc);

}  // namespace ccdt::bench
