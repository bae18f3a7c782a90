// Uses a user-defined function for edge lengths: it is sampled at the points of a grid, and the engine interpolates.
#include <ccdt/ccdt.h>

#include <cmath>
#include <cstdio>

namespace {

/// Short edges at x = 0, long ones at x = 2.
double wanted_length(const ccdt::Point3& p) {
  return 0.08 + 0.12 * p.x;
}

/// The function at (n + 1)^3 points of a box.
ccdt::BackgroundSizes sample_sizes(const ccdt::Point3& low, const ccdt::Point3& high, int n) {
  ccdt::BackgroundSizes sizes;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j)
      for (int k = 0; k <= n; ++k) {
        const double s = 1.0 / n;
        sizes.vertices.push_back(
            {std::lerp(low.x, high.x, s * i), std::lerp(low.y, high.y, s * j), std::lerp(low.z, high.z, s * k)});
        sizes.sizes.push_back(wanted_length(sizes.vertices.back()));
      }
  return sizes;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const ccdt::InputPlc surface = ccdt::remesh_surface(ccdt::read_plc(argv[1]), {.edge_length = 0.1});
  ccdt::MeshOptions options;
  options.background = sample_sizes({0, 0, 0}, {2, 2, 1}, 20);
  const ccdt::MeshResult result = ccdt::mesh_plc(surface, options);

  // Interior vertices come last.
  const std::size_t first = result.mesh.vertices.size() - result.counts.interior_vertices;
  std::size_t near = 0, far = 0;
  for (std::size_t v = first; v < result.mesh.vertices.size(); ++v)
    if (result.mesh.vertices[v].y < 1) ++(result.mesh.vertices[v].x < 1 ? near : far);
  std::printf("interior vertices in the cube at x < 1: %zu, at x > 1: %zu\n", near, far);
}
