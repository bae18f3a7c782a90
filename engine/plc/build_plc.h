#pragma once

#include <cstdint>
#include <span>

#include "engine/base/progress.h"
#include "engine/plc/connect_parts.h"
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
/// \throw InputError  non-finite coordinates, no facets, an invalid polygon; with the place in the units of the input
///                    and a remedy
UncheckedPlc gather_plc(const InputPlc& input, const PlcOptions& options = {}, const Progress& progress = {});

/// Is told what an examination finds, in the order in which building a PLC would stop. To stop, throw.
class Examiner {
 public:
  virtual ~Examiner() = default;
  /// \param pairs  triangles with the same corners: the first one, which stays, and another one, which is removed
  virtual void see_duplicates(const UncheckedPlc& parts, std::span<const TrianglePair> pairs) = 0;
  virtual void see_whole(const UncheckedPlc& /*before anything is split*/) {}
  virtual void see_conforming(const UncheckedPlc& /*split at the vertices that are on them*/) {}
  virtual void see_overlaps(const Plc& plc, const ConnectedParts& connected) = 0;
};

/// What was examined; only the regions are missing.
struct Examined {
  Plc plc;  ///< as in `UncheckedPlc`
  ConnectedParts connected;
};

/// The one examination of an input: are its triangles distinct, and does nothing overlap?
///
/// \param parts     Triangles known to be faces of one simplicial complex share only corners and edges, and no vertex
///                  is on one. So they are not tested against each other.
/// \param limit     of each list of overlaps
Examined examine_parts(UncheckedPlc parts, const PlcOptions& options, std::size_t limit, Examiner& examiner);

/// Finds the regions of parts that do not overlap.
///
/// \throw InputError  an open surface, seeds outside
Plc finish_plc(const InputPlc& input, Examined examined);

/// The PLC of triangles that are known to be distinct and to share only corners and edges.
///
/// \throw InputError  facets cover each other within the tolerance; or as in `finish_plc`
Plc assemble_plc(const InputPlc& input, UncheckedPlc parts, const PlcOptions& options);

/// Finds facets, segments and regions, and checks that they form a piecewise linear complex.
///
/// \param gathered    from the input with the same options; see `examine_parts`
/// \throw InputError  duplicate facets, facets that cross or cover each other, an open surface, seeds outside, opposite
///                    sides that differ; or as in `gather_plc`
Plc check_plc(const InputPlc& input, UncheckedPlc gathered, const PlcOptions& options = {},
              const Progress& progress = {});

/// Both `gather_plc` and `check_plc`.
Plc build_plc(const InputPlc& input, const PlcOptions& options = {}, const Progress& progress = {});

}  // namespace ccdt::plc
