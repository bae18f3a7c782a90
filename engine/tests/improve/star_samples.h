#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include "engine/delaunay/delaunay.h"
#include "engine/improve/smoothing.h"

/// Stars of vertices, for tests of functions that move or remove vertices.
namespace ccdt::test {

struct Star {
  std::vector<improve::StarFace> faces;
  Point3 apex;
};

/// The star of a vertex of a tetrahedralization; no faces if the vertex is on the convex hull.
inline Star star_of(const delaunay::Delaunay& delaunay, delaunay::CellStar& cells, std::uint32_t vertex) {
  Star star{{}, delaunay.point(vertex)};
  for (const std::uint32_t cell : cells.around(vertex)) {
    if (!delaunay.is_finite(cell)) return {{}, star.apex};
    const auto& v = delaunay.cells[cell].vertices;
    const auto corners =
        delaunay::face_corners[static_cast<std::size_t>(std::find(v.begin(), v.end(), vertex) - v.begin())];
    star.faces.push_back({delaunay.point(v[corners[0]]), delaunay.point(v[corners[1]]), delaunay.point(v[corners[2]])});
  }
  return star;
}

/// Stars from the Delaunay tetrahedralization of a face-centered lattice whose points have been moved.
///
/// \param jitter  by how much, in units of the spacing `step` of its cubes
inline std::vector<Star> jittered_stars(double jitter, std::uint64_t seed, double step = 0x1p40, Point3 center = {}) {
  constexpr int side = 8, middle = 4;
  std::mt19937_64 random(seed);
  const auto noise = [&] { return 2 * (static_cast<double>(random() >> 11) * 0x1p-53) - 1; };
  std::vector<Point3> points;
  const auto place = [&](int i) { return std::round(step * (i - middle + jitter * noise())); };
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j)
      for (int k = i % 2 == j % 2 ? 0 : 1; k < side; k += 2)
        points.push_back(center + Point3{place(i), place(j), place(k)});
  const delaunay::Delaunay delaunay = delaunay::build_delaunay(points);
  delaunay::CellStar cells(delaunay);
  std::vector<Star> stars;
  for (std::uint32_t v = 0; v < points.size(); ++v) {
    const Point3 from_center = points[v] - center;
    if (std::max({std::fabs(from_center.x), std::fabs(from_center.y), std::fabs(from_center.z)}) > 2 * step) continue;
    Star star = star_of(delaunay, cells, v);
    if (!star.faces.empty()) stars.push_back(std::move(star));
  }
  return stars;
}

}  // namespace ccdt::test
