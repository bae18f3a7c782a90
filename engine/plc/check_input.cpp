#include "engine/plc/check_input.h"

#include <algorithm>
#include <string>

#include "engine/base/check_arguments.h"
#include "engine/base/errors.h"

namespace ccdt::plc {

void check_input(const InputPlc& input) {
  const auto require = [&](bool holds, const std::string& what, const std::string& remedy) {
    if (!holds) throw InputError(what, {.file = input.name}, remedy);
  };
  const std::string in_range = "count the vertices from 0";
  const std::size_t count = input.vertices.size();
  require(are_below(count, input.triangles), "a triangle has a corner that is not a vertex", in_range);
  require(are_below(count, input.segments), "a segment has an end that is not a vertex", in_range);
  const std::string complete = "give none, or one for each";
  require(is_empty_or_complete(input.triangle_markers, input.triangles), "some triangles have no marker", complete);
  require(is_empty_or_complete(input.triangle_numbers, input.triangles), "some triangles have no number", complete);
  require(is_empty_or_complete(input.segment_markers, input.segments), "some segments have no marker", complete);
  const std::string finite = "give finite coordinates";
  for (const PolygonFacet& facet : input.polygon_facets) {
    require(are_below(count, facet.polygons), "a polygon has a corner that is not a vertex", in_range);
    require(std::ranges::all_of(facet.holes, is_finite), "the seed of a hole in a facet is not finite", finite);
  }
  require(std::ranges::all_of(input.holes, is_finite), "the seed of a hole is not finite", finite);
  require(std::ranges::all_of(input.regions, is_finite, &InputPlc::RegionSeed::seed),
          "the seed of a region is not finite", finite);
}

}  // namespace ccdt::plc
