#include "engine/plc/warped_facets.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "engine/base/simplex_map.h"
#include "engine/geometry/integer_points.h"
#include "engine/plc/build_plc.h"
#include "engine/plc/gather_parts.h"

namespace ccdt::plc {

namespace {

/// The search takes n^4 steps.
constexpr std::size_t most_corners = 64;

using TriangleCorners = std::array<std::uint32_t, 3>;

/// The defects of a triangulation, the worst first.
struct Cost {
  std::uint32_t faults = 0;  ///< triangles that are folded over, have no area, or equal another facet
  double bend = 0;           ///< of the largest angle between normals; see `bend_between`
  double length = 0;         ///< of all diagonals

  friend bool operator<(const Cost& a, const Cost& b) {
    return std::tie(a.faults, a.bend, a.length) < std::tie(b.faults, b.bend, b.length);
  }
  friend Cost operator+(const Cost& a, const Cost& b) {
    return {a.faults + b.faults, std::max(a.bend, b.bend), a.length + b.length};
  }
};

/// Grows with the angle between two unit normals from 0 to 4, and is precise for small angles.
double bend_between(const Point3& m, const Point3& n) {
  const double squared_sine = squared_length(cross(m, n));
  return dot(m, n) >= 0 ? squared_sine : 4 - squared_sine;
}

/// The triangulation of one polygon that bends least.
///
/// The best triangulation of the part from corner i to corner j, given its triangle ikj at the diagonal ij, consists of
/// that triangle and of the best triangulations of the parts i to k and k to j, which include the bends at the
/// diagonals ik and kj.
class LeastBending {
 public:
  /// \param is_facet  is the triangle of three corners another facet of the input?
  template <class IsFacet>
  LeastBending(std::span<const Point3> corners, const IsFacet& is_facet)
      : corners_(corners),
        n_(static_cast<std::uint32_t>(corners.size())),
        normals_(n_ * n_ * n_),
        own_(n_ * n_ * n_),
        best_(n_ * n_ * n_) {
    Point3 normal;
    for (std::uint32_t i = 1; i + 1 < n_; ++i)
      normal = normal + rounded_normal({corners[0], corners[i], corners[i + 1]});
    for (std::uint32_t i = 0; i < n_; ++i)
      for (std::uint32_t k = i + 1; k < n_; ++k)
        for (std::uint32_t j = k + 1; j < n_; ++j) {
          const Point3 area = rounded_normal({corners[i], corners[k], corners[j]});
          normals_[at(i, k, j)] = normalized(area);
          own_[at(i, k, j)].faults = (dot(area, normal) > 0 ? 0u : 1u) + (is_facet(i, k, j) ? 1u : 0u);
        }
  }

  std::vector<TriangleCorners> find() {
    for (std::uint32_t width = 2; width < n_; ++width)
      for (std::uint32_t i = 0; i + width < n_; ++i)
        for (std::uint32_t k = i + 1; k < i + width; ++k) {
          const std::size_t t = at(i, k, i + width);
          best_[t] = own_[t] + best_part(i, k, t).first + best_part(k, i + width, t).first;
        }
    std::vector<TriangleCorners> triangles;
    collect(0, n_ - 1, best_apex(0, n_ - 1, {}).second, triangles);
    return triangles;
  }

 private:
  std::size_t at(std::uint32_t i, std::uint32_t k, std::uint32_t j) const { return (std::size_t{i} * n_ + k) * n_ + j; }

  /// The best cost of the part from i to j, if the triangle `beyond` is on the other side of ij, and its corner there.
  std::pair<Cost, std::uint32_t> best_part(std::uint32_t i, std::uint32_t j, std::size_t beyond) const {
    if (j == i + 1) return {{}, i};
    auto [cost, apex] = best_apex(i, j, beyond);
    cost.length += length(corners_[j] - corners_[i]);
    return {cost, apex};
  }

  std::pair<Cost, std::uint32_t> best_apex(std::uint32_t i, std::uint32_t j, std::optional<std::size_t> beyond) const {
    std::pair<Cost, std::uint32_t> best;
    for (std::uint32_t k = i + 1; k < j; ++k) {
      Cost cost = best_[at(i, k, j)];
      if (beyond) cost.bend = std::max(cost.bend, bend_between(normals_[*beyond], normals_[at(i, k, j)]));
      if (k == i + 1 || cost < best.first) best = {cost, k};
    }
    return best;
  }

  void collect(std::uint32_t i, std::uint32_t j, std::uint32_t k, std::vector<TriangleCorners>& triangles) const {
    triangles.push_back({i, k, j});
    const std::size_t t = at(i, k, j);
    if (k > i + 1) collect(i, k, best_part(i, k, t).second, triangles);
    if (j > k + 1) collect(k, j, best_part(k, j, t).second, triangles);
  }

  std::span<const Point3> corners_;
  std::uint32_t n_;
  std::vector<Point3> normals_;  // of length one
  std::vector<Cost> own_, best_;
};

/// Replaces the warped facets of an input by triangles.
class WarpedFacets {
 public:
  explicit WarpedFacets(const InputPlc& input) : given_(input) {
    snap_vertices(input, plc_);
    tolerance_ = tolerance_of(plc_, PlcOptions{}.flatness);
  }

