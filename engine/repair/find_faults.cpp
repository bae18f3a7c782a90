#include "engine/repair/find_faults.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "engine/base/check_arguments.h"
#include "engine/base/errors.h"
#include "engine/base/simplex_map.h"
#include "engine/plc/build_plc.h"
#include "engine/plc/check_input.h"
#include "engine/plc/connect_parts.h"
#include "engine/plc/gather_parts.h"
#include "engine/plc/input_faults.h"
#include "engine/repair/gather_soup.h"
#include "engine/repair/open_edges.h"
#include "engine/repair/orient_shells.h"

namespace ccdt::repair {
namespace {

using plc::EdgeTable;
using plc::InputPlc;
using plc::Overlap;
using plc::Plc;
using plc::TriangleSet;

constexpr std::string_view check_stage = "check";
constexpr std::uint64_t check_steps = 4;
constexpr std::size_t most_places = 1000;
constexpr std::size_t most_overlaps = 10000;

/// Collects the faults of one kind.
class FaultList {
 public:
  explicit FaultList(FaultKind kind, bool is_error) : fault_{.kind = kind, .is_error = is_error} {}

  template <class MakePlace>
  void add(const MakePlace& make_place) {
    ++fault_.count;
    if (fault_.places.size() < most_places) fault_.places.push_back(make_place());
  }
  void add_to(Diagnosis& diagnosis) && {
    if (fault_.count > 0) diagnosis.faults.push_back(std::move(fault_));
  }
  Fault& fault() { return fault_; }

 private:
  Fault fault_;
};

Place place_at(std::span<const Point3> points, std::vector<long long> facets = {}) {
  Place place{.facets = std::move(facets)};
  for (const Point3& p : points) place.points.push_back(as_array(p));
  return place;
}

Place place_of(const Plc& plc, std::span<const VertexId> vertices, std::vector<long long> facets = {}) {
  std::vector<Point3> points;
  for (const VertexId v : vertices) points.push_back(plc.world[v]);
  return place_at(points, std::move(facets));
}

void find_unusual_file(const InputPlc& input, Diagnosis& diagnosis) {
  if (input.notes.empty()) return;
  Fault fault{.kind = FaultKind::unusual_file, .count = input.notes.size()};
  for (const std::string& note : input.notes) fault.detail += (fault.detail.empty() ? "" : "; ") + note;
  diagnosis.faults.push_back(std::move(fault));
}

bool find_coordinates(const InputPlc& input, Diagnosis& diagnosis) {
  const auto first = std::ranges::find_if_not(input.vertices, is_finite);
  if (first == input.vertices.end()) return false;
  const auto count = input.vertices.end() - first - std::count_if(first, input.vertices.end(), is_finite);
  diagnosis.faults.push_back(
      {.kind = FaultKind::coordinates,
       .is_error = true,
       .count = static_cast<std::uint64_t>(count),
       .detail = "the first is vertex " + std::to_string(first - input.vertices.begin()) + ", counted from 0"});
  return true;
}

bool find_extent(const InputPlc& input, Diagnosis& diagnosis) {
  try {
    plc::check_extent(input);
    return false;
  } catch (const InputError& error) {
    diagnosis.faults.push_back({.kind = FaultKind::extent, .is_error = true, .count = 1, .detail = error.what()});
    return true;
  }
}

void find_vertex_faults(const InputPlc& input, const Plc& plc, Diagnosis& diagnosis) {
  std::vector<char> is_used(input.vertices.size(), 0);
  for (const auto& corners : input.triangles)
    for (const std::uint32_t v : corners) is_used[v] = 1;
  for (const plc::PolygonFacet& facet : input.polygon_facets)
    for (const auto& polygon : facet.polygons)
      for (const std::uint32_t v : polygon) is_used[v] = 1;
  for (const auto& ends : input.segments)
    for (const std::uint32_t v : ends) is_used[v] = 1;
  FaultList equal(FaultKind::equal_vertices, false), unused(FaultKind::unused_vertices, false);
  std::vector<char> is_met(plc.vertices.size(), 0);
  for (std::uint32_t i = 0; i < input.vertices.size(); ++i) {
    const auto place = [&] { return place_at({&input.vertices[i], 1}); };
    if (is_met[plc.vertex_of_input[i]])
      equal.add(place);
    else if (!is_used[i])
      unused.add(place);
    is_met[plc.vertex_of_input[i]] = 1;
  }
  std::move(equal).add_to(diagnosis);
  std::move(unused).add_to(diagnosis);
}

/// The facets that have more triangles than before.
void find_split_facets(const Plc& plc, const TriangleSet& before, const TriangleSet& after, Diagnosis& diagnosis) {
  if (before.size() == after.size()) return;
  std::unordered_map<std::uint32_t, std::int64_t> more;  // by the number of the facet
  for (const std::uint32_t number : before.numbers) --more[number];
  for (const std::uint32_t number : after.numbers) ++more[number];
  FaultList list(FaultKind::split_facets, false);
  for (std::uint32_t t = 0; t < before.size(); ++t)
    if (std::exchange(more[before.numbers[t]], 0) > 0)
      list.add([&] { return place_of(plc, before.corners[t], {before.numbers[t]}); });
  std::move(list).add_to(diagnosis);
}

void find_edge_faults(const Plc& plc, const TriangleSet& triangles, const EdgeTable& edges, bool must_be_closed,
                      Diagnosis& diagnosis) {
  FaultList open(FaultKind::open_edges, must_be_closed), turned(FaultKind::turned_edges, false),
      shared(FaultKind::shared_edges, false);
  const auto facets_at = [&](std::uint32_t e) {
    std::vector<long long> facets;
    for (const std::uint32_t t : edges.around(e)) facets.push_back(triangles.numbers[t]);
    return facets;
  };
  for (std::uint32_t e = 0; e < edges.size(); ++e) {
    const auto around = edges.sides_around(e);
    const auto place = [&] { return place_of(plc, edges.ends[e], facets_at(e)); };
    if (around.size() > 2) shared.add(place);
    if (around.size() == 2 && plc::is_above(around[0]) == plc::is_above(around[1])) turned.add(place);
  }
  const OpenEdges rims = find_open_edges(edges);
  std::size_t open_edges = 0;
  for (const auto& loop : rims.loops) {
    open_edges += loop.size();
    open.add([&] { return place_of(plc, loop); });
  }
  for (const auto& chain : rims.chains) {
    open_edges += chain.size() - 1;
    open.add([&] { return place_of(plc, chain); });
  }
  if (open_edges > 0) open.fault().detail = std::to_string(open_edges) + (open_edges == 1 ? " edge" : " edges");
  for (FaultList* list : {&open, &turned, &shared}) std::move(*list).add_to(diagnosis);
}

void add_overlaps(const Plc& plc, const plc::ConnectedParts& connected, std::span<const Overlap> overlaps,
                  FaultList& list) {
  const auto& triangles = connected.parts.triangles;
  for (const Overlap& o : overlaps)
    list.add([&] {
      std::vector<long long> facets;
      if (o.between != Overlap::Between::segments) facets.push_back(triangles.numbers[o.first]);
      if (o.between == Overlap::Between::facets || o.between == Overlap::Between::covering_facets)
        facets.push_back(triangles.numbers[o.second]);
      std::ranges::sort(facets);
      const Point3 where = plc.grid.to_world(o.where);
      return place_at({&where, 1}, std::move(facets));
    });
  if (overlaps.size() == most_overlaps) list.fault().at_least = true;
}

/// Lists what an examination finds.
class FaultLister : public plc::Examiner {
 public:
  FaultLister(bool is_surface, const Progress& progress, Diagnosis& diagnosis)
      : is_surface_(is_surface), progress_(progress), diagnosis_(diagnosis) {}

