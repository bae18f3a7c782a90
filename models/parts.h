#pragma once

#include "engine/plc/input.h"

namespace ccdt::models {

// The solids behind `make_solid`, one source file each. The caller has checked the edge length against the limits of
// the solid.

/// A piston of 80 mm: crown with a bowl, three ring grooves, hollow skirt, bosses and a bore for the pin.
/// Markers: 1 crown, 2 bowl, 3 lands, 4 grooves, 5 skirt, 6 rim, 7 cavity, 8 pin bore, 9 bosses.
plc::InputPlc make_piston(double edge_length);

/// An angle bracket of 80 mm with holes, a gusset, round corners, a slit in its foot and an interior face between its
/// legs. Regions: 1 foot, 2 wall. Markers: 1 foot, 2 wall, 3 bend, 4 ends, 5 sides, 6 holes, 7 gusset; inside: 8
/// interior face, 9 slit.
plc::InputPlc make_bracket(double edge_length);

/// A bicycle's foot peg of 120 mm: threaded stub, hexagon, collar, toothed grip, end cap with a bore.
/// Markers: 1 thread, 2 hexagon, 3 collar, 4 teeth, 5 grooves between them, 6 flanks, 7 cap, 8 bore.
plc::InputPlc make_stepping_pole(double edge_length);

/// The unit cube with a square grid on each face.
plc::InputPlc make_cube(double edge_length);
/// The unit cube with squares on its faces that shrink toward the origin: the longest edge is 181 times the shortest.
/// The edge length is that of the largest squares.
plc::InputPlc make_graded_cube(double edge_length);
/// The unit sphere about the origin: an icosahedron, each face divided, on the sphere.
plc::InputPlc make_sphere(double edge_length);
/// The logarithms of the rough sphere's radii cover a range of this times the edge length. With this value, one face in
/// ten is not Delaunay; with 1, all faces are.
inline constexpr double rough_sphere_range = 3;
/// The sphere with pseudorandom radii, the same each time.
plc::InputPlc make_rough_sphere(double edge_length);
/// Radii 1 and 0.4 about the z axis.
plc::InputPlc make_torus(double edge_length);
/// Schoenhardt's polyhedron (1928): a prism over a triangle with its top turned by 30 degrees, so that its reflex edges
/// keep it from being tetrahedralized without a Steiner vertex. Always the same 6 vertices and 8 triangles.
plc::InputPlc make_schoenhardt(double edge_length);

}  // namespace ccdt::models
