#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/base/index.h"

namespace ccdt {

/// What a planar triangulation asks of the plane that it lives in. Vertices are named by ids; the answers must be exact and consistent.
/// A model of this concept is chosen at compile time, so that nothing is virtual in the inner loops.
template <class P>
concept PlanarPredicates = requires(const P& p, VertexId v) {
  { p.orient(v, v, v) } -> std::convertible_to<int>;       // +1: counterclockwise, 0: collinear, -1: clockwise
  { p.incircle(v, v, v, v) } -> std::convertible_to<int>;  // for counterclockwise abc, +1: d inside the circumcircle; 0 is allowed (a tie)
};

}  // namespace ccdt
