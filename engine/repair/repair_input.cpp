#include "engine/repair/repair_input.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <optional>
#include <tuple>
#include <utility>

#include "engine/base/box.h"
#include "engine/base/check_arguments.h"
#include "engine/base/digits.h"
#include "engine/base/errors.h"
#include "engine/base/simplex_map.h"
#include "engine/plc/check_input.h"
#include "engine/plc/gather_parts.h"
#include "engine/repair/certify.h"
#include "engine/repair/close_gaps.h"
#include "engine/repair/cut_crossings.h"
#include "engine/repair/equal_triangles.h"
#include "engine/repair/fill_holes.h"
#include "engine/repair/find_welds.h"
#include "engine/repair/gather_soup.h"
#include "engine/repair/orient_shells.h"
#include "engine/repair/remove_flaps.h"
#include "engine/repair/remove_sheets.h"
#include "engine/repair/remove_walls.h"

namespace ccdt::repair {
namespace {

using plc::InputPlc;

constexpr std::string_view repair_stage = "repair";
constexpr std::uint64_t steps_of_repair = 2;

bool is_surface(const InputPlc& input) {
  return input.inside == InputPlc::Inside::even_odd;
}

/// Is thrown where a step ends after the given time.
struct OutOfTime {};

/// Ends the repair at the first step that begins too late.
Progress until(double seconds, const Progress& progress) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  return [end, progress](std::string_view name, std::uint64_t done, std::uint64_t total) {
    if (std::chrono::steady_clock::now() > end && done < total) throw OutOfTime();
    report(progress, name, done, total);
  };
}

/// What is allowed, in grid units.
struct Limits {
  double gap, reach, displacement;
  double weld;  // a usual displacement, whatever lids may do
};

Limits limits_of(const RepairOptions& options, const plc::Plc& plc) {
  const double extent = largest_extent(plc.vertices), limit = options.limit / plc.grid.unit;
  const double displacement = limit > 0 ? limit : usual_displacement * extent;
  return {.gap = options.gap > 0 ? options.gap / plc.grid.unit : usual_gap * extent,
          .reach = limit > 0 ? limit : usual_reach * extent,
          .displacement = displacement,
          .weld = std::min(displacement, usual_displacement * extent)};
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

InputPlc to_input(const InputPlc& given, const plc::UncheckedPlc& soup) {
  const auto& [plc, triangles, segments] = soup;
  InputPlc input;
  input.name = given.name;
  input.inside = given.inside;
  input.holes = given.holes;
  input.regions = given.regions;
  input.marker_names = given.marker_names;
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

/// Repairs a surface or PLC step by step, and notes what it does.
class Repair {
 public:
  Repair(const InputPlc& input, const RepairOptions& options, const Progress& progress)
      : input_(input),
        options_{options.flatness},
        progress_(until(options.seconds > 0 ? options.seconds : usual_seconds(input.facet_count()), progress)),
        soup_(gather_soup(input, options_)),
        parts_(soup_.parts),
        given_(soup_.parts),
        limits_(limits_of(options, parts_.plc)) {}

  Repaired run() {
    note_gathered();
    try {
      report(progress_, repair_stage, 0, steps_of_repair);
      if (is_surface(input_)) join_open_edges();
      report(progress_, repair_stage, 1, steps_of_repair);
      repair_with_larger_welds();
    } catch (const OutOfTime&) {
      result_.is_out_of_time = true;
    }
    result_.certificate = certify(given_, parts_, lids_);
    note_limits();
    result_.input = to_input(input_, parts_);
    return std::move(result_);
  }

 private:
  void add(std::string_view name, std::string_view what, std::uint64_t count, std::vector<Place> places = {}) {
    if (count == 0) return;
    const auto known = std::ranges::find(result_.steps, name, &RepairStep::name);
    RepairStep& step = known == result_.steps.end() ? result_.steps.emplace_back(RepairStep{name, what}) : *known;
    step.count += count;
    for (Place& place : places)
      if (step.places.size() < most_places) step.places.push_back(std::move(place));
  }

  Place place_of(std::span<const VertexId> vertices, std::vector<long long> facets = {}) const {
    Place place{.facets = std::move(facets)};
    for (const VertexId v : vertices) place.points.push_back(as_array(parts_.plc.world[v]));
    return place;
  }

  std::vector<Place> places_of(const plc::TriangleSet& triangles) const {
    std::vector<Place> places;
    for (std::uint32_t t = 0; t < triangles.size() && t < most_places; ++t)
      places.push_back(place_of(triangles.corners[t], {triangles.numbers[t]}));
    return places;
  }

  void note_gathered() {
    add("invalid_polygons", "facets removed because they are not polygons in one plane", soup_.invalid_polygons.size(),
        soup_.invalid_polygons);
    add("warped_facets", "polygons triangulated because they are not planar", soup_.input.warped.count);
    std::vector<Place> without_area;
    for (const std::uint32_t number : soup_.without_area) without_area.push_back({.facets = {number}});
    add("without_area", "facets without area removed", soup_.without_area.size(), std::move(without_area));
    add("equal_vertices", "vertices merged with one at the same place",
        input_.vertices.size() - parts_.plc.vertices.size());
    add("duplicates", "duplicate facets removed", drop_equal_triangles(parts_.triangles, Fins::keep));
  }

  void join_open_edges() {
    const GapCounts gaps = close_gaps(parts_, limits_.gap);
    std::vector<Place> merged;
    for (const VertexId v : gaps.merged) merged.push_back(place_of({&v, 1}));
    if (gaps.merged.size() + gaps.split_edges > 0) limits_.displacement = std::max(limits_.displacement, limits_.gap);
    add("merged_vertices", "vertices of open edges merged with one nearby", gaps.merged.size(), std::move(merged));
    add("split_edges", "open edges split at nearby vertices", gaps.split_edges);
    add("collapsed_facets", "duplicate facets removed afterward", drop_equal_triangles(parts_.triangles, Fins::keep));
  }

  /// \return  was there anything to do?
  bool close_surface() {
    const std::size_t flaps = remove_flaps(parts_);
    add("flaps", "facets removed because they bounded nothing", flaps);
    orient_shells(parts_);
    FilledHoles holes = fill_holes(parts_, Rims::of_holes, limits_.reach);
    if (flaps == 0 && holes.lids.empty()) holes = fill_holes(parts_, Rims::all, limits_.reach);
    const plc::TriangleSet sheets = remove_sheets(parts_);
    left_open_ = sheets.size() == 0 ? holes.left_open : 0;
    farthest_ = holes.farthest;
    std::vector<Place> rims;
    for (const std::vector<VertexId>& rim : holes.rims) rims.push_back(place_of(rim));
    add("filled_holes", "holes filled", holes.lids.size(), std::move(rims));
    add("filling_triangles", "triangles that fill them", holes.triangles());
    add("sheets", "facets removed because they are on small open sheets", sheets.size(), places_of(sheets));
    lids_.insert(lids_.end(), holes.lids.begin(), holes.lids.end());
    return flaps > 0 || !holes.lids.empty() || sheets.size() > 0;
  }

  /// Sheets that are folded back to back vanish, and flat ones enclose nothing.
  void check_something_is_enclosed() const {
    if (parts_.triangles.size() > 0 && !(is_surface(input_) && are_flat_sheets(parts_, tolerance()))) return;
    throw InputError("the facets enclose nothing, so there is nothing to repair", {.file = input_.name},
                     "give a surface that encloses something");
  }

  double tolerance() const { return plc::tolerance_of(parts_.plc, options_.flatness); }

  CutCounts cut_and_unite(bool weld_everywhere) {
    OrientedSurface surface{parts_.plc.vertices, parts_.triangles.corners};
    const CutCounts cuts = cut_crossings(parts_, {reach_, spacing_, weld_everywhere}, progress_);
    has_cuts_ = has_cuts_ || cuts.pairs > 0;
    add("crossings", "pairs of facets cut at their intersection", cuts.pairs);
    check_something_is_enclosed();
    if (cuts.pairs == 0 || cuts.left > 0 || !is_surface(input_)) return cuts;
    turn_parts_outward(surface);
    try {
      add("walls", "facets removed from the inside of the union", remove_walls(parts_, surface, soup_.input, options_));
    } catch (const InputError&) {
      // As in `turn_outward`.
    }
    return cuts;
  }

  /// Turns the facets of a surface without crossings so that their normals point out of the domain. Facets inside stay
  /// as they are.
  ///
  /// \return  is the surface valid?
  bool turn_outward() {
    try {
      const plc::Plc plc = plc::assemble_plc(soup_.input, parts_, options_);
      turn_like(outward_triangles(plc), plc.vertices.size(), parts_.triangles.corners);
      return true;
    } catch (const InputError&) {
      return false;  // whoever checks the repaired input sees what is still wrong with it
    }
  }

  /// Does nothing almost touch? Cuts can leave features that are far smaller than the edges beside them, and these can
  /// keep the mesher from protecting the edges.
  bool is_clean() const {
    if (!has_cuts_) return true;
    const std::vector<std::uint8_t> everywhere(parts_.plc.vertices.size(), 1);
    return find_welds(parts_.plc.vertices, parts_.triangles, everywhere, {.edges = largest_weld()}).empty();
  }

  double largest_weld() const { return limits_.weld / 2; }

  /// Things that should touch may be farther apart than facets from being flat: as far as a file with few digits
  /// rounds. So larger welds are tried where smaller ones do not lead to a clean surface, and there vertices are
  /// rounded to a coarser grid. If none is clean, the last valid one counts: the coarser the grid, the larger its
  /// features.
  void repair_with_larger_welds() {
    const auto state = [&] { return std::tie(parts_, lids_, left_open_, farthest_, result_.steps); };
    using State = std::tuple<plc::UncheckedPlc, std::vector<Lid>, std::size_t, double, std::vector<RepairStep>>;
    const State before = state();
    std::optional<State> first, last_valid;
    try {
      for (const double reach : {tolerance(), largest_weld() / 4, largest_weld()}) {
        if (reach < reach_) continue;
        if (first) {
          state() = before;
          spacing_ = std::max(DyadicGrid::quantum, std::exp2(std::floor(std::log2(reach / 4))));
        }
        reach_ = reach;
        has_cuts_ = false;
        const bool is_valid = is_surface(input_) ? repair_surface() : cut_and_unite(false).left == 0;
        if (is_valid && is_clean()) return;
        if (!first) first = state();
        if (is_valid) last_valid = state();
        if (is_given_open_) break;
      }
    } catch (const OutOfTime&) {
      if (!last_valid) throw;
    }
    state() = last_valid ? *last_valid : *first;
  }

  /// Closes the surface, cuts it, and turns it outward. What fills a hole can cross other facets, and cuts can leave
  /// flaps.
  ///
  /// \return  is it valid?
  bool repair_surface() {
    constexpr int most_rounds = 5;
    const std::vector<plc::VertexTriple> as_given = parts_.triangles.corners;
    bool are_comparable = true;  // pieces of facets cannot be compared with these
    std::size_t crossings = 0;
    for (int round = 0; round < most_rounds; ++round) {
      if (!close_surface() && round > 0) break;
      if (round == 0) is_given_open_ = left_open_ > 0;
      const CutCounts cuts = cut_and_unite(false);
      if (cuts.pairs > 0) are_comparable = false;
      crossings = cuts.left;
    }
    bool is_valid = crossings == 0 && turn_outward();
    if (crossings == 0 && !is_valid) {
      // Facets may cover each other within the tolerance without a crossing.
      are_comparable = false;
      is_valid = cut_and_unite(true).left == 0 && turn_outward();
    }
    if (!are_comparable) return is_valid;
    std::vector<plc::VertexTriple> now = parts_.triangles.corners;
    add("turned_facets", "facets turned", turn_like(as_given, parts_.plc.vertices.size(), now));
    return is_valid;
  }

  void note_limits() {
    const double unit = parts_.plc.grid.unit;
    const auto allowed = [&](double needed, double limit) {
      return digits(unit * limit) + " is allowed; --limit " + digits(needed) + " allows it";
    };
    if (left_open_ > 0)
      result_.refused.push_back(
          (left_open_ == 1 ? std::string("a hole stays open: its lid") : "holes stay open: the farthest lid") +
          " would reach " + digits(unit * farthest_) + " from its rim, and " +
          allowed(unit * farthest_, limits_.reach));
    if (result_.certificate.displacement > unit * limits_.displacement)
      result_.refused.push_back("the surface would move by up to " + digits(result_.certificate.displacement) +
                                ", and " + allowed(result_.certificate.displacement, limits_.displacement));
  }

  static constexpr std::size_t most_places = 1000;

  const InputPlc& input_;
  plc::PlcOptions options_;
  Progress progress_;
  Soup soup_;
  plc::UncheckedPlc& parts_;  // of the soup
  const plc::UncheckedPlc given_;
  Limits limits_;
  double reach_ = 0;                      // of welds
  double spacing_ = DyadicGrid::quantum;  // of vertices
  bool has_cuts_ = false;                 // were facets cut since then?
  bool is_given_open_ = false;            // has holes before anything is cut that must stay open
  std::vector<Lid> lids_;
  std::size_t left_open_ = 0;  // holes whose lids would reach too far, at last
  double farthest_ = 0;        // how far those would reach
  Repaired result_;
};

}  // namespace

double usual_seconds(std::size_t facets) {
  constexpr double at_least = 20, per_facet = 1e-3;
  return at_least + per_facet * static_cast<double>(facets);
}

Repaired repair_input(const InputPlc& input, const RepairOptions& options, const Progress& progress) {
  plc::check_input(input);
  check_number("flatness", options.flatness);
  check_number("gap", options.gap);
  check_number("limit", options.limit);
  check_number("time of repair", options.seconds);
  Repaired repaired = Repair(input, options, progress).run();
  report(progress, repair_stage, steps_of_repair, steps_of_repair);
  return repaired;
}

}  // namespace ccdt::repair
