#include "bench/experiments/inside_cells.h"

#include <algorithm>
#include <iterator>
#include <vector>

namespace ccdt::experiments {

mesh::TetMesh inside_cells(const mesh::TetMesh& mesh) {
  std::vector<bool> is_on_surface(mesh.vertices.size()), is_near(mesh.vertices.size());
  for (const auto& face : mesh.faces)
    for (const std::uint32_t vertex : face) is_on_surface[vertex] = true;
  for (const auto& tetrahedron : mesh.tetrahedra)
    if (std::ranges::any_of(tetrahedron, [&](std::uint32_t vertex) { return is_on_surface[vertex]; }))
      for (const std::uint32_t vertex : tetrahedron) is_near[vertex] = true;
  mesh::TetMesh inside;
  inside.vertices = mesh.vertices;
  std::ranges::copy_if(mesh.tetrahedra, std::back_inserter(inside.tetrahedra), [&](const auto& tetrahedron) {
    return std::ranges::none_of(tetrahedron, [&](std::uint32_t vertex) { return is_near[vertex]; });
  });
  inside.regions.resize(inside.tetrahedra.size());
  return inside;
}

}  // namespace ccdt::experiments
