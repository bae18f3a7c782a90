#include "engine/plc/input_faults.h"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "engine/base/errors.h"
#include "engine/base/parallel.h"
#include "engine/base/simplex_map.h"
#include "engine/base/sort_in_buckets.h"
#include "engine/base/union_find.h"
#include "engine/geometry/integer_points.h"

namespace ccdt::plc {

namespace {

std::vector<Point3> world_points(const Plc& plc, std::span<const VertexId> vertices) {
  std::vector<Point3> points;
  for (const VertexId v : vertices) points.push_back(plc.world[v]);
  return points;
}

}  // namespace

void throw_input_error(const Plc& plc, const std::string& what, const std::string& remedy,
                       const std::vector<Point3>& world_points, const std::vector<long long>& facets) {
  Place place{.file = plc.name, .facets = facets};
  for (const Point3& p : world_points) place.points.push_back(as_array(p));
  throw InputError(what, place, remedy);
}

std::vector<TrianglePair> find_duplicate_triangles(const Plc& plc, const TriangleSet& triangles) {
  // A face belongs to one triangle, so of two triangles with the same corners, one has none.
  if (std::ranges::find(triangles.faces, no_face) == triangles.faces.end()) return {};
  std::vector<char> may_be_shared(plc.vertices.size(), 0);
  const auto smallest = [](const VertexTriple& t) { return std::min({t[0], t[1], t[2]}); };
  for (std::uint32_t t = 0; t < triangles.size(); ++t)
    if (triangles.faces[t] == no_face) may_be_shared[smallest(triangles.corners[t])] = 1;
  using KeyedTriangle = std::pair<FaceKey, std::uint32_t>;
  std::vector<KeyedTriangle> sorted = parallel_collect<KeyedTriangle>(
      triangles.size(), 4096, [&](std::size_t t, std::size_t end, std::vector<KeyedTriangle>& found) {
        for (; t < end; ++t) {
          const auto& [a, b, c] = triangles.corners[t];
          if (may_be_shared[smallest(triangles.corners[t])])
            found.emplace_back(face_key(a, b, c), static_cast<std::uint32_t>(t));
        }
      });
  sort_in_buckets(sorted, [](const KeyedTriangle& t) { return t.first[0]; });
  std::vector<TrianglePair> pairs;
  for (std::size_t i = 0, first = 0; i < sorted.size(); ++i) {
    if (sorted[i].first != sorted[first].first) first = i;
    if (i != first) pairs.push_back({sorted[first].second, sorted[i].second});
  }
  return pairs;
}

void throw_duplicates(const Plc& plc, const TriangleSet& triangles, std::span<const TrianglePair> pairs) {
  const auto [s, t] = pairs.front();
  throw_input_error(plc, "two facets have the same corners", "remove one of the two",
                    world_points(plc, triangles.corners[s]), {triangles.numbers[s], triangles.numbers[t]});
}

void throw_overlaps(const Plc& plc, const TriangleSet& triangles, const SegmentSet& segments,
                    std::span<const Overlap> pairs, bool at_least) {
  using Between = Overlap::Between;
  const auto numbers_of = [&](const Overlap& o) -> std::vector<long long> {
    if (o.between == Between::segments) return {};
    if (o.between == Between::facet_and_segment) return {triangles.numbers[o.first]};
    return {std::min(triangles.numbers[o.first], triangles.numbers[o.second]),
            std::max(triangles.numbers[o.first], triangles.numbers[o.second])};
  };
  const Overlap& pair = *std::min_element(
      pairs.begin(), pairs.end(), [&](const Overlap& a, const Overlap& b) { return numbers_of(a) < numbers_of(b); });
  const std::vector<long long> facets = numbers_of(pair);
  std::vector<Point3> points = {plc.grid.to_world(pair.where)};
  const auto add_ends = [&](std::uint32_t segment) {
    for (const VertexId v : segments.ends[segment]) points.push_back(plc.world[v]);
  };
  std::string what,
      remedy =
          "cut them along their intersection (a Boolean union in the program that made the model does it), or move "
          "them apart";
  switch (pair.between) {
    case Between::covering_facets:
      what = "two facets cover each other";
      remedy = "remove one of the two, or cut both along their common outline and keep each piece once";
      break;
    case Between::facets:
      what = facets[0] == facets[1] ? "a facet crosses itself" : "two facets cross each other";
      break;
    case Between::facet_and_segment:
      what = "a segment crosses a facet, or lies in it without being an edge of its triangles";
      add_ends(pair.second);
      break;
    case Between::segments:
      what = "two segments cross each other";
      add_ends(pair.first);
      add_ends(pair.second);
      break;
  }
  if (pairs.size() > 1)
    what += std::string("; there are ") + (at_least ? "at least " : "") + std::to_string(pairs.size()) + " such pairs";
  throw_input_error(plc, what, remedy, points, facets);
}

void throw_open_surface(const Plc& plc, const EdgeTable& edges) {
  UnionFind loops(plc.vertices.size());
  for (std::uint32_t e = 0; e < edges.size(); ++e)
    if (edges.around(e).size() == 1) loops.join(edges.ends[e][0], edges.ends[e][1]);
  std::map<std::uint32_t, std::size_t> edge_counts;
  for (std::uint32_t e = 0; e < edges.size(); ++e)
    if (edges.around(e).size() == 1) ++edge_counts[loops.find(edges.ends[e][0])];

  constexpr std::size_t most_loops = 5;
  std::vector<Point3> points;
  std::string lengths;
  for (const auto& [vertex, count] : edge_counts) {
    if (points.size() == most_loops) {
      lengths += ", ...";
      break;
    }
    lengths += (lengths.empty() ? "" : ", ") + std::to_string(count);
    points.push_back(plc.world[vertex]);
  }
  throw_input_error(plc,
                    "the surface is open: it has " + std::to_string(edge_counts.size()) + " boundary loop" +
                        (edge_counts.size() == 1 ? "" : "s") + ", of " + lengths +
                        (lengths == "1" ? " edge" : " edges") + "; a point of each follows",
                    "close the holes, or merge vertices that should be one; an open surface inside a closed one must "
                    "be given as .poly, .smesh or .mesh",
                    points);
}

}  // namespace ccdt::plc
