#include "bench/run/surface_limit.h"

#include <algorithm>
#include <array>
#include <vector>

#include "bench/run/quality.h"
#include "engine/base/hash_table.h"
#include "engine/base/parallel.h"
#include "engine/base/simplex_map.h"
#include "engine/geometry/tetrahedron_shape.h"

namespace ccdt::bench {
namespace {

double least_angle_of(const std::array<Point3, 3>& t) {
  double least = portable::pi;
  for (std::size_t i = 0; i < 3; ++i) least = std::min(least, angle_at(t[i], t[(i + 1) % 3], t[(i + 2) % 3]));
  return least * (180 / portable::pi);
}

}  // namespace

SurfaceLimit find_surface_limit(const mesh::TetMesh& mesh) {
  SurfaceLimit limit;
  HashTable<std::uint64_t, char> edges_of_bad;
  for (const auto& f : mesh.faces) {
    const double angle = least_angle_of({mesh.vertices[f[0]], mesh.vertices[f[1]], mesh.vertices[f[2]]});
    limit.least_angle = std::min(limit.least_angle, angle);
    if (angle >= SurfaceLimit::bad_angle) continue;
    for (std::size_t i = 0; i < 3; ++i) edges_of_bad.set(edge_key(f[i], f[(i + 1) % 3]), 1);
  }
  const auto bad = parallel_select(mesh.tetrahedra.size(), 8192, [&](std::size_t i) {
    const auto& [a, b, c, d] = mesh.tetrahedra[i];
    const std::array corners = {mesh.vertices[a], mesh.vertices[b], mesh.vertices[c], mesh.vertices[d]};
    return !(shape_measure(corners) <= SurfaceLimit::bad_r);
  });
  limit.bad_tetrahedra = bad.size();
  for (const std::uint32_t number : bad) {
    const auto& t = mesh.tetrahedra[number];
    bool is_at_bad = false;
    for (std::size_t i = 1; i < 4; ++i)
      for (std::size_t j = 0; j < i; ++j) is_at_bad = is_at_bad || edges_of_bad.contains(edge_key(t[i], t[j]));
    if (is_at_bad) ++limit.at_bad_triangles;
  }
  return limit;
}

}  // namespace ccdt::bench
