// Uses a function of the place for the lengths of edges, on the surface and inside.
#include <ccdt/ccdt.h>

#include <cstdio>
#include <span>

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  ccdt::MeshOptions options;
  options.surface = ccdt::SurfaceRule::remesh;
  options.edge_length = 0.4;
  // Short edges at x = 0, long ones at x = 2.
  options.local.function = [](std::span<const ccdt::Point3> points, std::span<double> lengths) {
    for (std::size_t i = 0; i < points.size(); ++i) lengths[i] = 0.08 + 0.12 * points[i].x;
  };
  const ccdt::MeshResult result = ccdt::mesh_plc(ccdt::read_plc(argv[1]), options);

  // Interior vertices come last.
  const std::size_t first = result.mesh.vertices.size() - result.counts.interior_vertices;
  std::size_t near = 0, far = 0;
  for (std::size_t v = first; v < result.mesh.vertices.size(); ++v)
    if (result.mesh.vertices[v].y < 1) ++(result.mesh.vertices[v].x < 1 ? near : far);
  std::printf("interior vertices in the cube at x < 1: %zu, at x > 1: %zu\n", near, far);
}
