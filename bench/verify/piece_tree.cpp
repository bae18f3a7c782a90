#include "bench/verify/piece_tree.h"

#include <algorithm>
#include <cmath>

namespace ccdt::verify {

namespace {

double squared_distance(const Point3& p, const Point3& a, const Point3& b) {
  const double along = std::clamp(dot(p - a, b - a) / squared_length(b - a), 0.0, 1.0);
  return squared_length(p - a - along * (b - a));
}

}  // namespace

PointOnPiece locate_on_piece(const Surface& surface, std::uint32_t piece, const Point3& p) {
  const Point3& area = surface.area_vector[piece];
  const double size = length(area), tolerance = surface.tolerances.place;
  const double height = dot(area, p - surface.origin(piece)) / size;
  if (std::fabs(height) > surface.tolerances.touch) return PointOnPiece::off;
  for (const auto& [a, b] : surface.edges_of(piece))
    if (squared_distance(p, surface.at(a), surface.at(b)) <= tolerance * tolerance) return PointOnPiece::border;
  // Its foot, as the drawing is seen along an axis, not along the normal.
  const Point3 foot = p - (height / size) * area;
  return encloses(area, surface.edges_of(piece), surface.sites.position, foot) ? PointOnPiece::within
                                                                               : PointOnPiece::off;
}

}  // namespace ccdt::verify