  void see_duplicates(const plc::UncheckedPlc& parts, std::span<const plc::TrianglePair> pairs) override {
    const TriangleSet& triangles = parts.triangles;
    FaultList list(FaultKind::duplicate_facets, true);
    for (const auto& [s, t] : pairs)
      list.add([&, s = s, t = t] {
        return place_of(parts.plc, triangles.corners[t], {triangles.numbers[s], triangles.numbers[t]});
      });
    std::move(list).add_to(diagnosis_);
  }
  void see_whole(const plc::UncheckedPlc& parts) override { triangles_ = parts.triangles; }
  void see_conforming(const plc::UncheckedPlc& parts) override {
    const TriangleSet whole = std::exchange(triangles_, parts.triangles);
    find_split_facets(parts.plc, whole, triangles_, diagnosis_);
    report(progress_, check_stage, 2, check_steps);
    find_edge_faults(parts.plc, triangles_, plc::make_edge_table(triangles_.corners), is_surface_, diagnosis_);
  }
  void see_overlaps(const Plc& plc, const plc::ConnectedParts& connected) override {
    FaultList covering(FaultKind::covering_facets, true), crossing(FaultKind::crossing_facets, true),
        segments(FaultKind::crossing_segments, true);
    add_overlaps(plc, connected, connected.overlaps.covering, covering);
    for (const Overlap& o : connected.overlaps.crossing)
      add_overlaps(plc, connected, {&o, 1}, o.between == Overlap::Between::covering_facets ? covering : crossing);
    if (connected.overlaps.crossing.size() == most_overlaps) crossing.fault().at_least = true;
    add_overlaps(plc, connected, connected.overlaps.of_segments, segments);
    for (FaultList* list : {&covering, &crossing, &segments}) std::move(*list).add_to(diagnosis_);
    report(progress_, check_stage, 3, check_steps);
  }

  /// The conforming triangles, oriented as in the file.
  const TriangleSet& triangles() const { return triangles_; }

