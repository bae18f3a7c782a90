#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "engine/plc/edge_table.h"
#include "engine/plc/plc.h"
#include "engine/plc/triangle_set.h"

namespace ccdt {

/// Refuses facets of no area and facets that are there twice. The vertices may be equal after rounding only.
/// \throw InputError
void refuse_degenerate_triangles(const Plc& plc, const TriangleSet& triangles);
/// \throw InputError
void refuse_duplicate_triangles(const Plc& plc, const TriangleSet& triangles);

/// Two things that meet in more than common vertices and edges, and a point of that in grid units.
struct Overlap {
  enum class Between { facets, covering_facets, facet_and_segment, segments };
  Between between;
  std::uint32_t first, second;  ///< triangles or segments, as `between` says
  Point3 where;
};

/// \param pairs     not empty; the one of the smallest facet numbers is told
/// \param at_least  there may be more than `pairs` holds
/// \throw InputError  always
[[noreturn]] void refuse_overlaps(const Plc& plc, const TriangleSet& triangles, const SegmentSet& segments,
                                  std::span<const Overlap> pairs, bool at_least);

/// The loops of edges that have only one triangle.
/// \throw InputError  always; to be called if there is such an edge
[[noreturn]] void refuse_open_surface(const Plc& plc, const EdgeTable& edges);

}  // namespace ccdt
