#pragma once

#include <functional>
#include <numbers>
#include <span>

#include "models/curves.h"

namespace ccdt::models {

/// How fast the edge length may grow with the distance from a curve that is cut more finely.
inline constexpr double edge_length_growth = 0.4;

/// A point of the half plane that turns around the axis.
struct ProfilePoint {
  double radius = 0;
  double height = 0;
};

/// A smooth piece of the half plane's curve, by arc length from its start.
struct Profile {
  double length = 0;
  std::function<ProfilePoint(double)> at;
};

Profile straight_profile(ProfilePoint from, ProfilePoint to);

/// An arc about `center` between two angles in degrees from the direction away from the axis.
Profile round_profile(ProfilePoint center, double radius, double from, double to);

/// Where a surface of revolution is, how fine it is, and how its triangles are marked.
struct Revolution {
  Axis axis = Axis::z;
  Point3 center;  ///< any point of the axis
  double edge_length = 1;
  int marker = 0;
};

/// The surface of revolution between two rings: rows of nearly equilateral triangles, each row with its own number of
/// vertices as the circumference asks for, so that nothing is stretched and there is no seam.
///
/// The outer side is on the right of the profile's direction from `from` to `to`, with the axis on the left of "up".
/// A profile that runs around the section of a solid counterclockwise (radius to the right, height up) gives its
/// surface.
void add_revolution(ModelSurface& surface, const Ring& from, const Ring& to, const Profile& profile,
                    const Revolution& revolution);

/// The same with a straight profile between the rings.
void add_cone(ModelSurface& surface, const Ring& from, const Ring& to, const Revolution& revolution);

/// Closed surfaces of revolution: rings (at least three, all open to both sides) joined by one row each, the last with
/// the first.
void add_closed_rows(ModelSurface& surface, std::span<const Ring> rings, const Revolution& revolution);

/// A ring inside a surface of revolution, whose vertices are `phase` of an edge ahead of angle 0.
Ring inner_ring(ModelSurface& surface, const Revolution& revolution, ProfilePoint at, double spacing, double phase);

}  // namespace ccdt::models
