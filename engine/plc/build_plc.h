#pragma once

#include <cstdint>
#include <span>

#include "engine/base/progress.h"
#include "engine/plc/edge_table.h"
#include "engine/plc/input.h"
#include "engine/plc/options.h"
#include "engine/plc/plc.h"

namespace ccdt::plc {

/// The input on the grid, as triangles and segments that may still cross each other.
struct UncheckedPlc {
  Plc plc;                ///< without segments, facets and regions
  TriangleSet triangles;  ///< with an area; their faces are not known
  SegmentSet segments;
};

/// Puts the input on the dyadic grid and merges equal vertices. Facets without area on the grid bound nothing and are
/// left out; their vertices stay.
///
/// \throw InputError  non-finite coordinates, no facets, a polygon that is none; with the place in the units of the
///                    input and a remedy
UncheckedPlc gather_plc(const InputPlc& input, const PlcOptions& options = {}, const Progress& progress = {});

/// Finds facets, segments and regions, and checks that they form a piecewise linear complex.
///
/// \param gathered    from the input with the same options. Triangles that are known to be faces of one simplicial
///                    complex have nothing in common but corners and edges, and no vertex is on one. So they are not
///                    tested with each other.
/// \throw InputError  duplicate facets, facets that cross or cover each other, an open surface, seeds outside; as
///                    `gather_plc`
Plc check_plc(const InputPlc& input, UncheckedPlc gathered, const PlcOptions& options = {},
              const Progress& progress = {});

/// Both.
Plc build_plc(const InputPlc& input, const PlcOptions& options = {}, const Progress& progress = {});

}  // namespace ccdt::plc
