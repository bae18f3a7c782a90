#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "engine/plc/build_plc.h"

namespace ccdt::plc_test {

using Triangle = std::array<std::uint32_t, 3>;

/// Appends the triangles and vertices of another input; they share nothing yet.
inline void append(plc::InputPlc& to, const plc::InputPlc& from) {
  const auto offset = static_cast<std::uint32_t>(to.vertices.size());
  to.vertices.insert(to.vertices.end(), from.vertices.begin(), from.vertices.end());
  if (!to.triangle_markers.empty() || !from.triangle_markers.empty()) {
    to.triangle_markers.resize(to.triangles.size(), 0);
    to.triangle_markers.insert(to.triangle_markers.end(), from.triangle_markers.begin(), from.triangle_markers.end());
    to.triangle_markers.resize(to.triangles.size() + from.triangles.size(), 0);
  }
  for (const auto& [a, b, c] : from.triangles) to.triangles.push_back({a + offset, b + offset, c + offset});
}

/// A flat polygon, given by its corners in order, as a fan.
inline void append_fan(plc::InputPlc& plc, const std::vector<std::uint32_t>& corners) {
  for (std::size_t i = 2; i < corners.size(); ++i) plc.triangles.push_back({corners[0], corners[i - 1], corners[i]});
}

/// An axis-parallel box of 12 triangles, oriented outward. Its vertices are numbered x + 2y + 4z.
inline plc::InputPlc box(const Point3& low, const Point3& high) {
  plc::InputPlc plc;
  plc.name = "box";
  for (int i = 0; i < 8; ++i)
    plc.vertices.push_back({i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z});
  for (const auto& q : std::vector<std::array<std::uint32_t, 4>>{
           {0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}})
    append_fan(plc, {q[0], q[1], q[2], q[3]});
  return plc;
}

inline plc::InputPlc unit_cube() {
  return box({0, 0, 0}, {1, 1, 1});
}

/// A unit cube with n x n squares on each face; faces do not share their vertices.
inline plc::InputPlc gridded_cube(std::uint32_t n) {
  plc::InputPlc plc;
  plc.name = "gridded cube";
  for (int axis = 0; axis < 3; ++axis)
    for (int end = 0; end < 2; ++end) {
      const auto first = static_cast<std::uint32_t>(plc.vertices.size());
      for (std::uint32_t i = 0; i <= n; ++i)
        for (std::uint32_t j = 0; j <= n; ++j) {
          std::array<double, 3> p{};
          p[axis] = end;
          p[(axis + 1) % 3] = double(i) / n;
          p[(axis + 2) % 3] = double(j) / n;
          plc.vertices.push_back({p[0], p[1], p[2]});
        }
      for (std::uint32_t i = 0; i < n; ++i)
        for (std::uint32_t j = 0; j < n; ++j) {
          const std::uint32_t v = first + i * (n + 1) + j;
          std::vector<std::uint32_t> square = {v, v + n + 1, v + n + 2, v + 1};
          if (end == 0) std::swap(square[1], square[3]);
          append_fan(plc, square);
        }
    }
  return plc;
}

/// The prism between z = 0 and z = 1 over a polygon in the xy plane, which is counterclockwise. Its first corner sees
/// all others.
inline plc::InputPlc prism(const std::vector<std::array<double, 2>>& polygon) {
  plc::InputPlc plc;
  plc.name = "prism";
  const auto n = static_cast<std::uint32_t>(polygon.size());
  for (const double z : {0.0, 1.0})
    for (const auto& [x, y] : polygon) plc.vertices.push_back({x, y, z});
  std::vector<std::uint32_t> bottom, top;
  for (std::uint32_t i = 0; i < n; ++i) {
    bottom.push_back((n - i) % n);
    top.push_back(n + i);
    append_fan(plc, {i, (i + 1) % n, n + (i + 1) % n, n + i});
  }
  append_fan(plc, bottom);
  append_fan(plc, top);
  return plc;
}

/// An L: its reflex edge is from vertex 0 to vertex 6.
inline plc::InputPlc l_shape() {
  return prism({{1, 1}, {1, 2}, {0, 2}, {0, 0}, {2, 0}, {2, 1}});
}

/// Schoenhardt's twisted prism: its three reflex edges hinder any tetrahedralization without Steiner vertices.
inline plc::InputPlc schoenhardt() {
  plc::InputPlc plc;
  plc.name = "schoenhardt";
  const double twist = std::acos(-1.0) / 6;
  for (int k = 0; k < 6; ++k) {
    const double angle = 4 * twist * (k % 3) + (k < 3 ? 0 : twist);
    plc.vertices.push_back({std::cos(angle), std::sin(angle), k < 3 ? 0.0 : 1.0});
  }
  plc.triangles = {{0, 2, 1}, {3, 4, 5}};
  for (std::uint32_t k = 0; k < 3; ++k) {
    const std::uint32_t l = (k + 1) % 3;
    plc.triangles.push_back({k, l, 3 + l});
    plc.triangles.push_back({k, 3 + l, 3 + k});
  }
  return plc;
}

using Matrix = std::array<std::array<double, 3>, 3>;

/// The rotation of a quaternion, which need not be of unit length.
inline Matrix rotation(double w, double x, double y, double z) {
  const double s = 2 / (w * w + x * x + y * y + z * z);
  return {{{1 - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y)},
           {s * (x * y + w * z), 1 - s * (x * x + z * z), s * (y * z - w * x)},
           {s * (x * z - w * y), s * (y * z + w * x), 1 - s * (x * x + y * y)}}};
}

