#include "bench/verify/topology.h"

namespace ccdt::verify {

namespace {

/// Is the cyclic order of `v` that of its ascending order?
bool is_even(const Face& v) {
  return (v[0] < v[1]) == ((v[1] < v[2]) == (v[0] < v[2]));
}

}  // namespace

Face outward(const mesh::TetMesh& mesh, std::uint32_t half_face) {
  constexpr std::uint8_t corners[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};  // opposite to each corner
  const auto& tet = mesh.tetrahedra[half_face / 4];
  const auto& corner = corners[half_face % 4];
  return {tet[corner[0]], tet[corner[1]], tet[corner[2]]};
}

Topology find_topology(const mesh::TetMesh& mesh) {
  const std::size_t vertices = mesh.vertices.size();
  const auto half_faces = static_cast<std::uint32_t>(4 * mesh.tetrahedra.size());
  Topology topology{mesh, {}, {}, {}, {}, {}};
  topology.stars = make_index_lists(vertices, [&](const auto& add) {
    for (std::uint32_t t = 0; t < mesh.tetrahedra.size(); ++t)
      for (const std::uint32_t v : mesh.tetrahedra[t]) add(v, t);
  });
  // Half-faces of one face have the same least vertex: many small sorts instead of a large one.
  const IndexLists by_least_vertex = make_index_lists(vertices, [&](const auto& add) {
    for (std::uint32_t h = 0; h < half_faces; ++h) add(std::ranges::min(outward(mesh, h)), h);
  });
  topology.face_of.resize(half_faces);
  topology.faces.reserve(half_faces / 2);
  topology.half_faces.reserve(half_faces / 2);
  std::vector<std::array<std::uint32_t, 3>> entries;  // the two larger vertices, the half-face
  for (std::uint32_t v = 0; v < vertices; ++v) {
    entries.clear();
    for (const std::uint32_t h : by_least_vertex.of(v)) {
      const Face face = ascending(outward(mesh, h));
      entries.push_back({face[1], face[2], h});
    }
    std::sort(entries.begin(), entries.end());
    for (std::size_t i = 0, end = 0; i < entries.size(); i = end) {
      const auto [middle, largest, first] = entries[i];
      const auto face = static_cast<std::uint32_t>(topology.faces.size());
      for (; end < entries.size() && entries[end][0] == middle && entries[end][1] == largest; ++end)
        topology.face_of[entries[end][2]] = face;
      const std::uint32_t second = end - i > 1 ? entries[i + 1][2] : none;
      if (end - i > 2 || (end - i == 2 && is_even(outward(mesh, first)) == is_even(outward(mesh, second))))
        topology.bad_faces.push_back(face);
      topology.faces.push_back({v, middle, largest});
      topology.half_faces.push_back({first, second});
    }
  }
  return topology;
}

std::uint32_t find_face(const Topology& topology, const Face& vertices) {
  const Face wanted = ascending(vertices);
  const auto found = std::lower_bound(topology.faces.begin(), topology.faces.end(), wanted);
  if (found == topology.faces.end() || *found != wanted) return none;
  return static_cast<std::uint32_t>(found - topology.faces.begin());
}

bool has_edge(const Topology& topology, std::uint32_t a, std::uint32_t b) {
  return std::ranges::any_of(topology.stars.of(a), [&](std::uint32_t t) {
    return std::ranges::find(topology.mesh.tetrahedra[t], b) != topology.mesh.tetrahedra[t].end();
  });
}

}  // namespace ccdt::verify
