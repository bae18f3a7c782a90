#include "engine/surface/wide_bends.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "engine/base/portable_math.h"

namespace ccdt::surface {
namespace {

double edge_length(const BentSurface& surface, std::uint32_t e) {
  const auto [a, b] = surface.edges.ends[e];
  return length(surface.points[b] - surface.points[a]);
}

/// The angle between the normals at an edge of two triangles, if both are turned to the same side.
double turn_at(const BentSurface& surface, std::uint32_t edge) {
  const auto around = surface.edges.around(edge);
  const double sign = oriented_alike(surface, edge) ? 1 : -1;
  const Point3 one = surface.normals[around[0]], other = sign * surface.normals[around[1]];
  return 2 * portable::angle_of(length(one + other), length(one - other));
}

/// Twice the area of each facet over its perimeter: the width of a long strip.
std::vector<double> widths_of_facets(const BentSurface& surface) {
  const std::size_t count = surface.facet_of.empty() ? 0 : 1 + std::ranges::max(surface.facet_of);
  std::vector<double> widths(count, 0), borders(count, 0);
  for (std::uint32_t e = 0; e < surface.edges.size(); ++e) {
    const auto around = surface.edges.around(e);
    if (around.size() == 2 && surface.facet_of[around[0]] == surface.facet_of[around[1]]) continue;
    for (const std::uint32_t t : around) borders[surface.facet_of[t]] += edge_length(surface, e);
  }
  for (std::uint32_t t = 0; t < surface.corners.size(); ++t) {
    const std::uint32_t f = surface.facet_of[t];
    widths[f] += length(area_vector(plc::points_of(surface.points, surface.corners[t]))) / borders[f];
  }
  return widths;
}

/// A wedge between two features.
struct NarrowWedge {
  VertexId point;
  double angle = 0;
  std::vector<std::uint32_t> features = {};  ///< edges
};

/// The wedges between two features that are narrower than an angle.
std::vector<NarrowWedge> narrow_wedges(const BentSurface& surface, std::span<const std::array<std::uint32_t, 3>> wedges,
                                       std::span<const char> is_feature) {
  const double least_angle = to_radians(20);
  std::vector<NarrowWedge> all(3 * surface.corners.size());
  for (std::uint32_t t = 0; t < surface.corners.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& c = surface.corners[t];
      const VertexId v = c[k], next = c[(k + 1) % 3], last = c[(k + 2) % 3];
      NarrowWedge& wedge = all[wedges[t][k]];
      wedge.point = v;
      wedge.angle += angle_at(surface.points[v], surface.points[next], surface.points[last]);
      for (const std::uint32_t e : surface.edges.edges_of[t])
        if (is_feature[e] && std::ranges::find(surface.edges.ends[e], v) != surface.edges.ends[e].end())
          wedge.features.push_back(e);
    }
  std::erase_if(all, [&](const NarrowWedge& w) { return w.features.size() != 2 || w.angle >= least_angle; });
  return all;
}

}  // namespace

bool oriented_alike(const BentSurface& surface, std::uint32_t edge) {
  const auto around = surface.edges.around(edge);
  const auto [a, b] = surface.edges.ends[edge];
  return plc::runs_along(surface.corners[around[0]], a, b) != plc::runs_along(surface.corners[around[1]], a, b);
}

std::vector<double> turns_of_wide_bends(const BentSurface& surface, std::span<const char> is_feature,
                                        double deviation) {
  const std::vector<double> widths = widths_of_facets(surface);
  std::vector<double> turns(surface.edges.size(), 0);
  for (std::uint32_t e = 0; e < surface.edges.size(); ++e) {
    if (is_feature[e]) continue;
    const auto around = surface.edges.around(e);
    if (surface.facet_of[around[0]] == surface.facet_of[around[1]]) continue;
    const double width = std::min(widths[surface.facet_of[around[0]]], widths[surface.facet_of[around[1]]]);
    const double turn = turn_at(surface, e);
    if (width * turn > deviation) turns[e] = turn;
  }
  return turns;
}

std::vector<WideBend> trim_in_narrow_wedges(const BentSurface& surface,
                                            std::span<const std::array<std::uint32_t, 3>> wedges,
                                            std::span<const char> is_feature, std::span<const double> turns,
                                            double deviation) {
  std::vector<std::array<double, 2>> cuts(surface.edges.size(), {0, 0});  // lengths from both ends that are not kept
  for (const NarrowWedge& wedge : narrow_wedges(surface, wedges, is_feature)) {
    const std::uint32_t e = wedge.features[0], f = wedge.features[1];
    const std::uint32_t bend = turns[e] == 0 || (turns[f] > 0 && turns[f] < turns[e]) ? f : e;
    if (turns[bend] == 0) continue;
    double& cut = cuts[bend][surface.edges.ends[bend][0] == wedge.point ? 0 : 1];
    cut = std::max(cut, deviation / turns[bend] / portable::sine(wedge.angle));
  }
  std::vector<WideBend> bends;
  constexpr double least_share = 0.2;  // of an edge: less is not worth a new vertex
  constexpr double least_cut = 1e-5;   // of an edge: less would need many tiny triangles
  for (std::uint32_t e = 0; e < turns.size(); ++e) {
    if (turns[e] == 0) continue;
    const double size = edge_length(surface, e);
    const auto share_of = [&](double cut) { return cut < least_cut * size ? 0 : cut / size; };
    double from = share_of(cuts[e][0]), to = 1 - share_of(cuts[e][1]);
    if (to - from < least_share) from = 1, to = 0;
    bends.push_back({surface.edges.ends[e], from, to, 4 * deviation / turns[e]});
  }
  return bends;
}

}  // namespace ccdt::surface
