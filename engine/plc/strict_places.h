#pragma once

#include <array>
#include <span>
#include <vector>

#include "engine/base/index.h"
#include "engine/base/point.h"
#include "engine/plc/facet_part.h"

namespace ccdt::plc {

/// Which share of the tolerance the triangles there have.
struct StrictPlace {
  FacetPart part;
  double share;
};

/// How much flatter than usual facets must be. Flatter facets are smaller: they have more segments, and these more
/// Steiner vertices.
struct Strictness {
  double share = 1;  ///< of the tolerance, everywhere
  std::vector<StrictPlace> places;
};

/// \param tolerance  in grid units
/// \return  the tolerance of each triangle, in grid units
std::vector<double> tolerances_of(std::span<const Point3> vertices, std::span<const std::array<VertexId, 3>> triangles,
                                  const Strictness& strictness, double tolerance);

/// Makes facets flatter in some parts; if one of these is exactly flat already, everywhere.
///
/// \param parts  none: the place is not known
/// \return  false if all facets are exactly flat already
bool tighten(std::span<const FacetPart> parts, Strictness& strictness);

}  // namespace ccdt::plc
