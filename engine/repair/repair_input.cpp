#include "engine/repair/repair_input.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "engine/base/box.h"
#include "engine/base/errors.h"
#include "engine/base/simplex_map.h"
#include "engine/plc/gather_parts.h"
#include "engine/repair/close_gaps.h"
#include "engine/repair/cut_crossings.h"
#include "engine/repair/equal_triangles.h"
#include "engine/repair/fill_holes.h"
#include "engine/repair/gather_soup.h"
#include "engine/repair/orient_shells.h"
#include "engine/repair/remove_flaps.h"
#include "engine/repair/remove_walls.h"

namespace ccdt::repair {
namespace {

using plc::InputPlc;

constexpr std::string_view repair_stage = "repair";
constexpr std::uint64_t steps_of_repair = 2;

bool is_surface(const InputPlc& input) {
  return input.inside == InputPlc::Inside::even_odd;
}

double widest_gap(const RepairOptions& options, const plc::Plc& plc) {
  if (options.gap > 0) return options.gap / plc.grid.unit;
  return usual_gap * largest_extent(plc.vertices);
}

/// Notes what was done.
class StepList {
 public:
  explicit StepList(std::vector<RepairStep>& steps) : steps_(steps) {}

  void add(const RepairStep& step) {
    if (step.count == 0) return;
    const auto known = std::ranges::find(steps_, step.name, &RepairStep::name);
    if (known == steps_.end())
      steps_.push_back(step);
    else
      known->count += step.count;
  }

