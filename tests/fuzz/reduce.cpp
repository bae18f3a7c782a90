#include <algorithm>
#include <functional>
#include <utility>

#include "tests/fuzz/prove.h"

namespace ccdt::fuzz {

namespace {

using IsInteresting = std::function<bool(const InputPlc&)>;

/// The input without the elements of one list from `first` on, `count` of them.
template <class List>
InputPlc without(InputPlc input, List InputPlc::*list, std::size_t first, std::size_t count) {
  auto& elements = input.*list;
  const auto from = elements.begin() + static_cast<std::ptrdiff_t>(first);
  elements.erase(from, from + static_cast<std::ptrdiff_t>(std::min(count, elements.size() - first)));
  return input;
}

/// Removes halves of a list, then smaller and smaller parts.
template <class List>
bool shorten(List InputPlc::*list, const IsInteresting& is_interesting, InputPlc& input) {
  bool shortened = false;
  for (std::size_t count = ((input.*list).size() + 1) / 2; count > 0; count /= 2)
    for (std::size_t first = 0; first < (input.*list).size();) {
      InputPlc less = without(input, list, first, count);
      if (is_interesting(less)) {
        input = std::move(less);
        shortened = true;
      } else {
        first += count;
      }
    }
  return shortened;
}

/// Removes segments and vertices that are drawn in facets.
bool clear_facets(const IsInteresting& is_interesting, InputPlc& input) {
  bool cleared = false;
  for (std::size_t f = 0; f < input.polygon_facets.size(); ++f)
    for (std::size_t k = input.polygon_facets[f].polygons.size(); k-- > 1;) {
      InputPlc less = input;
      auto& polygons = less.polygon_facets[f].polygons;
      polygons.erase(polygons.begin() + static_cast<std::ptrdiff_t>(k));
      if (!is_interesting(less)) continue;
      input = std::move(less);
      cleared = true;
    }
  return cleared;
}

template <class Visit>
void for_each_corner(InputPlc& input, const Visit& visit) {
  for (auto& triangle : input.triangles)
    for (std::uint32_t& v : triangle) visit(v);
  for (PolygonFacet& facet : input.polygon_facets)
    for (auto& polygon : facet.polygons)
      for (std::uint32_t& v : polygon) visit(v);
  for (auto& segment : input.segments)
    for (std::uint32_t& v : segment) visit(v);
}

/// Removes unused vertices one by one.
bool drop_vertices(const IsInteresting& is_interesting, InputPlc& input) {
  bool dropped = false;
  for (std::uint32_t v = static_cast<std::uint32_t>(input.vertices.size()); v-- > 0;) {
    InputPlc less = input;
    bool is_used = false;
    for_each_corner(less, [&](std::uint32_t& corner) {
      is_used = is_used || corner == v;
      if (corner > v) --corner;
    });
    if (is_used) continue;
    less.vertices.erase(less.vertices.begin() + v);
    if (!is_interesting(less)) continue;
    input = std::move(less);
    dropped = true;
  }
  return dropped;
}

}  // namespace

InputPlc reduce(InputPlc input, const IsInteresting& is_interesting) {
  bool smaller = true;
  while (smaller) {
    smaller = shorten(&InputPlc::polygon_facets, is_interesting, input);
    smaller = shorten(&InputPlc::segments, is_interesting, input) || smaller;
    smaller = shorten(&InputPlc::holes, is_interesting, input) || smaller;
    smaller = shorten(&InputPlc::regions, is_interesting, input) || smaller;
    smaller = clear_facets(is_interesting, input) || smaller;
    smaller = drop_vertices(is_interesting, input) || smaller;
  }
  return input;
}

}  // namespace ccdt::fuzz
