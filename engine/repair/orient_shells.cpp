#include "engine/repair/orient_shells.h"

#include <algorithm>
#include <array>
#include <cmath>
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

/// A part without open edges, and without edges of more than two triangles.
struct ClosedPart {
  std::vector<std::uint32_t> triangles;
  double volume;  ///< negative if the normals point inward
};

std::vector<ClosedPart> find_closed_parts(const OrientedSurface& surface) {
  const auto& [points, triangles] = surface;
  const plc::EdgeTable edges = plc::make_edge_table(triangles);
  std::vector<Way> ways(triangles.size(), Way::unknown);
  std::vector<ClosedPart> parts;
  const auto is_whole = [&](std::uint32_t t) {
    return std::ranges::all_of(edges.edges_of[t], [&](std::uint32_t e) { return edges.sides_around(e).size() == 2; });
  };
  for (std::uint32_t first = 0; first < triangles.size(); ++first) {
    if (ways[first] != Way::unknown) continue;
    ClosedPart part{spread(first, edges, ways), 0};
    if (!std::ranges::all_of(part.triangles, is_whole)) continue;
    const Point3& origin = points[triangles[first][0]];
    for (const std::uint32_t t : part.triangles) {
      const auto [a, b, c] = plc::points_of(points, triangles[t]);
      part.volume += dot(a - origin, cross(b - origin, c - origin)) / 6;
    }
    parts.push_back(std::move(part));
  }
  return parts;
}

/// Is one of a part's outermost vertices outside all other triangles?
bool sticks_out(const ClosedPart& part, const OrientedSurface& surface) {
  const auto& [points, triangles] = surface;
  std::vector<bool> is_own(triangles.size(), false);
  std::array<Point3, 6> outermost;
  outermost.fill(points[triangles[part.triangles[0]][0]]);
  for (const std::uint32_t t : part.triangles) {
    is_own[t] = true;
    for (const VertexId v : triangles[t])
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto before = [&](const Point3& a, const Point3& b) { return as_array(a)[axis] < as_array(b)[axis]; };
        outermost[axis] = std::min(outermost[axis], points[v], before);
        outermost[3 + axis] = std::max(outermost[3 + axis], points[v], before);
      }
  }
  OrientedSurface others{points, {}};
  for (std::uint32_t t = 0; t < triangles.size(); ++t)
    if (!is_own[t]) others.triangles.push_back(triangles[t]);
  return std::ranges::any_of(outermost, [&](const Point3& p) { return std::fabs(winding_number(p, others)) < 0.5; });
}

}  // namespace

void turn_parts_outward(OrientedSurface& surface) {
  std::vector<ClosedPart> parts = find_closed_parts(surface);
  const auto turn = [&](ClosedPart& part) {
    part.volume = -part.volume;
    for (const std::uint32_t t : part.triangles) std::swap(surface.triangles[t][1], surface.triangles[t][2]);
  };
  double volume = 0;
  for (const ClosedPart& part : parts) volume += part.volume;
  if (volume < 0) std::ranges::for_each(parts, turn);
  for (ClosedPart& part : parts)
    if (part.volume < 0 && sticks_out(part, surface)) turn(part);
}

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
