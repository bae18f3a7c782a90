#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "engine/geometry/box_tree.h"
#include "engine/plc/close_triangles.h"
#include "engine/plc/edge_table.h"
#include "engine/plc/find_regions.h"
#include "engine/plc/options.h"
#include "engine/plc/plc.h"

namespace ccdt::plc {

/// Splits triangles at the vertices that are on them, exactly.
///
/// \param triangles  different, with an area. Those known to be faces of one simplicial complex are not tested against
///                   each other: they share only corners and edges, and no vertex is on one
/// \return  the pairs that may still have more in common than corners and edges
std::vector<TrianglePair> make_conforming(std::span<const Point3> vertices, TriangleSet& triangles);

/// The pairs that have more in common than vertices and edges.
struct Overlaps {
  std::vector<Overlap> covering;  ///< of triangles on one side of a common edge
  std::vector<Overlap> crossing;  ///< of other triangles
  std::vector<Overlap> of_segments;
};

struct ConnectedParts {
  PlcParts parts;  ///< complete only if nothing overlaps
  Overlaps overlaps;
  std::optional<BoxTree> tree;  ///< over the boxes of the triangles, made only where it pays
};

/// Connects triangles and segments by their edges, and finds facets and everything that overlaps.
///
/// \param triangles, close  as `make_conforming` leaves them
/// \param segments          split at the vertices that are on them
/// \param limit             of each list of overlaps
ConnectedParts connect_parts(const Plc& plc, TriangleSet triangles, SegmentSet segments,
                             std::span<const TrianglePair> close, const PlcOptions& options, std::size_t limit);

}  // namespace ccdt::plc
