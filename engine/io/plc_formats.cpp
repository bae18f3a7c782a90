#include "engine/io/plc_formats.h"

#include <algorithm>
#include <numeric>

#include "engine/base/errors.h"

namespace ccdt::io {

void add_facet(InputPlc& plc, std::span<const std::uint32_t> corners, int marker, std::uint32_t number) {
  if (corners.size() == 3) {
    plc.triangles.push_back({corners[0], corners[1], corners[2]});
    plc.triangle_markers.push_back(marker);
    plc.triangle_numbers.push_back(number);
  } else if (corners.size() > 3) {
    plc.polygon_facets.push_back({{{corners.begin(), corners.end()}}, {}, marker, number});
  } else if (corners.size() == 2) {
    plc.segments.push_back({corners[0], corners[1]});
    plc.segment_markers.push_back(marker);
  }
}

void finish_facets(InputPlc& plc) {
  const auto all_zero = [](const std::vector<int>& markers) {
    return std::all_of(markers.begin(), markers.end(), [](int m) { return m == 0; });
  };
  if (all_zero(plc.triangle_markers)) plc.triangle_markers.clear();
  if (all_zero(plc.segment_markers)) plc.segment_markers.clear();
  bool trivial = true;
  for (std::size_t i = 0; trivial && i < plc.triangle_numbers.size(); ++i) trivial = plc.triangle_numbers[i] == i;
  if (trivial) plc.triangle_numbers.clear();
}

std::vector<FacetLoop> facets_in_order(const InputPlc& plc) {
  std::vector<FacetLoop> loops;
  std::vector<std::uint32_t> numbers;
  for (std::size_t i = 0; i < plc.triangles.size(); ++i) {
    loops.push_back({plc.triangles[i], plc.triangle_markers.empty() ? 0 : plc.triangle_markers[i], nullptr});
    numbers.push_back(plc.triangle_numbers.empty() ? static_cast<std::uint32_t>(i) : plc.triangle_numbers[i]);
  }
  if (plc.polygon_facets.empty() && plc.triangle_numbers.empty()) return loops;
  for (const PolygonFacet& facet : plc.polygon_facets) {
    const bool none = facet.polygons.empty();
    loops.push_back({none ? std::span<const std::uint32_t>() : facet.polygons[0], facet.marker, &facet});
    numbers.push_back(facet.number);
  }
  std::vector<std::size_t> order(loops.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return numbers[a] < numbers[b]; });
  std::vector<FacetLoop> sorted;
  sorted.reserve(loops.size());
  for (const std::size_t i : order) sorted.push_back(loops[i]);
  return sorted;
}

namespace {

bool has_loose_vertex(const InputPlc& plc) {
  std::vector<bool> used(plc.vertices.size(), false);
  for (const auto& triangle : plc.triangles)
    for (const std::uint32_t v : triangle) used[v] = true;
  for (const PolygonFacet& facet : plc.polygon_facets)
    for (const auto& polygon : facet.polygons)
      for (const std::uint32_t v : polygon) used[v] = true;
  return std::find(used.begin(), used.end(), false) != used.end();
}

/// Why the format cannot hold a facet of polygons; empty if it can.
std::string objection(const PolygonFacet& facet, const FormatLimits& limits) {
  const std::string name(limits.name);
  if (!limits.several_polygons && (facet.polygons.size() != 1 || !facet.holes.empty()))
    return name + " cannot hold facets with holes or of several polygons";
  for (const auto& polygon : facet.polygons) {
    if (!limits.several_polygons && polygon.size() < 3) return name + " cannot hold facets of fewer than three corners";
    if (polygon.size() > limits.most_corners)
      return name + " cannot hold facets of more than " + std::to_string(limits.most_corners) + " corners";
  }
  return {};
}

[[noreturn]] void refuse(const std::string& file, const std::string& what) {
  throw OutputError(what, place_in(file), "write a .poly file instead");
}

}  // namespace

void check_format_holds(const InputPlc& plc, const FormatLimits& limits, const std::string& file) {
  const std::string name(limits.name);
  if (plc.vertices.empty())
    throw OutputError("there are no vertices to write", place_in(file), "check the model that is to be written");
  if (!limits.segments && !plc.segments.empty()) refuse(file, name + " cannot hold segments");
  if (!limits.seeds && !plc.holes.empty()) refuse(file, name + " cannot hold seeds of holes");
  if (!limits.seeds && !plc.regions.empty()) refuse(file, name + " cannot hold seeds of regions");
  for (const PolygonFacet& facet : plc.polygon_facets) {
    const std::string what = objection(facet, limits);
    if (!what.empty()) refuse(file, "facet " + std::to_string(facet.number) + ": " + what);
  }
  if (!limits.loose_vertices && has_loose_vertex(plc)) refuse(file, name + " cannot hold vertices that no facet has");
}

InputPlc::Inside inside_claimed(const FileBytes& file) {
  const std::string_view start = std::string_view(file.bytes).substr(0, 1024);
  return start.find(even_odd_claim) == std::string_view::npos ? InputPlc::Inside::seeds : InputPlc::Inside::even_odd;
}

}  // namespace ccdt::io
