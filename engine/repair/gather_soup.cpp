#include "engine/repair/gather_soup.h"

#include <algorithm>
#include <utility>

#include "engine/plc/warped_facets.h"

namespace ccdt::repair {
namespace {

/// The facets that have no triangle left. Those with one or two vertices never have any.
std::vector<std::uint32_t> find_facets_without_area(const plc::InputPlc& input, const plc::TriangleSet& triangles) {
  std::vector<std::uint32_t> expected;
  for (std::uint32_t t = 0; t < input.triangles.size(); ++t)
    expected.push_back(input.triangle_numbers.empty() ? t : input.triangle_numbers[t]);
  for (const plc::PolygonFacet& facet : input.polygon_facets)
    if (std::ranges::any_of(facet.polygons, [](const auto& polygon) { return polygon.size() > 2; }))
      expected.push_back(facet.number);
  std::ranges::sort(expected);
  expected.erase(std::ranges::unique(expected).begin(), expected.end());
  std::vector<std::uint32_t> there = triangles.numbers;
  std::ranges::sort(there);
  std::vector<std::uint32_t> missing;
  std::ranges::set_difference(expected, there, std::back_inserter(missing));
  return missing;
}

}  // namespace

Soup gather_soup(const plc::InputPlc& given, const plc::PlcOptions& options) {
  Soup soup;
  soup.input = given;
  while (true) {
    try {
      if (auto triangulated = plc::triangulate_warped_facets(soup.input)) soup.input = std::move(*triangulated);
      soup.parts = plc::gather_plc(soup.input, options);
      soup.without_area = find_facets_without_area(soup.input, soup.parts.triangles);
      return soup;
    } catch (const InputError& error) {
      // The error names the polygon, which is left out in the next attempt.
      if (error.place().facets.size() != 1) throw;
      const auto is_named = [&](const plc::PolygonFacet& facet) { return facet.number == error.place().facets[0]; };
      if (std::erase_if(soup.input.polygon_facets, is_named) == 0) throw;
      soup.invalid_polygons.push_back({.points = error.place().points, .facets = error.place().facets});
    }
  }
}

}  // namespace ccdt::repair
