#include "engine/mesh/element_nodes.h"

#include <algorithm>

namespace ccdt::mesh {

ElementNodes::ElementNodes(const TetMesh& mesh, int order) : mesh_(mesh), order_(order) {
  if (!are_second_order()) return;
  collect_edges();
  number_of_ = EdgeMap(edges_, mesh.vertices.size());
}

void ElementNodes::collect_edges() {
  std::vector<std::uint64_t> keys;
  const auto collect = [&](const auto& elements) {
    for (const auto& corners : elements)
      for (std::size_t k = corners.size(); k < per_element(corners.size()); ++k) {
        const auto [a, b] = edge_ends[k - corners.size()];
        keys.push_back(edge_key(corners[a], corners[b]));
      }
  };
  keys.reserve(6 * mesh_.tetrahedra.size());
  collect(mesh_.tetrahedra);
  collect(mesh_.faces);
  collect(mesh_.edges);
  std::ranges::sort(keys);
  keys.erase(std::ranges::unique(keys).begin(), keys.end());
  for (const std::uint64_t key : keys)
    edges_.push_back({static_cast<std::uint32_t>(key >> 32), static_cast<std::uint32_t>(key)});
}

Point3 ElementNodes::point(std::size_t node) const {
  if (node < mesh_.vertices.size()) return mesh_.vertices[node];
  const auto [a, b] = edges_[node - mesh_.vertices.size()];
  return 0.5 * (mesh_.vertices[a] + mesh_.vertices[b]);
}

}  // namespace ccdt::mesh
