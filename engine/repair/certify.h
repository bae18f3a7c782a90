#pragma once

#include <span>
#include <vector>

#include "engine/base/point.h"
#include "engine/geometry/surface_distance.h"
#include "engine/plc/build_plc.h"
#include "engine/repair/certificate.h"

namespace ccdt::repair {

using Corners = TrianglePoints;

/// What fills a hole.
struct Lid {
  std::vector<Corners> triangles;  ///< in grid units
  double reach = 0;                ///< the largest distance of its points from the rim; an upper bound; see `reach_of`
};

/// How far points of a lid are from its rim.
///
/// \param lid  not empty
/// \param rim  the vertices around the hole
/// \return  an upper bound of the largest distance, usually at most a tenth too large
double reach_of(std::span<const Corners> lid, std::span<const Point3> rim);

/// Compares a repaired surface with the given one. Each triangle is bounded as a whole (`NearestTriangle`). The pieces
/// of a given triangle cover it, so the bound holds in both directions.
///
/// \param given  before anything was done
Certificate certify(const plc::UncheckedPlc& given, const plc::UncheckedPlc& repaired, std::span<const Lid> lids);

}  // namespace ccdt::repair
