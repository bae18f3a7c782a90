// Meshes a box given by arrays: two rooms with a wall between them. Each room is a region with its own attribute.
#include <cmath>
#include <cstdio>
#include <map>
#include <utility>

#include "volume.h"

int main() {
  ccdt::InputPlc input;
  for (double x : {0.0, 1.0, 3.0})
    for (double y : {0.0, 1.0})
      for (double z : {0.0, 1.0}) input.vertices.push_back({x, y, z});

  // A facet may have any number of corners. Vertices 0 to 3 are at x = 0, 4 to 7 at x = 1, 8 to 11 at x = 3.
  const auto add_facet = [&input](std::vector<std::uint32_t> corners, int marker) {
    input.polygon_facets.push_back({.polygons = {std::move(corners)}, .holes = {}, .marker = marker});
  };
  add_facet({0, 1, 3, 2}, 1);
  add_facet({4, 5, 7, 6}, 2);  // the wall
  add_facet({8, 9, 11, 10}, 3);
  for (std::uint32_t room : {0u, 4u}) {
    add_facet({room, room + 1, room + 5, room + 4}, 4);
    add_facet({room + 2, room + 3, room + 7, room + 6}, 4);
    add_facet({room, room + 2, room + 6, room + 4}, 4);
    add_facet({room + 1, room + 3, room + 7, room + 5}, 4);
  }
  input.inside = ccdt::InputPlc::Inside::seeds;
  input.regions = {{{0.5, 0.5, 0.5}, 10}, {{2, 0.5, 0.5}, 20}};

  ccdt::MeshOptions options;
  options.edge_length = 0.3;
  const ccdt::TetMesh mesh = ccdt::mesh_plc(input, options).mesh;

  std::map<int, double> volumes;
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) volumes[mesh.regions[t]] += volume(mesh, t);
  double wall = 0;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    if (mesh.face_markers[f] == 2) {
      const auto& [a, b, c] = mesh.faces[f];
      const ccdt::Point3 normal = cross(mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a]);
      wall += std::abs(normal.x) / 2;
    }
  for (const auto& [region, sum] : volumes) std::printf("region %d: volume %g\n", region, sum);
  std::printf("wall: area %g\n", wall);
}
