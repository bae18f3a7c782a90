#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/base/enum_names.h"
#include "engine/base/errors.h"

namespace ccdt::repair {

/// What can be wrong with an input.
enum class FaultKind : std::uint8_t {
  coordinates,
  extent,
  no_facets,
  polygons,
  duplicate_facets,
  covering_facets,
  crossing_facets,
  crossing_segments,
  open_edges,
  domain,
  unusual_file,
  idle_holes,
  facets_without_area,
  equal_vertices,
  unused_vertices,
  split_facets,
  warped_facets,
  turned_edges,
  shared_edges,
  inward_facets
};

constexpr auto names_of(FaultKind) {
  using enum FaultKind;
  return std::to_array<NamedValue<FaultKind>>(
      {{coordinates, "coordinates", "vertices with a coordinate that is not a finite number"},
       {extent, "extent", "the input is too large or too small for computations with numbers of double precision"},
       {no_facets, "no-facets", "the input has no facet with an area"},
       {polygons, "polygons", "facets that are not polygons in one plane"},
       {duplicate_facets, "duplicate-facets", "facets with the same corners as another one"},
       {covering_facets, "covering-facets", "pairs of facets in one plane that cover each other"},
       {crossing_facets, "crossing-facets", "pairs of facets that cross each other"},
       {crossing_segments, "crossing-segments", "segments that cross a facet or another segment"},
       {open_edges, "open-edges", "loops or chains of edges that have only one facet"},
       {domain, "domain", "the facets enclose nothing, or a seed is misplaced"},
       {unusual_file, "unusual-file", "the file is not quite in its format"},
       {idle_holes, "idle-holes", "seeds of holes where nothing is enclosed, which are not used"},
       {facets_without_area, "facets-without-area", "facets without area, which are left out"},
       {equal_vertices, "equal-vertices", "vertices at the place of another one, which are merged"},
       {unused_vertices, "unused-vertices", "vertices without a facet or segment"},
       {split_facets, "split-facets", "facets with a vertex inside or on an edge, which are split there"},
       {warped_facets, "bent-facets", "polygons that are not planar, which are triangulated"},
       {turned_edges, "turned-edges", "edges whose two facets have opposite orientations"},
       {shared_edges, "shared-edges", "edges with more than two facets"},
       {inward_facets, "inward-facets", "facets whose normal points into the domain"}});
}

/// All faults of one kind in an input.
struct Fault {
  FaultKind kind;
  bool is_error = false;           ///< the input cannot be meshed; otherwise it can, but may be wrong
  std::uint64_t count = 0;         ///< how many there are
  bool at_least = false;           ///< there may be more
  std::string detail = {};         ///< more about them; may be empty
  std::vector<Place> places = {};  ///< of the first ones: points in the units of the input, numbers of facets
};

/// What an input is, and what is wrong with it.
struct Diagnosis {
  std::uint64_t vertices = 0, facets = 0, segments = 0;  ///< as in the file
  std::vector<Fault> faults = {};                        ///< errors first
  // Of a valid input:
  std::uint64_t regions = 0;  ///< parts that facets divide the domain into
  double volume = 0;          ///< of the domain

  /// Can it be meshed?
  bool is_valid() const {
    return std::ranges::none_of(faults, [](const Fault& fault) { return fault.is_error; });
  }
};

}  // namespace ccdt::repair
