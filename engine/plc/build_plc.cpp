#include "engine/plc/build_plc.h"

#include <algorithm>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/base/count_work.h"
#include "engine/base/errors.h"
#include "engine/base/parallel.h"
#include "engine/plc/find_regions.h"
#include "engine/plc/find_repeats.h"
#include "engine/plc/gather_parts.h"
#include "engine/plc/input_faults.h"

namespace ccdt::plc {

namespace {

constexpr std::string_view stage = "plc";
constexpr std::uint64_t steps_of_build = 4;
constexpr std::size_t most_overlaps = 1000;

void check_facets_exist(const InputPlc& input) {
  if (input.facet_count() > 0 && !input.vertices.empty()) return;
  throw InputError("there are no facets", {.file = input.name}, "give a surface, or a .poly or .smesh with facets");
}

/// Stops at the first error.
struct StrictExaminer : Examiner {
  const Progress& progress;

  explicit StrictExaminer(const Progress& its_progress) : progress(its_progress) {}
  void see_conforming(const UncheckedPlc& /*parts*/) override { report(progress, stage, 2, steps_of_build); }
  void see_duplicates(const UncheckedPlc& parts, std::span<const TrianglePair> pairs) override {
    throw_duplicates(parts.plc, parts.triangles, pairs);
  }
  void see_overlaps(const Plc& plc, const ConnectedParts& connected) override {
    for (const auto* found :
         {&connected.overlaps.covering, &connected.overlaps.crossing, &connected.overlaps.of_segments})
      if (!found->empty())
        throw_overlaps(plc, connected.parts.triangles, connected.parts.segments, *found,
                       found->size() == most_overlaps);
  }
};

// Does the domain span 180 degrees or more around the edge?
bool is_grazeable(std::span<const Point3> vertices, const PlcParts& parts, const RegionMap& map, std::uint32_t e) {
  const auto around = parts.edges.sides_around(e);
  const auto is_inside = [&](std::size_t i) { return map.regions[map.of_side[around[i]]].inside; };
  if (around.size() == 1) return is_inside(0);
  if (around.size() == 2) {
    const Turn turn = parts.edges.turns[e];
    return turn == Turn::exactly_180 ? is_inside(0) || is_inside(1) : is_inside(turn == Turn::above_180 ? 0 : 1);
  }
  const auto [a, b] = parts.edges.ends[e];
  const auto apex = [&](std::size_t i) {
    return vertices[apex_over(parts.triangles.corners[triangle_of(around[i])], a, b)];
  };
  for (std::size_t i = 0; i < around.size(); ++i) {
    if (!is_inside(i)) continue;
    const Turn turn = turn_about(vertices[a], vertices[b], apex(i), apex((i + 1) % around.size()));
    if (turn == Turn::exactly_180 || turn == Turn::above_180) return true;
  }
  return false;
}

bool is_in_domain(const PlcParts& parts, const RegionMap& map, std::uint32_t e) {
  return std::ranges::any_of(parts.edges.sides_around(e),
                             [&](std::uint32_t side) { return map.regions[map.of_side[side]].inside; });
}

// Does the domain touch itself along the edge?
bool is_touching(const PlcParts& parts, const RegionMap& map, std::uint32_t e) {
  if (parts.edges.sides_around(e).size() <= 2) return false;
  return std::ranges::count_if(parts.edges.around(e), [&](std::uint32_t t) {
           return map.regions[map.of(t, true)].inside != map.regions[map.of(t, false)].inside;
         }) > 2;
}

// The edges that do not lie within one facet, and the segments of the input that are not edges.
std::vector<Segment> collect_segments(std::span<const Point3> vertices, const PlcParts& parts, const RegionMap& map) {
  std::vector<Segment> segments;
  const auto& is_inner = parts.patches.is_inner_edge;
  parallel_pack(
      parts.edges.size(), 4096,
      [&](std::size_t e, std::size_t end) {
        return static_cast<std::size_t>(std::ranges::count(std::span(is_inner).subspan(e, end - e), 0));
      },
      [&](std::size_t count) { segments.resize(count); },
      [&](std::size_t begin, std::size_t end, std::size_t next) {
        for (auto e = static_cast<std::uint32_t>(begin); e < end; ++e) {
          if (is_inner[e]) continue;
          const std::uint32_t s = parts.match.segment_of[e];
          const int marker = s == none ? 0 : parts.segments.markers[s];
          std::uint32_t face = no_face;
          for (const std::uint32_t t : parts.edges.around(e)) face = std::min(face, parts.triangles.faces[t]);
          segments[next++] = {parts.edges.ends[e],        marker, is_grazeable(vertices, parts, map, e),
                              is_touching(parts, map, e), face,   is_in_domain(parts, map, e)};
        }
      });
  for (std::size_t i = 0; i < map.of_loose.size(); ++i) {
    const std::uint32_t s = parts.match.loose[i];
    const bool inside = map.regions[map.of_loose[i]].inside;
    segments.push_back(
        {.ends = parts.segments.ends[s], .marker = parts.segments.markers[s], .grazeable = inside, .listed = inside});
  }
  return segments;
}

void collect_facets(const TriangleSet& triangles, const FacetPatches& patches, const RegionMap& map, Plc& plc) {
  plc.facets.resize(patches.count());
  parallel_for(plc.facets.size(), 4096, [&](std::size_t f) {
    const auto members = patches.members.of(f);
    const std::uint32_t first = members.front();
    plc.facets[f] = {.first_triangle = patches.members.first[f],
                     .triangle_count = static_cast<std::uint32_t>(members.size()),
                     .exactly_flat = patches.exactly_flat[f] != 0,
                     .marker = triangles.markers[first],
                     .number = triangles.numbers[first],
                     .above = map.of(first, true),
                     .below = map.of(first, false)};
  });
  const std::vector<std::uint32_t>& in_order = patches.members.items;
  plc.triangles.resize(in_order.size());
  plc.faces.resize(in_order.size());
  parallel_for(in_order.size(), 4096, [&](std::size_t i) {
    plc.triangles[i] = triangles.corners[in_order[i]];
    plc.faces[i] = triangles.faces[in_order[i]];
  });
}

}  // namespace

UncheckedPlc gather_plc(const InputPlc& input, const PlcOptions& options, const Progress& progress) {
  report(progress, stage, 0, steps_of_build);
  check_facets_exist(input);
  UncheckedPlc gathered;
  auto& [plc, triangles, segments] = gathered;
  plc.name = input.name;
  snap_vertices(input, plc);
  triangles = gather_triangles(input, plc);
  segments = gather_segments(input, plc);
  // A smaller tolerance gives smaller facets; it does not make polygons invalid.
  const double tolerance = tolerance_of(plc, std::max(options.flatness, PlcOptions{}.flatness));
  triangulate_polygons(input, plc, tolerance, triangles, segments);
  drop_triangles_without_area(plc.vertices, triangles);
  if (triangles.size() == 0) throw_input_error(plc, "no facet has an area", "give a surface that encloses something");
  report(progress, stage, 1, steps_of_build);
  return gathered;
}

Examined examine_parts(UncheckedPlc parts, const PlcOptions& options, std::size_t limit, Examiner& examiner) {
  auto& [plc, triangles, segments] = parts;
  if (const std::vector<TrianglePair> pairs = find_duplicate_triangles(plc, triangles); !pairs.empty()) {
    examiner.see_duplicates(parts, pairs);
    std::vector<char> is_kept(triangles.size(), 1);
    for (const TrianglePair& pair : pairs) is_kept[pair.second] = 0;
    keep_triangles(is_kept, triangles);
  }
  examiner.see_whole(parts);
  const std::vector<TrianglePair> close = make_conforming(plc.vertices, triangles);
  split_segments_at_vertices(plc.vertices, segments);
  examiner.see_conforming(parts);
  ConnectedParts connected = connect_parts(plc, std::move(triangles), std::move(segments), close, options, limit);
  examiner.see_overlaps(plc, connected);
  return {std::move(plc), std::move(connected)};
}

Plc finish_plc(const InputPlc& input, Examined examined) {
  auto& [plc, connected] = examined;
  auto& [parts, overlaps, tree] = connected;
  const auto& [triangles, segments, edges, match, patches] = parts;
  RegionMap map = find_regions(input, plc, parts, tree);
  note_bytes(bytes_of(plc.world, plc.vertices, triangles.corners, triangles.markers, triangles.numbers, segments.ends,
                      edges.ends, patches.facet_of, map.of_side) +
             (tree ? tree->bytes() : 0));
  plc.segments = collect_segments(plc.vertices, parts, map);
  collect_facets(triangles, patches, map, plc);
  plc.regions = std::move(map.regions);
  plc.idle_holes = std::move(map.idle_holes);
  return std::move(plc);
}

Plc assemble_plc(const InputPlc& input, UncheckedPlc parts, const PlcOptions& options) {
  split_segments_at_vertices(parts.plc.vertices, parts.segments);
  ConnectedParts connected =
      connect_parts(parts.plc, std::move(parts.triangles), std::move(parts.segments), {}, options, most_overlaps);
  StrictExaminer({}).see_overlaps(parts.plc, connected);
  return finish_plc(input, {std::move(parts.plc), std::move(connected)});
}

Plc check_plc(const InputPlc& input, UncheckedPlc gathered, const PlcOptions& options, const Progress& progress) {
  StrictExaminer examiner(progress);
  Examined examined = examine_parts(std::move(gathered), options, most_overlaps, examiner);
  report(progress, stage, 3, steps_of_build);
  Plc plc = finish_plc(input, std::move(examined));
  plc.periodicity = options.periodicity;
  find_repeats(plc);  // throws
  report(progress, stage, steps_of_build, steps_of_build);
  return plc;
}

Plc build_plc(const InputPlc& input, const PlcOptions& options, const Progress& progress) {
  return check_plc(input, gather_plc(input, options, progress), options, progress);
}

}  // namespace ccdt::plc
