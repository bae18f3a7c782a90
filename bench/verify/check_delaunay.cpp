#include "bench/verify/check_delaunay.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "bench/verify/exact.h"
#include "bench/verify/findings.h"
#include "engine/base/platform.h"
#include "engine/base/shared_progress.h"

namespace ccdt::verify {

namespace {

/// Value of the in-sphere determinant, and bounds on how much it changes when every coordinate moves: to first order by
/// `change` times the move, to second order by `bend` times its square. For five points that are almost in one
/// plane and almost on one circle, the second is the larger.
struct Sensitivity {
  double value, change, bend;

  double explained_by(double move) const { return 1.01 * change * move + bend * move * move; }
};

double norm1(const Point3& p) {
  return std::fabs(p.x) + std::fabs(p.y) + std::fabs(p.z);
}

/// With the last point as origin, the determinant of the rows (p_i, |p_i|^2) is sum_i |p_i|^2 m_i, where the m_i are
/// the signed 3x3 minors. Its gradient by p_i is 2 m_i p_i plus |p_j|^2 times the gradients of the other minors, which
/// are cross products. Its gradient by the origin is minus the sum of all these gradients.
Sensitivity in_sphere_sensitivity(const std::array<Point3, 5>& points) {
  std::array<Point3, 4> p;
  std::array<double, 4> height, minor;
  for (std::size_t i = 0; i < 4; ++i) {
    p[i] = points[i] - points[4];
    height[i] = squared_length(p[i]);
  }
  std::array<Point3, 4> gradient{};
  double value = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t a = i == 0 ? 1 : 0, b = i <= 1 ? 2 : 1, c = i <= 2 ? 3 : 2;
    const double sign = i % 2 == 0 ? -1 : 1;
    minor[i] = sign * dot(p[a], cross(p[b], p[c]));
    value += height[i] * minor[i];
    gradient[i] = gradient[i] + 2 * minor[i] * p[i];
    gradient[a] = gradient[a] + sign * height[i] * cross(p[b], p[c]);
    gradient[b] = gradient[b] + sign * height[i] * cross(p[c], p[a]);
    gradient[c] = gradient[c] + sign * height[i] * cross(p[a], p[b]);
  }
  Point3 of_origin;
  double change = 0;
  for (const Point3& g : gradient) {
    of_origin = of_origin - g;
    change += norm1(g);
  }
  // 72 monomials of degree 5 in differences up to `largest`, each of which moves by two units: 72 * 10 pairs * 2 * 2.
  double largest = 0;
  for (const Point3& q : p) largest = std::max({largest, std::fabs(q.x), std::fabs(q.y), std::fabs(q.z)});
  return {value, change + norm1(of_origin), 2880 * largest * largest * largest};
}

/// An inner face between two tetrahedra.
struct InnerFace {
  Face face;                     ///< counterclockwise seen from `before`
  std::uint32_t before, behind;  ///< the opposite vertices
};

/// Prefetches the tetrahedra at a face that will be checked soon.
void prefetch(const Topology& topology, std::size_t f) {
  for (const std::uint32_t h : topology.half_faces[f])
    if (h != none) ccdt::prefetch(&topology.mesh.tetrahedra[h / 4]);
}

InnerFace inner_face(const Topology& topology, std::size_t f) {
  const auto [h, other] = topology.half_faces[f];
  const auto [a, c, b] = outward(topology.mesh, h);
  return {{a, b, c}, topology.mesh.tetrahedra[h / 4][h % 4], topology.mesh.tetrahedra[other / 4][other % 4]};
}

std::array<Point3, 5> points_of(const mesh::TetMesh& mesh, const InnerFace& inner) {
  const auto& [a, b, c] = inner.face;
  return {mesh.vertices[a], mesh.vertices[b], mesh.vertices[c], mesh.vertices[inner.before],
          mesh.vertices[inner.behind]};
}

bool is_locally_delaunay(const std::array<Point3, 5>& p) {
  return side_of_sphere(p[0], p[1], p[2], p[3], p[4]) <= 0;
}

/// The ratio of the determinant to the rounding error that can be expected.
double ratio_to_rounding(const std::array<Point3, 5>& points, double rounding) {
  const Sensitivity sensitivity = in_sphere_sensitivity(points);
  return std::fabs(sensitivity.value) / sensitivity.explained_by(rounding);
}

/// The result of checking some of the faces.
struct Found {
  std::uint64_t checked = 0;
  std::array<Failures, 2> failures = {};  ///< beyond what rounding explains, and within
};

}  // namespace

std::array<Check, 2> check_delaunay(const Topology& topology, const std::vector<bool>& constrained, double rounding,
                                    bool required, const Progress& progress) {
  std::array<Check, 2> checks{
      {{.name = required ? "locally Delaunay faces" : "locally Delaunay faces, not claimed", .required = required},
       {.name = "locally Delaunay without rounding", .required = false}}};
  const mesh::TetMesh& mesh = topology.mesh;
  SharedProgress shared(progress, "verify Delaunay", 0, topology.face_count());
  const auto look = [&](std::size_t begin, std::size_t end) {
    Found found;
    for (std::size_t f = begin; f < end; ++f) {
      prefetch(topology, std::min(f + 8, topology.face_count() - 1));
      if (constrained[f] || topology.on_boundary(static_cast<std::uint32_t>(f))) continue;
      ++found.checked;
      const std::array<Point3, 5> points = points_of(mesh, inner_face(topology, f));
      if (!is_locally_delaunay(points)) found.failures[ratio_to_rounding(points, rounding) > 1 ? 0 : 1].add(f);
    }
    shared.add(end - begin);
    return found;
  };
  const auto describe = [&](std::size_t f) {
    const InnerFace inner = inner_face(topology, f);
    char times[32];
    std::snprintf(times, sizeof times, "%.2g", ratio_to_rounding(points_of(mesh, inner), rounding));
    return "the face" + text(mesh.vertices, vertices_of_face(topology, static_cast<std::uint32_t>(f))) + " between " +
           text(mesh.vertices[inner.before]) + " and " + text(mesh.vertices[inner.behind]) + ": " + times +
           " times the bound of rounding errors";
  };
  for (const Found& found : parallel_chunks(topology.face_count(), chunk_length, look))
    for (std::size_t i = 0; i < checks.size(); ++i) {
      checks[i].checked += found.checked;
      fail(checks[i], found.failures[i], describe);
    }
  return checks;
}

}  // namespace ccdt::verify
