#include "engine/repair/remove_walls.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>

namespace ccdt::repair {
namespace {

/// A triangle that bounds a region, and the side that the region is on.
struct Window {
  plc::VertexTriple corners;
  double area = 0;
  bool above = false;
};

/// The largest triangle of each region, because the winding number near it is the most reliable.
std::vector<Window> find_windows(const plc::Plc& plc) {
  std::vector<Window> windows(plc.regions.size());
  for (const plc::Facet& facet : plc.facets)
    for (const auto& t : plc.triangles_of(facet)) {
      const double area = length(area_vector(plc::points_of(plc.vertices, t)));
      for (const bool above : {true, false}) {
        Window& window = windows[above ? facet.above : facet.below];
        if (area > window.area) window = {t, area, above};
      }
    }
  return windows;
}

/// A point of the region: off the middle of the triangle by a tiny part of its size.
Point3 look_through(const plc::Plc& plc, const Window& window) {
  const auto [a, b, c] = plc::points_of(plc.vertices, window.corners);
  constexpr double step = 1e-6;
  const Point3 normal = normalized(area_vector({a, b, c}));
  return (1.0 / 3) * (a + b + c) + (window.above ? 1 : -1) * step * std::sqrt(window.area) * normal;
}

/// How often the surface goes around each region.
std::vector<long> wind(const plc::Plc& plc, const OrientedSurface& given) {
  std::vector<long> numbers;
  for (const Window& window : find_windows(plc))
    numbers.push_back(window.area == 0 ? 0 : std::lround(winding_number(look_through(plc, window), given)));
  return numbers;
}

}  // namespace

std::size_t remove_walls(plc::UncheckedPlc& soup, const OrientedSurface& given, const plc::InputPlc& input,
                         const plc::PlcOptions& options) {
  const plc::Plc plc = plc::assemble_plc(input, soup, options);
  const std::vector<long> times = wind(plc, given);
  plc::TriangleSet kept;
  std::size_t removed = 0;
  for (const plc::Facet& facet : plc.facets) {
    const bool is_inner = plc.regions[facet.above].inside && plc.regions[facet.below].inside;
    const long above = times[facet.above], below = times[facet.below];
    // Two solids that touch, with nothing else there, stay apart.
    const bool is_between_two = above == below && std::abs(above) == 1;
    if (is_inner && above != 0 && below != 0 && !is_between_two) {
      removed += facet.triangle_count;
      continue;
    }
    for (const auto& t : plc.triangles_of(facet)) kept.add(t, facet.marker, facet.number);
  }
  soup.triangles = std::move(kept);
  return removed;
}

}  // namespace ccdt::repair
