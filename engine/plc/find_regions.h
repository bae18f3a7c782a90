#pragma once

#include <cstdint>
#include <vector>

#include "engine/plc/edge_table.h"
#include "engine/plc/find_facets.h"
#include "engine/plc/input.h"
#include "engine/plc/plc.h"
#include "engine/plc/vertical_ray.h"

namespace ccdt {

/// How the triangles divide space.
struct RegionMap {
  std::vector<RegionId>
      of_side;  ///< of each side of each triangle: entry 2t is the side that the normal points to, 2t+1 the other
  std::vector<Region> regions;   ///< number 0 reaches infinity; the others follow in the order of their first side
  std::vector<RegionId> around;  ///< of each region but 0, the one that holds the connected facets that enclose it

  RegionId of(std::uint32_t triangle, bool above) const { return of_side[2 * triangle + (above ? 0 : 1)]; }
};

/// Finds the regions: joins the sides of triangles that see each other through the sectors around each edge, then, as
/// facets that are connected by edges may be nested in others, through rays from one component to the next. No region
/// is marked inside yet.
///
/// \param edges  with the triangles sorted around each edge (`sort_around_edges`)
RegionMap find_regions(const TriangleSet& triangles, std::span<const Point3> vertices, const EdgeTable& edges,
                       const FacetPatches& facets, const VerticalRays& rays);

/// The region of a point that is on no triangle.
RegionId region_at(const RegionMap& map, const VerticalRays& rays, const RayStart& point);

/// Marks what is inside, as the input's kind says, and gives the regions their regions.
///
/// \throw InputError  a seed of a hole or region is outside or on a facet; or nothing is enclosed, or nothing is left
/// by the holes
void mark_inside(const InputPlc& input, const Plc& plc, const TriangleSet& triangles, const EdgeTable& edges,
                 const VerticalRays& rays, RegionMap& map);

}  // namespace ccdt
