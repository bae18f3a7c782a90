#include "engine/surface/mark_by_angle.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <numeric>
#include <span>
#include <unordered_map>
#include <vector>

#include "engine/base/errors.h"
#include "engine/base/union_find.h"
#include "engine/plc/build_plc.h"
#include "engine/plc/warped_facets.h"
#include "engine/surface/sharp_angle.h"

namespace ccdt::surface {
namespace {

bool has_several_markers(const plc::InputPlc& input) {
  std::vector<int> markers = input.triangle_markers;
  if (markers.empty() && !input.triangles.empty()) markers.push_back(0);
  for (const plc::PolygonFacet& facet : input.polygon_facets) markers.push_back(facet.marker);
  return std::ranges::adjacent_find(markers, std::ranges::not_equal_to()) != markers.end();
}

/// Faults do not matter here: an input is checked where it is meshed.
struct LenientExaminer : plc::Examiner {
  void see_duplicates(const plc::UncheckedPlc&, std::span<const plc::TrianglePair>) override {}
  void see_overlaps(const plc::Plc&, const plc::ConnectedParts&) override {}
};

plc::Examined connect_facets(const plc::InputPlc& input, double flatness) {
  const auto triangulated = plc::triangulate_warped_facets(input);
  const plc::PlcOptions options{flatness};
  LenientExaminer examiner;
  return plc::examine_parts(plc::gather_plc(triangulated ? *triangulated : input, options), options, 1, examiner);
}

/// By flat patch. A triangle alone may be so thin that its normal says nothing.
std::vector<Point3> normals_of_patches(const plc::Examined& surface) {
  const plc::PlcParts& parts = surface.connected.parts;
  std::vector<Point3> normals(parts.patches.count());
  for (std::uint32_t t = 0; t < parts.triangles.size(); ++t) {
    Point3& normal = normals[parts.patches.facet_of[t]];
    normal = normal + area_vector(plc::points_of(surface.plc.world, parts.triangles.corners[t]));
  }
  for (Point3& normal : normals) normal = normalized(normal);
  return normals;
}

void join_across_blunt_edges(const plc::Examined& surface, SharpAngle sharp_angle, UnionFind& sets) {
  const plc::PlcParts& parts = surface.connected.parts;
  const std::vector<Point3> normals = normals_of_patches(surface);
  const auto normal_at = [&](std::uint32_t side) { return normals[parts.patches.facet_of[plc::triangle_of(side)]]; };
  for (std::uint32_t e = 0; e < parts.edges.size(); ++e) {
    const auto sides = parts.edges.sides_around(e);
    if (sides.size() != 2 || parts.match.segment_of[e] != none) continue;
    const bool oriented_alike = plc::is_above(sides[0]) != plc::is_above(sides[1]);
    if (!sharp_angle.is_exceeded(normal_at(sides[0]), normal_at(sides[1]), oriented_alike))
      sets.join(plc::triangle_of(sides[0]), plc::triangle_of(sides[1]));
  }
}

/// Markers by the number of the facet in the file.
struct FacetMarkers {
  std::unordered_map<std::uint32_t, int> of_number;
  int count = 0;
};

FacetMarkers number_sets(const std::vector<std::uint32_t>& numbers, UnionFind& sets) {
  std::vector<std::uint32_t> in_order(numbers.size());
  std::iota(in_order.begin(), in_order.end(), 0u);
  std::ranges::stable_sort(in_order, {}, [&](std::uint32_t t) { return numbers[t]; });
  for (std::size_t i = 1; i < in_order.size(); ++i)
    if (numbers[in_order[i]] == numbers[in_order[i - 1]]) sets.join(in_order[i], in_order[i - 1]);
  FacetMarkers markers;
  std::vector<int> of_set(numbers.size(), 0);
  for (const std::uint32_t t : in_order) {
    int& marker = of_set[sets.find(t)];
    if (marker == 0) marker = ++markers.count;
    markers.of_number[numbers[t]] = marker;
  }
  return markers;
}

}  // namespace

int mark_by_angle(plc::InputPlc& input, double sharp_angle, double flatness) {
  if (has_several_markers(input))
    throw InputError("the facets have several markers already", {.file = input.name},
                     "use these, or remove them from the file");
  const plc::Examined surface = connect_facets(input, flatness);
  const std::vector<std::uint32_t>& numbers = surface.connected.parts.triangles.numbers;
  UnionFind sets(numbers.size());
  join_across_blunt_edges(surface, SharpAngle(sharp_angle), sets);
  const FacetMarkers markers = number_sets(numbers, sets);

  const auto marker_of = [&](std::uint32_t number) {
    const auto found = markers.of_number.find(number);
    return found == markers.of_number.end() ? 0 : found->second;
  };
  input.marker_names.clear();
  input.triangle_markers.clear();
  for (std::uint32_t t = 0; t < input.triangles.size(); ++t)
    input.triangle_markers.push_back(marker_of(input.triangle_numbers.empty() ? t : input.triangle_numbers[t]));
  for (plc::PolygonFacet& facet : input.polygon_facets) facet.marker = marker_of(facet.number);
  return markers.count;
}

}  // namespace ccdt::surface
