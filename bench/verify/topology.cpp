#include "bench/verify/topology.h"

#include <utility>

#include "engine/base/parallel.h"
#include "engine/base/simplex_map.h"

namespace ccdt::verify {

namespace {

/// Is `v` an even permutation of its ascending order?
bool is_even(const Face& v) {
  return (v[0] < v[1]) == ((v[1] < v[2]) == (v[0] < v[2]));
}

/// Tetrahedra around each vertex, ascending. Each thread counts those of a part of the mesh, and enters them after
/// those of the earlier parts.
IndexLists find_stars(const mesh::TetMesh& mesh) {
  const std::size_t size = mesh.tetrahedra.size(), vertices = mesh.vertices.size();
  const std::size_t parts = std::min<std::size_t>(thread_count(), size / chunk_length + 1);
  const auto visit_part = [&](std::size_t part, const auto& visit) {
    for (std::size_t t = size * part / parts; t < size * (part + 1) / parts; ++t)
      for (const std::uint32_t v : mesh.tetrahedra[t]) visit(v, static_cast<std::uint32_t>(t));
  };
  std::vector<std::vector<std::uint32_t>> places(parts);  // of each part and vertex: how many, then where they begin
  parallel_for(parts, 1, [&](std::size_t part) {
    auto& count = places[part];
    count.assign(vertices, 0);
    visit_part(part, [&](std::uint32_t v, std::uint32_t) { ++count[v]; });
  });
  IndexLists stars;
  stars.first.resize(vertices + 1);
  std::uint32_t sum = 0;
  for (std::size_t v = 0; v < vertices; ++v) {
    stars.first[v] = sum;
    for (auto& place : places) sum += std::exchange(place[v], sum);
  }
  stars.first[vertices] = sum;
  stars.items.resize(sum);
  parallel_for(parts, 1, [&](std::size_t part) {
    auto& place = places[part];
    visit_part(part, [&](std::uint32_t v, std::uint32_t t) { stars.items[place[v]++] = t; });
  });
  return stars;
}

/// A half-face at its least vertex.
struct Entry {
  std::uint64_t others;  ///< `edge_key` of its other vertices
  std::uint32_t half_face;

