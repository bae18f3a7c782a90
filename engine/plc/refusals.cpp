#include "engine/plc/refusals.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <vector>

#include "engine/base/errors.h"
#include "engine/base/union_find.h"
#include "engine/plc/quanta.h"

namespace ccdt {

namespace {

constexpr std::size_t told_loops = 5;

std::array<double, 3> world_corner(const Plc& plc, VertexId v) {
  return as_array(plc.world[v]);
}

Place place_of(const Plc& plc) {
  Place place;
  place.file = plc.name;
  return place;
}

std::string counted(std::size_t n, const std::string& thing) {
  return std::to_string(n) + " " + thing + (n == 1 ? "" : "s");
}

}  // namespace

void refuse_degenerate_triangles(const Plc& plc, const TriangleSet& triangles) {
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    const auto [a, b, c] = triangles.corners[t];
    const bool equal = a == b || b == c || c == a;
    if (!equal && rounded_normal(plc.vertices[a], plc.vertices[b], plc.vertices[c]) != Point3{}) continue;
    Place place = place_of(plc);
    place.facets = {triangles.numbers[t]};
    place.points = {world_corner(plc, a), world_corner(plc, b), world_corner(plc, c)};
    throw InputError(
        equal ? "a facet has two corners at the same point" : "the corners of a facet are on one line", place,
        "remove this facet (if its neighbours then leave a gap, merge its vertices in them too), or repair the "
        "surface in the program that made it");
  }
}

void refuse_duplicate_triangles(const Plc& plc, const TriangleSet& triangles) {
  std::vector<Corners> sorted = triangles.corners;
  for (Corners& c : sorted) std::sort(c.begin(), c.end());
  std::vector<std::uint32_t> order(triangles.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t s, std::uint32_t t) { return sorted[s] != sorted[t] ? sorted[s] < sorted[t] : s < t; });
  const auto twin = std::adjacent_find(order.begin(), order.end(),
                                       [&](std::uint32_t s, std::uint32_t t) { return sorted[s] == sorted[t]; });
  if (twin == order.end()) return;
  Place place = place_of(plc);
  place.facets = {triangles.numbers[twin[0]], triangles.numbers[twin[1]]};
  for (const VertexId v : triangles.corners[twin[0]]) place.points.push_back(world_corner(plc, v));
  throw InputError("two facets have the same corners", place, "remove one of the two");
}

void refuse_overlaps(const Plc& plc, const TriangleSet& triangles, const SegmentSet& segments,
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
  Place place = place_of(plc);
  place.facets = numbers_of(pair);
  place.points = {as_array(plc.grid.to_world(pair.where))};
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
      what = place.facets[0] == place.facets[1] ? "a facet crosses itself" : "two facets cross each other";
      break;
    case Between::facet_and_segment:
      what = "a segment crosses a facet, or lies in it without being an edge of its triangles";
      for (const VertexId v : segments.ends[pair.second]) place.points.push_back(world_corner(plc, v));
      break;
    case Between::segments:
      what = "two segments cross each other";
      for (const std::uint32_t s : {pair.first, pair.second})
        for (const VertexId v : segments.ends[s]) place.points.push_back(world_corner(plc, v));
      break;
  }
  if (pairs.size() > 1)
    what += std::string("; there are ") + (at_least ? "at least " : "") + std::to_string(pairs.size()) + " such pairs";
  throw InputError(what, place, remedy);
}

void refuse_open_surface(const Plc& plc, const EdgeTable& edges) {
  UnionFind loops(plc.vertices.size());
  for (std::uint32_t e = 0; e < edges.size(); ++e)
    if (edges.around(e).size() == 1) loops.join(edges.ends[e][0], edges.ends[e][1]);
  std::map<std::uint32_t, std::size_t> edge_counts;
  for (std::uint32_t e = 0; e < edges.size(); ++e)
    if (edges.around(e).size() == 1) ++edge_counts[loops.find(edges.ends[e][0])];

  Place place = place_of(plc);
  std::string lengths;
  for (const auto& [vertex, count] : edge_counts) {
    if (place.points.size() == told_loops) {
      lengths += ", ...";
      break;
    }
    lengths += (lengths.empty() ? "" : ", ") + std::to_string(count);
    place.points.push_back(world_corner(plc, VertexId(vertex)));
  }
  throw InputError("the surface is open: it has " + counted(edge_counts.size(), "boundary loop") + ", of " + lengths +
                       " edges; a point of each follows",
                   place,
                   "close the holes, or merge vertices that should be one; a surface that is meant to be open inside a "
                   "closed one has to "
                   "come as .poly, .smesh or .mesh");
}

}  // namespace ccdt