  std::optional<InputPlc> triangulate() {
    const auto first = std::ranges::find_if(given_.polygon_facets, [&](const auto& facet) { return is_warped(facet); });
    if (first == given_.polygon_facets.end()) return {};
    input_ = given_;
    input_.polygon_facets.clear();
    for (const auto& [a, b, c] : given_.triangles) triangles_.push_back(key_of(a, b, c));
    std::sort(triangles_.begin(), triangles_.end());
    InputPlc by_projection;
    by_projection.inside = given_.inside;
    for (const PolygonFacet& facet : given_.polygon_facets) {
      if (!is_warped(facet)) {
        input_.polygon_facets.push_back(facet);
        continue;
      }
      ++input_.warped.count;
      input_.warped.largest_deviation = std::max(input_.warped.largest_deviation, deviation_of(facet) * plc_.grid.unit);
      const std::vector<std::uint32_t> corners = corners_of(facet.polygons[0]);
      if (is_one_loop(facet) && corners.size() <= most_corners)
        bend_least(corners, facet);
      else
        by_projection.polygon_facets.push_back(facet);
    }
    project(by_projection);
    return std::move(input_);
  }

 private:
  bool is_warped(const PolygonFacet& facet) const {
    if (deviation_of(facet) <= tolerance_) return false;
    return !is_one_loop(facet) || !meets_a_vertex_twice(corners_of(facet.polygons[0]));
  }

  double deviation_of(const PolygonFacet& facet) const {
    std::vector<Point3> points;
    for (const auto& polygon : facet.polygons)
      for (const std::uint32_t v : polygon) points.push_back(plc_.vertices[plc_.vertex_of_input[v]]);
    return points.size() < 4 ? 0 : find_plane(points).deviation;
  }

  /// The distinct corners.
  std::vector<std::uint32_t> corners_of(const std::vector<std::uint32_t>& polygon) const {
    std::vector<std::uint32_t> corners = polygon;
    const auto same = [&](std::uint32_t a, std::uint32_t b) {
      return plc_.vertex_of_input[a] == plc_.vertex_of_input[b];
    };
    corners.erase(std::unique(corners.begin(), corners.end(), same), corners.end());
    while (corners.size() > 1 && same(corners.front(), corners.back())) corners.pop_back();
    return corners;
  }

  bool meets_a_vertex_twice(const std::vector<std::uint32_t>& corners) const {
    std::set<VertexId> met;
    for (const std::uint32_t c : corners)
      if (!met.insert(plc_.vertex_of_input[c]).second) return true;
    return false;
  }

  void bend_least(const std::vector<std::uint32_t>& corners, const PolygonFacet& facet) {
    std::vector<Point3> points;
    for (const std::uint32_t c : corners) points.push_back(plc_.vertices[plc_.vertex_of_input[c]]);
    LeastBending search(points, [&](std::uint32_t i, std::uint32_t k, std::uint32_t j) {
      return std::binary_search(triangles_.begin(), triangles_.end(), key_of(corners[i], corners[k], corners[j]));
    });
    for (const auto& [i, k, j] : search.find()) add({corners[i], corners[k], corners[j]}, facet.marker, facet.number);
  }

  FaceKey key_of(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    return face_key(plc_.vertex_of_input[a], plc_.vertex_of_input[b], plc_.vertex_of_input[c]);
  }

  void project(const InputPlc& facets) {
    if (facets.polygon_facets.empty()) return;
    TriangleSet triangles;
    SegmentSet segments;
    triangulate_polygons(facets, plc_, HUGE_VAL, triangles, segments);
    std::vector<std::uint32_t> input_of(plc_.vertices.size());
    for (std::uint32_t i = static_cast<std::uint32_t>(input_.vertices.size()); i-- > 0;)
      input_of[plc_.vertex_of_input[i]] = i;
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
      const auto& [a, b, c] = triangles.corners[t];
      add({input_of[a], input_of[b], input_of[c]}, triangles.markers[t], triangles.numbers[t]);
    }
    for (std::uint32_t s = 0; s < segments.size(); ++s) {
      if (!input_.segment_markers.empty()) input_.segment_markers.push_back(segments.markers[s]);
      input_.segments.push_back({input_of[segments.ends[s][0]], input_of[segments.ends[s][1]]});
    }
  }

  void add(const TriangleCorners& corners, int marker, std::uint32_t number) {
    const std::size_t count = input_.triangles.size();
    if (input_.triangle_numbers.empty()) {
      input_.triangle_numbers.resize(count);
      std::iota(input_.triangle_numbers.begin(), input_.triangle_numbers.end(), 0u);
    }
    if (marker != 0 || !input_.triangle_markers.empty()) {
      input_.triangle_markers.resize(count, 0);
      input_.triangle_markers.push_back(marker);
    }
    input_.triangles.push_back(corners);
    input_.triangle_numbers.push_back(number);
  }

  const InputPlc& given_;
  InputPlc input_;                  // the new one
  Plc plc_;                         // the vertices of both
  double tolerance_ = 0;            // in grid units
  std::vector<FaceKey> triangles_;  // of the given input, sorted
};

}  // namespace

FacetPlane find_plane(std::span<const Point3> points) {
  const auto farthest = [&](const auto& measure) {
    return *std::max_element(points.begin(), points.end(),
                             [&](const Point3& p, const Point3& q) { return measure(p) < measure(q); });
  };
  const Point3 a = points.front();
  const Point3 b = farthest([&](const Point3& p) { return squared_length(p - a); });
  const Point3 c = farthest([&](const Point3& p) { return squared_length(rounded_normal({a, b, p})); });
  FacetPlane plane{.normal = rounded_normal({a, b, c})};
  if (plane.normal == Point3{}) return plane;
  double low = 0, high = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double distance = dot(plane.normal, points[i] - a) / length(plane.normal);
    if (std::fabs(distance) > std::max(-low, high)) plane.farthest = i;
    low = std::min(low, distance);
    high = std::max(high, distance);
  }
  plane.deviation = 0.5 * (high - low);
  return plane;
}

std::optional<InputPlc> triangulate_warped_facets(const InputPlc& input) {
  if (input.polygon_facets.empty()) return {};
  return WarpedFacets(input).triangulate();
}

}  // namespace ccdt::plc
