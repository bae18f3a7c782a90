#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "engine/geometry/box_tree.h"
#include "engine/plc/edge_table.h"
#include "engine/plc/find_facets.h"
#include "engine/plc/input.h"
#include "engine/plc/plc.h"

namespace ccdt::plc {

/// The input as conforming triangles and segments, with derived data.
struct PlcParts {
  TriangleSet triangles;
  SegmentSet segments;
  EdgeTable edges;  ///< with the triangles sorted around each edge (`sort_around_edges`)
  SegmentMatch match;
  FacetPatches patches;
};

/// The regions that the triangles divide space into.
struct RegionMap {
  /// Of each `side_of` a triangle.
  std::vector<RegionId> of_side;
  std::vector<Region> regions;  ///< region 0 reaches infinity; the others follow in the order of their first side
  /// For each region except 0, the region that contains the connected facets enclosing it.
  std::vector<RegionId> around;
  std::vector<RegionId> of_loose;  ///< of each of `PlcParts::match.loose`: where the middle of the segment is
  std::vector<Point3> idle_holes;  ///< see `Plc`

  RegionId of(std::uint32_t triangle, bool above) const { return of_side[side_of(triangle, above)]; }
};

/// Finds the regions. First joins the sides of triangles that see each other through the sectors around each edge.
/// Then, since a connected component of facets may be nested in others, joins sides by rays from one component to the
/// next. Marks what is inside, according to the input's kind, and gives the regions the attributes of their seeds, or
/// numbers from 1.
///
/// \param tree  over the boxes of the triangles; made if it is missing and would be used often
/// \throw InputError  a seed of a region is outside, or a seed is on a facet; or nothing is enclosed, or nothing is
/// left
///                    by the holes
RegionMap find_regions(const InputPlc& input, const Plc& plc, const PlcParts& parts, std::optional<BoxTree>& tree);

}  // namespace ccdt::plc
