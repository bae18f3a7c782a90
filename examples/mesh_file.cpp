// Meshes a file: mesh_file INPUT OUTPUT
#include <cstdio>

#include "volume.h"

int main(int argc, char** argv) try {
  if (argc != 3) {
    std::fprintf(stderr, "usage: mesh_file INPUT OUTPUT\n");
    return 2;
  }
  // The file extensions determine the formats. Lengths are in the units of the file.
  ccdt::MeshOptions options;
  options.edge_length = 0.25;
  options.surface = ccdt::SurfaceRule::remesh;
  options.improve.target_dihedral = 25;  // degrees; worse tetrahedra are improved
  const ccdt::MeshResult result = ccdt::mesh_plc(ccdt::read_plc(argv[1]), options);

  ccdt::write_tet_mesh(result.mesh, argv[2]);
  double total = 0;
  for (std::size_t t = 0; t < result.mesh.tetrahedra.size(); ++t) total += volume(result.mesh, t);
  std::printf("%s: %zu tetrahedra, volume %g\n", argv[2], result.mesh.tetrahedra.size(), total);
} catch (const ccdt::Error& error) {
  std::fprintf(stderr, "%s\n%s\n", error.what(), error.remedy().c_str());
  return 1;
}
