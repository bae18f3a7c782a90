#include "engine/repair/remove_sheets.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <vector>

#include "engine/base/union_find.h"
#include "engine/plc/edge_table.h"
#include "engine/plc/gather_parts.h"
#include "engine/plc/warped_facets.h"

namespace ccdt::repair {
namespace {

/// Of the area of all closed parts: a larger sheet may be what is meant.
constexpr double largest_share = 0.1;

/// A part that is connected by edges.
struct LoosePart {
  std::vector<std::uint32_t> triangles;
  bool is_open = false;
  double area = 0;
};

std::vector<LoosePart> find_parts(const plc::UncheckedPlc& soup) {
  const auto& corners = soup.triangles.corners;
  const plc::EdgeTable edges = plc::make_edge_table(corners);
  UnionFind sets(corners.size());
  for (std::uint32_t e = 0; e < edges.size(); ++e)
    for (const std::uint32_t t : edges.around(e)) sets.join(t, edges.around(e)[0]);
  std::map<std::uint32_t, LoosePart> parts;  // by the first triangle, so in a fixed order
  for (std::uint32_t t = 0; t < corners.size(); ++t) {
    LoosePart& part = parts[sets.find(t)];
    part.triangles.push_back(t);
    part.area += length(area_vector(plc::points_of(soup.plc.vertices, corners[t])));
    part.is_open = part.is_open || std::ranges::any_of(edges.edges_of[t], [&](std::uint32_t e) {
                     return edges.sides_around(e).size() == 1;
                   });
  }
  std::vector<LoosePart> list;
  for (auto& [first, part] : parts) list.push_back(std::move(part));
  return list;
}

}  // namespace

plc::TriangleSet remove_sheets(plc::UncheckedPlc& soup) {
  const std::vector<LoosePart> parts = find_parts(soup);
  double closed_area = 0;
  for (const LoosePart& part : parts)
    if (!part.is_open) closed_area += part.area;
  std::vector<char> is_kept(soup.triangles.size(), 1);
  for (const LoosePart& part : parts)
    if (part.is_open && part.area <= largest_share * closed_area)
      for (const std::uint32_t t : part.triangles) is_kept[t] = 0;
  plc::TriangleSet removed;
  for (std::uint32_t t = 0; t < is_kept.size(); ++t)
    if (is_kept[t] == 0) removed.add(soup.triangles.corners[t], soup.triangles.markers[t], soup.triangles.numbers[t]);
  if (removed.size() > 0) plc::keep_triangles(is_kept, soup.triangles);
  return removed;
}

bool are_flat_sheets(const plc::UncheckedPlc& soup, double tolerance) {
  return std::ranges::all_of(find_parts(soup), [&](const LoosePart& part) {
    if (!part.is_open) return false;
    std::vector<Point3> points;
    for (const std::uint32_t t : part.triangles)
      for (const VertexId v : soup.triangles.corners[t]) points.push_back(soup.plc.vertices[v]);
    return plc::find_plane(points).deviation <= tolerance;
  });
}

}  // namespace ccdt::repair