  auto operator<=>(const Entry&) const = default;
};

void find_entries(const Topology& topology, std::uint32_t vertex, std::vector<Entry>& entries) {
  entries.clear();
  for (const std::uint32_t t : topology.stars.of(vertex)) {
    const auto& tet = topology.mesh.tetrahedra[t];
    for (std::uint32_t corner = 0; corner < 4; ++corner) {
      if (tet[corner] == vertex) continue;
      const Face face = outward(topology.mesh, 4 * t + corner);
      if (std::ranges::min(face) != vertex) continue;
      const auto [a, b] = face[0] == vertex   ? Edge{face[1], face[2]}
                          : face[1] == vertex ? Edge{face[0], face[2]}
                                              : Edge{face[0], face[1]};
      entries.push_back({edge_key(a, b), 4 * t + corner});
    }
  }
  std::sort(entries.begin(), entries.end());
}

/// The faces whose least vertex is in a range of vertices, numbered from 0.
struct FacesOfRange {
  std::vector<std::uint32_t> first_face;  ///< of each vertex
  std::vector<Face> faces;
  std::vector<Edge> half_faces;
  std::vector<Edge> more;  ///< half-faces beyond the first two of a face, with the face
  std::vector<std::uint32_t> bad_faces, boundary_faces;
};

FacesOfRange find_faces(const Topology& topology, std::size_t begin, std::size_t end) {
  FacesOfRange range;
  std::vector<Entry> entries;
  for (auto v = static_cast<std::uint32_t>(begin); v < end; ++v) {
    range.first_face.push_back(static_cast<std::uint32_t>(range.faces.size()));
    find_entries(topology, v, entries);
    for (std::size_t i = 0, next = 0; i < entries.size(); i = next) {
      const auto [others, first] = entries[i];
      const auto face = static_cast<std::uint32_t>(range.faces.size());
      for (; next < entries.size() && entries[next].others == others; ++next)
        if (next > i + 1) range.more.push_back({entries[next].half_face, face});
      const std::uint32_t second = next - i > 1 ? entries[i + 1].half_face : none;
      if (second == none)
        range.boundary_faces.push_back(face);
      else if (next - i > 2 || is_even(outward(topology.mesh, first)) == is_even(outward(topology.mesh, second)))
        range.bad_faces.push_back(face);
      range.faces.push_back({v, static_cast<std::uint32_t>(others >> 32), static_cast<std::uint32_t>(others)});
      range.half_faces.push_back({first, second});
    }
  }
  return range;
}

/// Enters the faces of a range of vertices from `begin`. \param offset  the number of its first face
void enter_faces(const FacesOfRange& range, std::size_t begin, std::uint32_t offset, Topology& topology) {
  for (std::size_t i = 0; i < range.first_face.size(); ++i)
    topology.first_face[begin + i] = offset + range.first_face[i];
  for (std::uint32_t i = 0; i < range.faces.size(); ++i) {
    topology.faces[offset + i] = range.faces[i];
    topology.half_faces[offset + i] = range.half_faces[i];
    for (const std::uint32_t h : range.half_faces[i])
      if (h != none) topology.face_of[h] = offset + i;
  }
  for (const auto& [h, face] : range.more) topology.face_of[h] = offset + face;
}

void find_all_faces(Topology& topology) {
  constexpr std::size_t length = 1024;
  const std::size_t vertices = topology.mesh.vertices.size();
  const auto ranges = parallel_chunks(
      vertices, length, [&](std::size_t begin, std::size_t end) { return find_faces(topology, begin, end); });
  std::vector<std::uint32_t> offsets;
  std::uint32_t faces = 0;
  for (const FacesOfRange& range : ranges) {
    offsets.push_back(faces);
    for (const std::uint32_t f : range.bad_faces) topology.bad_faces.push_back(faces + f);
    for (const std::uint32_t f : range.boundary_faces) topology.boundary_faces.push_back(faces + f);
    faces += static_cast<std::uint32_t>(range.faces.size());
  }
  topology.faces.resize(faces);
  topology.half_faces.resize(faces);
  topology.face_of.resize(4 * topology.mesh.tetrahedra.size());
  topology.first_face.resize(vertices + 1);
  topology.first_face[vertices] = faces;
  parallel_for(ranges.size(), 1, [&](std::size_t i) { enter_faces(ranges[i], length * i, offsets[i], topology); });
}

/// Finds the faces that the mesh lists.
void find_listed(Topology& topology) {
  const auto& faces = topology.mesh.faces;
  topology.listed_faces.resize(faces.size());
  parallel_for(faces.size(), chunk_length,
               [&](std::size_t i) { topology.listed_faces[i] = find_face(topology, faces[i]); });
  topology.listed.assign(topology.faces.size(), false);
  for (const std::uint32_t f : topology.listed_faces)
    if (f != none) topology.listed[f] = true;
}

}  // namespace

Face outward(const mesh::TetMesh& mesh, std::uint32_t half_face) {
  constexpr std::uint8_t corners[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};  // opposite to each corner
  const auto& tet = mesh.tetrahedra[half_face / 4];
  const auto& corner = corners[half_face % 4];
  return {tet[corner[0]], tet[corner[1]], tet[corner[2]]};
}

Topology find_topology(const mesh::TetMesh& mesh) {
  Topology topology{.mesh = mesh};
  topology.stars = find_stars(mesh);
  find_all_faces(topology);
  find_listed(topology);
  return topology;
}

std::uint32_t find_face(const Topology& topology, const Face& vertices) {
  const Face wanted = ascending(vertices);
  if (wanted[2] >= topology.mesh.vertices.size()) return none;
  const auto begin = topology.faces.begin() + topology.first_face[wanted[0]];
  const auto end = topology.faces.begin() + topology.first_face[wanted[0] + 1];
  const auto found = std::lower_bound(begin, end, wanted);
  if (found == end || *found != wanted) return none;
  return static_cast<std::uint32_t>(found - topology.faces.begin());
}

bool has_edge(const Topology& topology, std::uint32_t a, std::uint32_t b) {
  return std::ranges::any_of(topology.stars.of(a), [&](std::uint32_t t) {
    return std::ranges::find(topology.mesh.tetrahedra[t], b) != topology.mesh.tetrahedra[t].end();
  });
}

}  // namespace ccdt::verify
