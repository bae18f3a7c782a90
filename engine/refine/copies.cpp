#include "engine/refine/copies.h"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

#include "engine/plc/period.h"

namespace ccdt::refine {
namespace {

/// From a facet on a side of the box to the opposite side.
Point3 shift_of(const plc::Plc& plc, const plc::Period& period, FacetId facet) {
  const auto& [a, b, c] = plc.triangles_of(plc.facets[facet])[0];
  const std::array<Point3, 3> corners = {plc.vertices[a], plc.vertices[b], plc.vertices[c]};
  const auto axis = static_cast<std::size_t>(std::countr_zero(period.sides_of(corners)));
  const bool is_low = as_array(corners[0])[axis] == as_array(period.box.low)[axis];
  return (is_low ? 1.0 : -1.0) * period.extent_along(axis);
}

}  // namespace

Copies::Copies(const plc::Plc& plc) : repeats_(plc::find_repeats(plc)) {
  if (plc.periodicity == plc::Periodicity::none) return;
  lists_.assign(plc.segments.size(), none);
  for (std::uint32_t i = 0; i < repeats_.segments.size(); ++i)
    for (const plc::RepeatedSegment& copy : repeats_.segments[i]) lists_[copy.segment] = i;
  facets_.resize(plc.facets.size());
  is_copy_.resize(plc.facets.size(), false);
  const plc::Period period = plc::period_of(plc.vertices, plc.periodicity);
  for (const auto& [facet, copy] : repeats_.facets) {
    facets_[facet] = {copy, shift_of(plc, period, facet)};
    is_copy_[copy] = true;
  }
}

bool Copies::is_turned(std::uint32_t segment) const {
  return std::ranges::find(repeats_.segments[lists_[segment]], segment, &plc::RepeatedSegment::segment)->turned;
}

void Copies::make_equal(std::vector<LeastDistances>& distances) const {
  for (const std::vector<plc::RepeatedSegment>& list : repeats_.segments) {
    LeastDistances greatest = {};
    const auto of = [&](const plc::RepeatedSegment& copy, std::size_t end) -> double& {
      return distances[copy.segment][copy.turned ? 1 - end : end];
    };
    for (std::size_t end = 0; end < 2; ++end) {
      for (const plc::RepeatedSegment& copy : list) greatest[end] = std::max(greatest[end], of(copy, end));
      for (const plc::RepeatedSegment& copy : list) of(copy, end) = greatest[end];
    }
  }
}

}  // namespace ccdt::refine