inline const Matrix arbitrary = rotation(0.31, -0.74, 0.52, 0.29);

inline Point3 rotated(const Matrix& m, const Point3& p) {
  const auto row = [&](int i) { return m[i][0] * p.x + m[i][1] * p.y + m[i][2] * p.z; };
  return {row(0), row(1), row(2)};
}

inline plc::InputPlc rotated(const Matrix& m, plc::InputPlc plc) {
  for (Point3& p : plc.vertices) p = rotated(m, p);
  for (Point3& p : plc.holes) p = rotated(m, p);
  for (auto& region : plc.regions) region.seed = rotated(m, region.seed);
  return plc;
}

/// Segments by their ends, the smaller first.
inline std::set<std::array<std::uint32_t, 2>> segment_ends(const plc::Plc& plc, bool grazeable_only = false) {
  std::set<std::array<std::uint32_t, 2>> ends;
  for (const plc::Segment& s : plc.segments)
    if (s.grazeable || !grazeable_only) ends.insert({std::min(s.ends[0], s.ends[1]), std::max(s.ends[0], s.ends[1])});
  return ends;
}

inline std::size_t grazeable_count(const plc::Plc& plc) {
  return segment_ends(plc, true).size();
}

inline std::size_t inside_count(const plc::Plc& plc) {
  std::size_t n = 0;
  for (const plc::Region& c : plc.regions) n += c.inside;
  return n;
}

/// The volume of a region in the units of the input, by the divergence theorem over its facets; negative for an
/// infinite region.
inline double volume(const plc::Plc& plc, std::uint32_t region) {
  double sixfold = 0;
  for (const plc::Facet& f : plc.facets) {
    const double sign = (f.below == region ? 1 : 0) - (f.above == region ? 1 : 0);
    for (const auto& t : plc.triangles_of(f))
      sixfold += sign * dot(plc.world[t[0]], cross(plc.world[t[1]], plc.world[t[2]]));
  }
  return sixfold / 6;
}

inline double inside_volume(const plc::Plc& plc) {
  double sum = 0;
  for (std::uint32_t c = 0; c < plc.regions.size(); ++c)
    if (plc.regions[c].inside) sum += volume(plc, c);
  return sum;
}

}  // namespace ccdt::plc_test
