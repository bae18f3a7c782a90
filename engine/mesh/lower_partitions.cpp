#include "engine/mesh/lower_partitions.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "engine/base/simplex_map.h"

namespace ccdt::mesh {

LowerPartitions lower_partitions(const TetMesh& mesh) {
  if (mesh.partitions.empty()) return {};
  constexpr int unset = 0;
  const SimplexMap<3> faces(mesh.faces, mesh.vertices.size());
  const SimplexMap<2> edges(mesh.edges, mesh.vertices.size());
  LowerPartitions partitions{std::vector<int>(mesh.faces.size(), unset), std::vector<int>(mesh.edges.size(), unset)};
  const auto note = [](std::vector<int>& list, std::uint32_t index, int partition) {
    if (index != none && (list[index] == unset || partition < list[index])) list[index] = partition;
  };
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) {
    const std::array<std::uint32_t, 4>& v = mesh.tetrahedra[t];
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = i + 1; j < 4; ++j) {
        note(partitions.of_edges, edges.find(v[i], v[j]), mesh.partitions[t]);
        for (std::size_t k = j + 1; k < 4; ++k)
          note(partitions.of_faces, faces.find(v[i], v[j], v[k]).index, mesh.partitions[t]);
      }
  }
  for (std::vector<int>* list : {&partitions.of_faces, &partitions.of_edges}) std::ranges::replace(*list, unset, 1);
  return partitions;
}

}  // namespace ccdt::mesh
