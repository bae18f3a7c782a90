#include "engine/plc/find_repeats.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <string>
#include <tuple>
#include <utility>

#include "engine/base/errors.h"
#include "engine/plc/period.h"

namespace ccdt::plc {
namespace {

/// A point of the period, and a direction from there: equal for what repeats each other on the same sides.
using PlaceInPeriod = std::array<double, 6>;

template <class Item>
struct OnSide {
  PlaceInPeriod place;
  unsigned sides;  ///< see `Period::sides_of`
  VertexId at;     ///< one of its vertices, for messages
  Item item;
};

[[noreturn]] void throw_sides_differ(const Plc& plc, unsigned sides, VertexId at, const std::string& what) {
  const std::string axis(1, "xyz"[std::countr_zero(sides)]);
  const Point3& p = plc.world[at];
  throw InputError(
      "the sides of least and greatest " + axis + " differ: " + what + " here is not on both",
      {.file = plc.name, .points = {{p.x, p.y, p.z}}},
      "give opposite sides the same vertices, edges between facets, and markers in the same places, or mesh without "
      "--periodic");
}

/// Puts the items at the same place together: one on each side, that is two for each axis.
template <class Item>
std::vector<std::vector<Item>> put_together(const Plc& plc, std::vector<OnSide<Item>> all, const std::string& what) {
  const auto key = [](const OnSide<Item>& item) { return std::tie(item.sides, item.place); };
  std::ranges::stable_sort(all, {}, key);
  std::vector<std::vector<Item>> lists;
  for (std::size_t i = 0; i < all.size();) {
    const std::size_t first = i;
    lists.emplace_back();
    for (; i < all.size() && key(all[i]) == key(all[first]); ++i) lists.back().push_back(all[i].item);
    if (lists.back().size() != std::size_t{1} << std::popcount(all[first].sides))
      throw_sides_differ(plc, all[first].sides, all[first].at, what);
  }
  return lists;
}

class RepeatFinder {
 public:
  explicit RepeatFinder(const Plc& plc) : plc_(plc), period_(period_of(plc.vertices, plc.periodicity)) {}

  std::vector<std::vector<VertexId>> vertices() const {
    std::vector<OnSide<VertexId>> all;
    for (std::uint32_t v = 0; v < plc_.vertices.size(); ++v)
      if (const unsigned sides = period_.sides_of({&plc_.vertices[v], 1}); sides != 0)
        all.push_back({place_of(VertexId(v), {}), sides, VertexId(v), VertexId(v)});
    return put_together(plc_, std::move(all), "the vertex");
  }

  std::vector<std::vector<RepeatedSegment>> segments() const {
    std::vector<OnSide<RepeatedSegment>> all;
    for (std::uint32_t s = 0; s < plc_.segments.size(); ++s) {
      const auto& [a, b] = plc_.segments[s].ends;
      const std::array<Point3, 2> ends = {plc_.vertices[a], plc_.vertices[b]};
      const unsigned sides = period_.sides_of(ends);
      if (sides == 0) continue;
      const bool turned = std::tie(ends[1].x, ends[1].y, ends[1].z) < std::tie(ends[0].x, ends[0].y, ends[0].z);
      all.push_back({turned ? place_of(b, ends[0] - ends[1]) : place_of(a, ends[1] - ends[0]), sides, a, {s, turned}});
    }
    return put_together(plc_, std::move(all), "the edge between facets");
  }

  std::vector<std::array<FacetId, 2>> facets() const {
    std::vector<OnSide<FacetId>> all;
    for (std::uint32_t f = 0; f < plc_.facets.size(); ++f) {
      const auto triangles = plc_.triangles_of(plc_.facets[f]);
      const auto& [a, b, c] = triangles[0];
      const unsigned sides = period_.sides_of(std::array{plc_.vertices[a], plc_.vertices[b], plc_.vertices[c]});
      if (sides != 0) all.push_back({least_place(triangles), sides, a, FacetId(f)});
    }
    std::vector<std::array<FacetId, 2>> pairs;
    for (const std::vector<FacetId>& pair : put_together(plc_, std::move(all), "the facet"))
      pairs.push_back({pair[0], pair[1]});
    return pairs;
  }

 private:
  PlaceInPeriod place_of(VertexId v, const Point3& along) const {
    const Point3 p = period_.folded(plc_.vertices[v]);
    return {p.x, p.y, p.z, along.x, along.y, along.z};
  }

  /// The least place of an edge that bounds a facet on a side of the box. Seen from high coordinates, the facet is on
  /// the left of its edges, so no two facets on a side have the same one.
  PlaceInPeriod least_place(std::span<const std::array<VertexId, 3>> triangles) const {
    const auto& [a, b, c] = triangles[0];
    const Point3 normal = area_vector({plc_.vertices[a], plc_.vertices[b], plc_.vertices[c]});
    const bool is_above = normal.x + normal.y + normal.z > 0;  // two of them are zero
    std::vector<std::array<VertexId, 2>> edges;
    for (const auto& t : triangles)
      for (int i = 0; i < 3; ++i)
        edges.push_back(is_above ? std::array{t[i], t[(i + 1) % 3]} : std::array{t[(i + 1) % 3], t[i]});
    std::ranges::sort(edges);
    PlaceInPeriod least = {HUGE_VAL};
    for (const auto& [from, to] : edges)
      if (!std::ranges::binary_search(edges, std::array{to, from}))
        least = std::min(least, place_of(from, plc_.vertices[to] - plc_.vertices[from]));
    return least;
  }

  const Plc& plc_;
  Period period_;
};

}  // namespace

Repeats find_repeats(const Plc& plc) {
  if (plc.periodicity == Periodicity::none) return {};
  const RepeatFinder finder(plc);
  return {finder.vertices(), finder.segments(), finder.facets()};
}

}  // namespace ccdt::plc
