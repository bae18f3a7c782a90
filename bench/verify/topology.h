#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/mesh/tet_mesh.h"

namespace ccdt::verification {

inline constexpr std::uint32_t none = 0xFFFFFFFFu;

/// Corners of a tetrahedron's face opposite to each corner, counterclockwise seen from outside a positively oriented
/// one.
inline constexpr std::uint8_t outward_face[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};

/// Who shares what in a mesh. A *half-face* is 4 * tetrahedron + the corner opposite to it.
struct Topology {
  std::vector<std::array<std::uint32_t, 3>> faces;  ///< vertices of each face, ascending; in lexicographic order
  std::vector<std::array<std::uint32_t, 2>>
      half_faces;                          ///< of each face, the first two half-faces; the second may be `none`
  std::vector<std::uint32_t> face_of;      ///< of each half-face
  std::vector<std::uint32_t> wrong_faces;  ///< shared by more than two tetrahedra, or by two on one side
  std::vector<std::uint32_t> star_begin,
      star;  ///< tetrahedra around each vertex: star[star_begin[v] .. star_begin[v+1])

  bool on_boundary(std::uint32_t face) const { return half_faces[face][1] == none; }
  bool used(std::uint32_t vertex) const { return star_begin[vertex] != star_begin[vertex + 1]; }
};

/// \pre all indices are in range
Topology find_topology(const TetMesh& mesh);

/// The vertices of a half-face, counterclockwise seen from outside its tetrahedron.
std::array<std::uint32_t, 3> outward(const TetMesh& mesh, std::uint32_t half_face);

/// The face with these vertices, in any order, or `none`.
std::uint32_t find_face(const Topology& topology, std::array<std::uint32_t, 3> vertices);

bool has_edge(const TetMesh& mesh, const Topology& topology, std::uint32_t a, std::uint32_t b);

}  // namespace ccdt::verification