 private:
  const bool is_surface_;
  const Progress& progress_;
  Diagnosis& diagnosis_;
  TriangleSet triangles_;
};

/// The facets of the file whose normals point into the domain.
///
/// \param outward  triangles between the domain and the rest, with normals that point out of it
/// \param given    triangles as in the file
void find_inward_facets(const Plc& plc, const std::vector<plc::VertexTriple>& outward, const TriangleSet& given,
                        Diagnosis& diagnosis) {
  const FaceMap faces(outward, plc.vertices.size());
  FaultList list(FaultKind::inward_facets, false);
  std::unordered_map<std::uint32_t, bool> is_known;  // by the number of the facet
  for (std::uint32_t i = 0; i < given.size(); ++i) {
    const auto& [a, b, c] = given.corners[i];
    const FaceMap::Found found = faces.find(a, b, c);
    if (found.index == none || !found.faces_the_other_way) continue;
    if (!std::exchange(is_known[given.numbers[i]], true))
      list.add([&] { return place_of(plc, given.corners[i], {given.numbers[i]}); });
  }
  std::move(list).add_to(diagnosis);
}

/// The volume enclosed by triangles that face outward. Far from the origin, products of coordinates would cancel.
double volume_within(const Plc& plc, const std::vector<plc::VertexTriple>& outward) {
  double sixfold = 0;
  const Point3 origin = plc.world.front();
  for (const auto& [a, b, c] : outward)
    sixfold += dot(plc.world[a] - origin, cross(plc.world[b] - origin, plc.world[c] - origin));
  return sixfold / 6;
}

/// Finds what only the finished PLC shows. An error that remains, such as that of a seed, is a fault of the domain.
///
/// \param examined  without other errors
/// \param given     its triangles as the file orients them
void examine_domain(const InputPlc& input, plc::Examined examined, const TriangleSet& given, Diagnosis& diagnosis) {
  try {
    const Plc plc = plc::finish_plc(input, std::move(examined));
    FaultList idle_holes(FaultKind::idle_holes, false);
    for (const Point3& seed : plc.idle_holes) idle_holes.add([&] { return place_at({&seed, 1}); });
    std::move(idle_holes).add_to(diagnosis);
    diagnosis.regions = static_cast<std::uint64_t>(std::ranges::count(plc.regions, true, &plc::Region::inside));
    const std::vector<plc::VertexTriple> outward = outward_triangles(plc);
    diagnosis.volume = volume_within(plc, outward);
    if (input.inside == InputPlc::Inside::even_odd) find_inward_facets(plc, outward, given, diagnosis);
  } catch (const InputError& error) {
    const Place place{.points = error.place().points, .facets = error.place().facets};
    diagnosis.faults.push_back(
        {.kind = FaultKind::domain, .is_error = true, .count = 1, .detail = error.what(), .places = {place}});
  }
}

Diagnosis describe(const InputPlc& input) {
  return {.vertices = input.vertices.size(), .facets = input.facet_count(), .segments = input.segments.size()};
}

}  // namespace

Diagnosis find_faults(const InputPlc& input, double flatness, const Progress& progress) {
  const plc::PlcOptions options{flatness};
  plc::check_input(input);
  check_number("flatness", flatness);
  Diagnosis diagnosis = describe(input);
  find_unusual_file(input, diagnosis);
  report(progress, check_stage, 0, check_steps);
  if (find_coordinates(input, diagnosis) || find_extent(input, diagnosis)) return diagnosis;
  Soup soup;
  try {
    soup = gather_soup(input, options);
  } catch (const InputError& error) {
    diagnosis.faults.push_back({.kind = FaultKind::no_facets, .is_error = true, .count = 1});
    return diagnosis;
  }
  report(progress, check_stage, 1, check_steps);
  FaultList polygons(FaultKind::polygons, true), without_area(FaultKind::facets_without_area, false);
  for (const Place& place : soup.invalid_polygons) polygons.add([&] { return place; });
  for (const std::uint32_t number : soup.without_area) without_area.add([&] { return Place{.facets = {number}}; });
  std::move(polygons).add_to(diagnosis);
  std::move(without_area).add_to(diagnosis);
  if (soup.input.warped.count > 0)
    diagnosis.faults.push_back({.kind = FaultKind::warped_facets, .count = soup.input.warped.count});
  find_vertex_faults(input, soup.parts.plc, diagnosis);

  FaultLister lister(input.inside == InputPlc::Inside::even_odd, progress, diagnosis);
  plc::Examined examined = plc::examine_parts(std::move(soup.parts), options, most_overlaps, lister);
  if (diagnosis.is_valid()) examine_domain(soup.input, std::move(examined), lister.triangles(), diagnosis);
  std::ranges::stable_partition(diagnosis.faults, &Fault::is_error);
  report(progress, check_stage, check_steps, check_steps);
  return diagnosis;
}

}  // namespace ccdt::repair
