#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <vector>

#include "engine/tests/shared/plc_test_solids.h"

/// Measures of surfaces that the tests of remeshing compare.
namespace ccdt::remesh_test {

inline double distance(const Point3& a, const Point3& b) {
  return std::sqrt(squared_length(b - a));
}

inline double area(const InputPlc& plc, const plc_test::Triangle& t) {
  const Point3 &a = plc.vertices[t[0]], &b = plc.vertices[t[1]], &c = plc.vertices[t[2]];
  return 0.5 * std::sqrt(squared_length(cross(b - a, c - a)));
}

/// The area of the triangles of each marker.
inline std::map<int, double> areas(const InputPlc& plc) {
  std::map<int, double> sums;
  for (std::size_t t = 0; t < plc.triangles.size(); ++t)
    sums[plc.triangle_markers.empty() ? 0 : plc.triangle_markers[t]] += area(plc, plc.triangles[t]);
  return sums;
}

/// The length of the input's own segments of each marker.
inline std::map<int, double> segment_lengths(const InputPlc& plc) {
  std::map<int, double> sums;
  for (std::size_t s = 0; s < plc.segments.size(); ++s)
    sums[plc.segment_markers.empty() ? 0 : plc.segment_markers[s]] +=
        distance(plc.vertices[plc.segments[s][0]], plc.vertices[plc.segments[s][1]]);
  return sums;
}

using Edge = std::array<std::uint32_t, 2>;

/// The triangles around each edge.
inline std::map<Edge, std::vector<std::uint32_t>> triangles_at_edges(const InputPlc& plc) {
  std::map<Edge, std::vector<std::uint32_t>> around;
  for (std::uint32_t t = 0; t < plc.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = plc.triangles[t][k], b = plc.triangles[t][(k + 1) % 3];
      around[{std::min(a, b), std::max(a, b)}].push_back(t);
    }
  return around;
}

/// The total length of the edges with n triangles, for each n other than 2.
inline std::map<std::size_t, double> non_manifold_edge_lengths(const InputPlc& plc) {
  std::map<std::size_t, double> sums;
  for (const auto& [edge, triangles] : triangles_at_edges(plc))
    if (triangles.size() != 2) sums[triangles.size()] += distance(plc.vertices[edge[0]], plc.vertices[edge[1]]);
  return sums;
}

/// The total length of the edges where two consistently oriented triangles turn by more than an angle.
inline double sharp_length(const InputPlc& plc, double degrees) {
  const auto normal = [&](std::uint32_t t) {
    const auto& [a, b, c] = plc.triangles[t];
    const Point3 n = cross(plc.vertices[b] - plc.vertices[a], plc.vertices[c] - plc.vertices[a]);
    return (1 / std::sqrt(squared_length(n))) * n;
  };
  double sum = 0;
  for (const auto& [edge, triangles] : triangles_at_edges(plc))
    if (triangles.size() == 2 &&
        dot(normal(triangles[0]), normal(triangles[1])) < std::cos(degrees * std::acos(-1.0) / 180))
      sum += distance(plc.vertices[edge[0]], plc.vertices[edge[1]]);
  return sum;
}

/// The share of edges with 0.7 to 1.4 times a given length.
inline double share_of_good_edges(const InputPlc& plc, double length) {
  double good = 0, all = 0;
  for (const auto& [edge, triangles] : triangles_at_edges(plc)) {
    const double ratio = distance(plc.vertices[edge[0]], plc.vertices[edge[1]]) / length;
    good += ratio >= 0.7 && ratio <= 1.4;
    ++all;
  }
  return good / all;
}

/// The smallest angle of each triangle, in degrees, in ascending order.
inline std::vector<double> smallest_angles(const InputPlc& plc) {
  std::vector<double> smallest;
  for (const auto& t : plc.triangles) {
    double angle = 180;
    for (int k = 0; k < 3; ++k) {
      const Point3 u = plc.vertices[t[(k + 1) % 3]] - plc.vertices[t[k]],
                   v = plc.vertices[t[(k + 2) % 3]] - plc.vertices[t[k]];
      angle = std::min(angle, std::atan2(std::sqrt(squared_length(cross(u, v))), dot(u, v)) * 180 / std::acos(-1.0));
    }
    smallest.push_back(angle);
  }
  std::sort(smallest.begin(), smallest.end());
  return smallest;
}

/// The 1% quantile of the smallest angles, in degrees.
inline double smallest_angle_of_99_percent(const InputPlc& plc) {
  const std::vector<double> smallest = smallest_angles(plc);
  return smallest[smallest.size() / 100];
}

inline double mean_edge_length(const InputPlc& plc) {
  const auto edges = triangles_at_edges(plc);
  double sum = 0;
  for (const auto& [edge, triangles] : edges) sum += distance(plc.vertices[edge[0]], plc.vertices[edge[1]]);
  return sum / static_cast<double>(edges.size());
}

/// The volume of each region; space without a region counts as region 0.
inline std::map<int, double> region_volumes(const plc::Plc& plc) {
  std::map<int, double> sums;
  for (std::uint32_t c = 0; c < plc.regions.size(); ++c)
    if (plc.regions[c].inside) sums[plc.regions[c].attribute] += plc_test::volume(plc, c);
  return sums;
}

template <class Key>
void expect_near(const std::map<Key, double>& a, const std::map<Key, double>& b, double tolerance) {
  ASSERT_EQ(a.size(), b.size());
  for (auto i = a.begin(), j = b.begin(); i != a.end(); ++i, ++j) {
    EXPECT_EQ(i->first, j->first);
    EXPECT_NEAR(i->second, j->second, tolerance) << i->first;
  }
}

}  // namespace ccdt::remesh_test
