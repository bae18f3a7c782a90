#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/index_lists.h"
#include "engine/base/raw_vector.h"
#include "engine/mesh/tet_mesh.h"

namespace ccdt::verify {

inline constexpr std::uint32_t none = 0xFFFFFFFFu;

/// The length of the ranges of a long list that one thread processes at a time.
inline constexpr std::size_t chunk_length = 8192;
/// The same where each item takes a search.
inline constexpr std::size_t short_chunk_length = 512;

/// Joins lists in their order.
template <class Item>
std::vector<Item> joined(const std::vector<std::vector<Item>>& lists) {
  std::size_t size = 0;
  for (const auto& list : lists) size += list.size();
  std::vector<Item> all;
  all.reserve(size);
  for (const auto& list : lists) all.insert(all.end(), list.begin(), list.end());
  return all;
}

using Edge = std::array<std::uint32_t, 2>;
using Face = std::array<std::uint32_t, 3>;

/// The same vertices in ascending order.
template <std::size_t n>
std::array<std::uint32_t, n> ascending(std::array<std::uint32_t, n> vertices) {
  std::sort(vertices.begin(), vertices.end());
  return vertices;
}

template <class T>
void sort_and_unique(std::vector<T>& values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

/// The tetrahedra around each vertex, ascending: those of vertex v are `items[first[v] .. first[v + 1])`.
struct Stars {
  RawVector<std::uint32_t> first, items;

  std::span<const std::uint32_t> of(std::uint32_t vertex) const {
    return {items.data() + first[vertex], items.data() + first[vertex + 1]};
  }
};

/// The adjacency of tetrahedra and faces of a mesh. A *half-face* is 4 * tetrahedron + the corner opposite to it.
struct Topology {
  const mesh::TetMesh& mesh;
  Stars stars = {};
  RawVector<std::uint32_t> first_face = {};  ///< by vertex: the first face that has it as its least; then their number
  /// Of each face, the first two half-faces; the second may be `none`. Faces are in lexicographic order of their
  /// vertices, ascending.
  RawVector<Edge> half_faces = {};
  std::vector<std::uint32_t> bad_faces = {};       ///< shared by more than two tetrahedra, or by two on one side
  std::vector<std::uint32_t> boundary_faces = {};  ///< of one tetrahedron
  std::vector<std::uint32_t> listed_faces = {};    ///< of each face that the mesh lists: which it is, or `none`
  std::vector<bool> listed = {};                   ///< by face: does the mesh list it?

  std::size_t face_count() const { return half_faces.size(); }
  bool on_boundary(std::uint32_t face) const { return half_faces[face][1] == none; }
  bool used(std::uint32_t vertex) const { return !stars.of(vertex).empty(); }

  /// The tetrahedron on the other side of a face from `tet`.
  std::uint32_t across(std::uint32_t face, std::uint32_t tet) const {
    const auto [first, second] = half_faces[face];
    return first / 4 == tet ? second / 4 : first / 4;
  }
};

/// \pre all indices are in range; the mesh lives as long as its topology
Topology find_topology(const mesh::TetMesh& mesh);

/// The vertices of a half-face, counterclockwise seen from outside its tetrahedron if that is positively oriented.
Face outward(const mesh::TetMesh& mesh, std::uint32_t half_face);

/// The vertices of a face, ascending.
Face vertices_of_face(const Topology& topology, std::uint32_t face);

/// The face with these vertices, in any order, or `none`.
std::uint32_t find_face(const Topology& topology, const Face& vertices);

/// The face of a half-face.
std::uint32_t face_of(const Topology& topology, std::uint32_t half_face);

bool has_edge(const Topology& topology, std::uint32_t a, std::uint32_t b);

}  // namespace ccdt::verify
