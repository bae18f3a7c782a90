#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/base/simplex_map.h"
#include "engine/mesh/tet_mesh.h"

namespace ccdt::mesh {

/// The nodes of the elements of a mesh. In first order they are the vertices. In second order there is also one in the
/// middle of each edge, which all elements at the edge share: a tetrahedron has ten nodes, a triangle six, an edge
/// three.
class ElementNodes {
 public:
  /// \param mesh   must outlive this object
  /// \param order  1 or 2
  ElementNodes(const TetMesh& mesh, int order);

  const TetMesh& mesh() const { return mesh_; }
  bool are_second_order() const { return order_ == 2; }
  std::size_t count() const { return mesh_.vertices.size() + edges_.size(); }
  /// The vertices come first, with their numbers in the mesh.
  Point3 point(std::size_t node) const;

  /// How many nodes an element with so many corners has.
  std::size_t per_element(std::size_t corners) const {
    return are_second_order() ? corners * (corners + 1) / 2 : corners;
  }
  /// The node k of an element: its corners, then the middles of its edges 01, 12, 02, 03, 13 and 23, as far as it has
  /// them. This is the order of VTK, XDMF and Abaqus.
  template <std::size_t Corners>
  std::uint32_t node(const std::array<std::uint32_t, Corners>& corners, std::size_t k) const {
    if (k < Corners) return corners[k];
    const auto [a, b] = edge_ends[k - Corners];
    return static_cast<std::uint32_t>(mesh_.vertices.size()) + number_of_.find(corners[a], corners[b]);
  }

 private:
  static constexpr std::array<std::array<std::size_t, 2>, 6> edge_ends = {
      {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}}};

  void collect_edges();

  const TetMesh& mesh_;
  int order_;
  std::vector<std::array<std::uint32_t, 2>> edges_;  ///< empty in first order
  EdgeMap number_of_;
};

}  // namespace ccdt::mesh
