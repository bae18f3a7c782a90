/* Meshes a file from C: mesh_file_c INPUT OUTPUT EDGE_LENGTH */
#include <ccdt.h>
#include <stdio.h>

static int fail(const char* what) {
  fprintf(stderr, "%s: %s; %s\n", what, ccdt_error_text(), ccdt_error_remedy());
  return 1;
}

static double volume_of(const double* v, const uint32_t* t) {
  double e[3][3];
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) e[i][k] = v[3 * t[i + 1] + k] - v[3 * t[0] + k];
  return (e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) + e[0][1] * (e[1][2] * e[2][0] - e[1][0] * e[2][2]) +
          e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0])) / 6;
}

int main(int argc, char** argv) {
  ccdt_surface* surface = NULL;
  ccdt_options* options = NULL;
  ccdt_mesh* mesh = NULL;
  if (argc != 4) return 2;
  if (ccdt_surface_read(argv[1], &surface) != CCDT_DONE) return fail("cannot read");
  if (ccdt_options_new(&options) != CCDT_DONE) return fail("no options");
  if (ccdt_options_set(options, "edge-length", argv[3]) != CCDT_DONE) return fail("wrong option");
  if (ccdt_mesh_make(surface, options, &mesh) != CCDT_DONE) return fail("cannot mesh");
  if (ccdt_mesh_write(mesh, argv[2]) != CCDT_DONE) return fail("cannot write");

  const double* vertices = NULL;
  const uint32_t* tetrahedra = NULL;
  size_t vertex_count = 0, count = 0;
  ccdt_mesh_vertices(mesh, &vertices, &vertex_count);
  ccdt_mesh_tetrahedra(mesh, &tetrahedra, &count);
  double volume = 0;
  for (size_t t = 0; t < count; ++t) volume += volume_of(vertices, tetrahedra + 4 * t);
  printf("%zu tetrahedra, volume %g\n", count, volume);

  ccdt_mesh_free(mesh);
  ccdt_options_free(options);
  ccdt_surface_free(surface);
  return 0;
}
