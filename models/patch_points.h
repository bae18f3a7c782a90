#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/planar/points.h"

namespace ccdt {

using PatchEdge = std::array<std::uint32_t, 2>;

/// The edges that a patch is to have, over the vertices that they join, in the plane.
struct PatchOutline {
  std::vector<Point2> vertices;
  std::vector<PatchEdge> border;  ///< closed loops that do not cross; inside is what an odd number of them encloses
  std::vector<PatchEdge> cuts;    ///< further edges inside the border
};

/// The edge length wanted at a place of a patch: the target, but near the outline no more than the outline's own edge
/// length and what it may grow with the distance from it.
class PatchSpacing {
 public:
  PatchSpacing(const PatchOutline& outline, double edge_length);

  double operator()(const Point2& point) const;
  double smallest() const { return smallest_; }
  bool is_uniform() const { return fine_.empty(); }

 private:
  struct Source {
    Point2 point;
    double spacing;
  };
  std::vector<Source> fine_;  // the vertices whose edges are clearly shorter than the target
  double edge_length_;
  double smallest_;
};

/// Places points inside the outline layer by layer, from its edges inwards, each where it makes an equilateral triangle
/// with what is there, and none that is too near to another.
std::vector<Point2> place_patch_points(const PatchOutline& outline, const PatchSpacing& spacing);

}  // namespace ccdt