 private:
  std::vector<RepairStep>& steps_;
};

void join_open_edges(double gap, plc::UncheckedPlc& soup, StepList& steps) {
  const GapCounts gaps = close_gaps(soup, gap);
  steps.add({"merged_vertices", "vertices of open edges merged with one nearby", gaps.merged_vertices});
  steps.add({"split_edges", "open edges split at nearby vertices", gaps.split_edges});
  steps.add(
      {"collapsed_facets", "duplicate facets removed afterward", drop_equal_triangles(soup.triangles, Fins::keep)});
}

/// \return  was there anything to do?
bool close_surface(plc::UncheckedPlc& soup, StepList& steps) {
  const std::size_t flaps = remove_flaps(soup);
  steps.add({"flaps", "facets removed because they bounded nothing", flaps});
  orient_shells(soup);
  HoleCounts holes = fill_holes(soup);
  if (flaps == 0 && holes.filled == 0) holes = fill_holes(soup, Rims::all);
  steps.add({"filled_holes", "holes filled", holes.filled});
  steps.add({"filling_triangles", "triangles that fill them", holes.triangles});
  return flaps > 0 || holes.filled > 0;
}

/// Sheets that are folded back to back vanish.
void check_something_is_left(const InputPlc& input, const plc::UncheckedPlc& soup) {
  if (soup.triangles.size() > 0) return;
  throw InputError("no facet encloses anything, so a repair leaves nothing", {.file = input.name},
                   "give a surface that encloses something");
}

CutCounts cut_and_unite(const InputPlc& input, const plc::PlcOptions& options, bool weld_everywhere,
                        const Progress& progress, plc::UncheckedPlc& soup, StepList& steps) {
  const OrientedSurface given{soup.plc.vertices, soup.triangles.corners};
  const double tolerance = plc::tolerance_of(soup.plc, options.flatness);
  const CutCounts cuts = cut_crossings(soup, {tolerance, weld_everywhere}, progress);
  steps.add({"crossings", "pairs of facets cut at their intersection", cuts.pairs});
  check_something_is_left(input, soup);
  if (cuts.pairs == 0 || cuts.left > 0 || !is_surface(input)) return cuts;
  try {
    steps.add({"walls", "facets removed from the inside of the union", remove_walls(soup, given, input, options)});
  } catch (const InputError&) {
    // As in `turn_outward`.
  }
  return cuts;
}

/// Turns triangles that face the opposite way from the given ones with the same corners.
std::size_t turn_like(const std::vector<plc::VertexTriple>& given, std::size_t vertices,
                      std::vector<plc::VertexTriple>& triangles) {
  const FaceMap faces(given, vertices);
  std::size_t turned = 0;
  for (plc::VertexTriple& corners : triangles) {
    const FaceMap::Found found = faces.find(corners[0], corners[1], corners[2]);
    if (found.index == none || !found.faces_the_other_way) continue;
    std::swap(corners[1], corners[2]);
    ++turned;
  }
  return turned;
}

/// Turns the facets of a surface without crossings so that their normals point out of the domain. Facets inside stay as
/// they are.
///
/// \return  is the surface valid?
bool turn_outward(const InputPlc& input, const plc::PlcOptions& options, plc::UncheckedPlc& soup) {
  try {
    const plc::Plc plc = plc::assemble_plc(input, soup, options);
    turn_like(outward_triangles(plc), plc.vertices.size(), soup.triangles.corners);
    return true;
  } catch (const InputError&) {
    return false;  // whoever checks the repaired input sees what is still wrong with it
  }
}

/// Closes the surface, cuts it, and turns it outward. What fills a hole can cross other facets, and cuts can leave
/// flaps.
void repair_surface(Soup& soup, const plc::PlcOptions& options, const Progress& progress, StepList& steps) {
  constexpr int most_rounds = 5;
  plc::UncheckedPlc& parts = soup.parts;
  const std::vector<plc::VertexTriple> as_given = parts.triangles.corners;
  bool are_comparable = true;  // pieces of facets cannot be compared with these
  std::size_t crossings = 0;
  for (int round = 0; round < most_rounds; ++round) {
    if (!close_surface(parts, steps) && round > 0) break;
    const CutCounts cuts = cut_and_unite(soup.input, options, false, progress, parts, steps);
    if (cuts.pairs > 0) are_comparable = false;
    crossings = cuts.left;
  }
  if (crossings == 0 && !turn_outward(soup.input, options, parts)) {
    // Facets may cover each other within the tolerance without a crossing.
    are_comparable = false;
    if (cut_and_unite(soup.input, options, true, progress, parts, steps).left == 0)
      turn_outward(soup.input, options, parts);
  }
  if (!are_comparable) return;
  std::vector<plc::VertexTriple> now = parts.triangles.corners;
  steps.add({"turned_facets", "facets turned", turn_like(as_given, parts.plc.vertices.size(), now)});
}

InputPlc to_input(const InputPlc& given, const plc::UncheckedPlc& soup) {
  const auto& [plc, triangles, segments] = soup;
  InputPlc input;
  input.name = given.name;
  input.inside = given.inside;
  input.holes = given.holes;
  input.regions = given.regions;
  std::vector<std::uint32_t> number(plc.vertices.size(), 0);
  if (is_surface(given)) {
    for (const auto& corners : triangles.corners)
      for (const VertexId v : corners) number[v] = 1;
    for (const auto& ends : segments.ends)
      for (const VertexId v : ends) number[v] = 1;
  } else {
    std::ranges::fill(number, 1u);  // a vertex alone is a vertex of the mesh
  }
  for (std::uint32_t v = 0; v < number.size(); ++v) {
    if (number[v] == 0) continue;
    number[v] = static_cast<std::uint32_t>(input.vertices.size());
    input.vertices.push_back(plc.world[v]);
  }
  for (const auto& [a, b, c] : triangles.corners) input.triangles.push_back({number[a], number[b], number[c]});
  if (std::ranges::any_of(triangles.markers, [](int marker) { return marker != 0; }))
    input.triangle_markers = triangles.markers;
  for (const auto& [a, b] : segments.ends) input.segments.push_back({number[a], number[b]});
  if (std::ranges::any_of(segments.markers, [](int marker) { return marker != 0; }))
    input.segment_markers = segments.markers;
  return input;
}

}  // namespace

Repaired repair_input(const InputPlc& input, const RepairOptions& options, const Progress& progress) {
  report(progress, repair_stage, 0, steps_of_repair);
  const plc::PlcOptions plc_options{options.flatness};
  Repaired repaired;
  StepList steps(repaired.steps);
  Soup soup = gather_soup(input, plc_options);
  plc::UncheckedPlc& parts = soup.parts;
  steps.add(
      {"invalid_polygons", "facets removed because they are not polygons in one plane", soup.invalid_polygons.size()});
  steps.add({"warped_facets", "polygons triangulated because they are not planar", soup.input.warped.count});
  steps.add({"without_area", "facets without area removed", soup.without_area.size()});
  steps.add({"equal_vertices", "vertices merged with one at the same place",
             input.vertices.size() - parts.plc.vertices.size()});
  steps.add({"duplicates", "duplicate facets removed", drop_equal_triangles(parts.triangles, Fins::keep)});
  report(progress, repair_stage, 1, steps_of_repair);
  if (is_surface(input)) {
    join_open_edges(widest_gap(options, parts.plc), parts, steps);
    repair_surface(soup, plc_options, progress, steps);
  } else {
    cut_and_unite(soup.input, plc_options, false, progress, parts, steps);
  }
  repaired.input = to_input(input, parts);
  report(progress, repair_stage, steps_of_repair, steps_of_repair);
  return repaired;
}

}  // namespace ccdt::repair
