#include "bench/verify/check_delaunay.h"

#include <cmath>
#include <string>

#include "bench/verify/exact.h"
#include "bench/verify/findings.h"

namespace ccdt::verify {

namespace {

/// Value of the in-sphere determinant, and bounds on how much it changes when every coordinate moves: to first order by
/// `change` times the move, to second order by `bend` times its square. Between five points that are almost in one
/// plane and almost on one circle the second is the larger.
struct Sensitivity {
  double value, change, bend;

  double explained_by(double move) const { return 1.01 * change * move + bend * move * move; }
};

double norm1(const Point3& p) {
  return std::fabs(p.x) + std::fabs(p.y) + std::fabs(p.z);
}

/// With the last point as origin the determinant of the rows (p_i, |p_i|^2) is sum_i |p_i|^2 m_i, m_i the signed 3x3
/// minors. Its gradient by p_i is 2 m_i p_i plus |p_j|^2 times the gradients of the other minors, which are cross
/// products. The origin's is minus the sum of all.
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

std::string describe_face(const mesh::TetMesh& mesh, const Face& face, std::uint32_t before, std::uint32_t behind,
                          double ratio) {
  return "the face" + text(mesh.vertices, face) + " between " + text(mesh.vertices[before]) + " and " +
         text(mesh.vertices[behind]) + ", " + std::to_string(ratio) + " times what rounding explains";
}

}  // namespace

std::array<Check, 2> check_delaunay(const Topology& topology, const std::vector<bool>& constrained, double rounding,
                                    bool required, const Progress& progress) {
  std::array<Check, 2> checks{
      {{.name = required ? "locally Delaunay faces" : "locally Delaunay faces, not claimed", .required = required},
       {.name = "locally Delaunay without rounding", .required = false}}};
  for (std::uint32_t f = 0; f < topology.faces.size(); ++f) {
    if (f % 65536 == 0) report(progress, "verify Delaunay", f, topology.faces.size());
    if (constrained[f] || topology.on_boundary(f)) continue;
    const std::uint32_t h = topology.half_faces[f][0], other = topology.half_faces[f][1];
    const auto [a, c, b] = outward(topology.mesh, h);
    const std::uint32_t before = topology.mesh.tetrahedra[h / 4][h % 4],
                        behind = topology.mesh.tetrahedra[other / 4][other % 4];
    const std::array<Point3, 5> points = {topology.mesh.vertices[a], topology.mesh.vertices[b],
                                          topology.mesh.vertices[c], topology.mesh.vertices[before],
                                          topology.mesh.vertices[behind]};
    for (Check& check : checks) ++check.checked;
    if (side_of_sphere(points[0], points[1], points[2], points[3], points[4]) <= 0) continue;
    const Sensitivity sensitivity = in_sphere_sensitivity(points);
    const double ratio = std::fabs(sensitivity.value) / sensitivity.explained_by(rounding);
    fail(checks[ratio > 1 ? 0 : 1],
         [&] { return describe_face(topology.mesh, topology.faces[f], before, behind, ratio); });
  }
  return checks;
}

}  // namespace ccdt::verify
