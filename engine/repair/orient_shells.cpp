#include "engine/repair/orient_shells.h"

#include <cstdint>
#include <span>
#include <utility>

#include "engine/plc/edge_table.h"

namespace ccdt::repair {
namespace {

enum class Way : std::uint8_t { unknown, as_given, turned };

/// Finds which triangles of a connected part must be turned if the first one stays as it is.
///
/// \return  its triangles
std::vector<std::uint32_t> spread(std::uint32_t first, const plc::EdgeTable& edges, std::vector<Way>& ways) {
  std::vector<std::uint32_t> part = {first};
  ways[first] = Way::as_given;
  for (std::size_t i = 0; i < part.size(); ++i) {
    const std::uint32_t t = part[i];
    for (const std::uint32_t e : edges.edges_of[t]) {
      const std::span<const std::uint32_t> sides = edges.sides_around(e);
      if (sides.size() != 2) continue;
      const std::uint32_t other =
          plc::triangle_of(sides[0]) == t ? plc::triangle_of(sides[1]) : plc::triangle_of(sides[0]);
      if (ways[other] != Way::unknown) continue;
      // Two that face the same way run along their edge in opposite directions.
      const bool agree = plc::is_above(sides[0]) != plc::is_above(sides[1]);
      ways[other] = agree == (ways[t] == Way::as_given) ? Way::as_given : Way::turned;
      part.push_back(other);
    }
  }
  return part;
}

}  // namespace

void orient_shells(plc::UncheckedPlc& soup) {
  const plc::EdgeTable edges = plc::make_edge_table(soup.triangles.corners);
  std::vector<Way> ways(soup.triangles.size(), Way::unknown);
  for (std::uint32_t first = 0; first < soup.triangles.size(); ++first) {
    if (ways[first] != Way::unknown) continue;
    const std::vector<std::uint32_t> part = spread(first, edges, ways);
    double area_of_turned = 0, area = 0;
    for (const std::uint32_t t : part) {
      const double own = length(area_vector(plc::points_of(soup.plc.vertices, soup.triangles.corners[t])));
      area += own;
      if (ways[t] == Way::turned) area_of_turned += own;
    }
    const Way minority = 2 * area_of_turned <= area ? Way::turned : Way::as_given;
    for (const std::uint32_t t : part)
      if (ways[t] == minority) std::swap(soup.triangles.corners[t][1], soup.triangles.corners[t][2]);
  }
}

std::vector<plc::VertexTriple> outward_triangles(const plc::Plc& plc) {
  std::vector<plc::VertexTriple> outward;
  for (const plc::Facet& facet : plc.facets) {
    const bool above = plc.regions[facet.above].inside, below = plc.regions[facet.below].inside;
    if (above == below) continue;
    for (const auto& [a, b, c] : plc.triangles_of(facet))
      outward.push_back(below ? plc::VertexTriple{a, b, c} : plc::VertexTriple{a, c, b});
  }
  return outward;
}

}  // namespace ccdt::repair
