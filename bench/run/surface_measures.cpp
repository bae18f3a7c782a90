#include "bench/run/surface_measures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

#include "bench/run/quality.h"
#include "bench/run/statistics.h"

namespace ccdt::bench {
namespace {

constexpr double least_kept_angle = 25;
constexpr double largest_kept_ratio = 2;      ///< of the 95th percentile of the edges to the 5th
constexpr double largest_kept_change = 1.25;  ///< ratio of the median edge to the wanted length, or its inverse

double angle_between(const Point3& a, const Point3& b) {
  return degrees * std::atan2(std::sqrt(squared_length(cross(a, b))), dot(a, b));
}

/// Calls `visit(facet, a, b, c)` for each corner a of each triangle, with the next corners.
template <class Visit>
void for_each_corner(const plc::Plc& plc, Visit visit) {
  for (const plc::Facet& facet : plc.facets)
    for (const auto& t : plc.triangles_of(facet))
      for (std::size_t i = 0; i < 3; ++i) visit(facet, t[i], t[(i + 1) % 3], t[(i + 2) % 3]);
}

/// A triangle at an edge, as seen along the edge from its smaller end to its greater.
struct EdgeTriangle {
  std::array<VertexId, 2> edge;
  VertexId opposite;
  bool inside_ahead = false;  ///< is the domain next to it in the counterclockwise direction?
  double angle = 0;           ///< radians, from the first triangle of the edge
};

std::vector<EdgeTriangle> triangles_at_edges(const plc::Plc& plc) {
  std::vector<EdgeTriangle> triangles;
  for_each_corner(plc, [&](const plc::Facet& facet, VertexId a, VertexId b, VertexId c) {
    // From a to b the normal, which points above, is counterclockwise of the triangle.
    const RegionId ahead = a < b ? facet.above : facet.below;
    triangles.push_back({{std::min(a, b), std::max(a, b)}, c, plc.regions[ahead].inside, 0});
  });
  std::ranges::sort(triangles, {}, &EdgeTriangle::edge);
  return triangles;
}

/// Sorts the triangles of one edge counterclockwise.
template <class Triangles>
void sort_around(const plc::Plc& plc, Triangles triangles) {
  const Point3& a = plc.world[triangles[0].edge[0]];
  const Point3 along = plc.world[triangles[0].edge[1]] - a, axis = 1 / std::sqrt(squared_length(along)) * along;
  const Point3 first = cross(axis, plc.world[triangles[0].opposite] - a), turned = cross(axis, first);
  for (EdgeTriangle& t : triangles) {
    const Point3 normal = cross(axis, plc.world[t.opposite] - a);
    const double angle = std::atan2(dot(normal, turned), dot(normal, first));
    t.angle = angle < 0 ? angle + 2 * std::numbers::pi : angle;
  }
  std::ranges::sort(triangles, {}, &EdgeTriangle::angle);
}

void take_smaller(SurfaceAngle& smallest, double angle, const Point3& at) {
  if (angle < smallest.degrees) smallest = {angle, at};
}

SurfaceAngle smallest_dihedral(const plc::Plc& plc) {
  SurfaceAngle smallest;
  std::vector<EdgeTriangle> triangles = triangles_at_edges(plc);
  for (auto begin = triangles.begin(); begin != triangles.end();) {
    const auto end = std::find_if(begin, triangles.end(), [&](const EdgeTriangle& t) { return t.edge != begin->edge; });
    const std::span around(begin, end);
    sort_around(plc, around);
    for (std::size_t i = 0; i < around.size(); ++i) {
      const bool is_last = i + 1 == around.size();
      const double next = is_last ? around[0].angle + 2 * std::numbers::pi : around[i + 1].angle;
      if (around[i].inside_ahead)
        take_smaller(smallest, degrees * (next - around[i].angle), plc.world[around[i].edge[0]]);
    }
    begin = end;
  }
  return smallest;
}

std::vector<double> edge_lengths(const plc::Plc& plc) {
  std::vector<double> lengths;
  for_each_corner(plc, [&](const plc::Facet&, VertexId a, VertexId b, VertexId) {
    lengths.push_back(std::sqrt(squared_length(plc.world[b] - plc.world[a])));
  });
  return lengths;
}

}  // namespace

double edge_ratio(const plc::InputPlc& plc) {
  double shortest = std::numeric_limits<double>::infinity(), longest = 0;
  const auto add_loop = [&](const auto& loop) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const double length = squared_length(plc.vertices[loop[(i + 1) % loop.size()]] - plc.vertices[loop[i]]);
      if (length <= 0) continue;
      shortest = std::min(shortest, length);
      longest = std::max(longest, length);
    }
  };
  for (const auto& triangle : plc.triangles) add_loop(triangle);
  for (const plc::PolygonFacet& facet : plc.polygon_facets)
    for (const auto& polygon : facet.polygons) add_loop(polygon);
  for (const auto& segment : plc.segments) add_loop(segment);
  return longest > 0 ? std::sqrt(longest / shortest) : 1;
}

SurfaceAngles smallest_angles(const plc::Plc& plc) {
  SurfaceAngles angles;
  for_each_corner(plc, [&](const plc::Facet&, VertexId a, VertexId b, VertexId c) {
    const Point3& corner = plc.world[a];
    take_smaller(angles.planar, angle_between(plc.world[b] - corner, plc.world[c] - corner), corner);
  });
  angles.dihedral = smallest_dihedral(plc);
  return angles;
}

double enclosed_volume(const plc::Plc& plc) {
  double volume = 0;
  for (const plc::Facet& facet : plc.facets) {
    const int sides = static_cast<int>(plc.regions[facet.below].inside) - plc.regions[facet.above].inside;
    if (sides == 0) continue;
    for (const auto& t : plc.triangles_of(facet))
      volume += sides * dot(cross(plc.world[t[0]], plc.world[t[1]]), plc.world[t[2]]) / 6;
  }
  return volume;
}

bool has_even_triangles(const plc::Plc& plc, double edge_length) {
  const std::vector<double> lengths = edge_lengths(plc);
  const double change = median(lengths) / edge_length;
  return std::max(change, 1 / change) <= largest_kept_change &&
         quantile(lengths, 0.95) <= largest_kept_ratio * quantile(lengths, 0.05) &&
         smallest_angles(plc).planar.degrees >= least_kept_angle;
}

double smallest_segment_angle(const plc::Plc& plc) {
  std::vector<std::vector<Point3>> at(plc.vertices.size());
  for (const plc::Segment& s : plc.segments)
    for (int i = 0; i < 2; ++i) at[s.ends[i]].push_back(plc.world[s.ends[1 - i]] - plc.world[s.ends[i]]);
  double smallest = 180;
  for (const auto& directions : at)
    for (std::size_t i = 0; i < directions.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const double sine = std::sqrt(squared_length(cross(directions[i], directions[j])));
        smallest = std::min(smallest, std::atan2(sine, dot(directions[i], directions[j])) * 180 / std::numbers::pi);
      }
  return smallest;
}

}  // namespace ccdt::bench
