#include "bench/verify/topology.h"

#include <algorithm>
#include <ranges>
#include <utility>

#include "engine/base/parallel.h"
#include "engine/base/platform.h"
#include "engine/base/simplex_map.h"

namespace ccdt::verify {

namespace {

/// Finds the tetrahedra around each vertex. Each thread counts those of one part of the mesh, and enters them after
/// those of the earlier parts.
Stars find_stars(const mesh::TetMesh& mesh) {
  const std::size_t size = mesh.tetrahedra.size(), vertices = mesh.vertices.size();
  const std::size_t parts = std::min<std::size_t>(thread_count(), size / chunk_length + 1);
  const auto visit_part = [&](std::size_t part, const auto& visit) {
    for (std::size_t t = size * part / parts; t < size * (part + 1) / parts; ++t)
      for (const std::uint32_t v : mesh.tetrahedra[t]) visit(v, static_cast<std::uint32_t>(t));
  };
  std::vector<std::vector<std::uint32_t>> places(parts);  // for each part and vertex: the count, then the first place
  parallel_for(parts, 1, [&](std::size_t part) {
    auto& count = places[part];
    count.assign(vertices, 0);
    visit_part(part, [&](std::uint32_t v, std::uint32_t) { ++count[v]; });
  });
  Stars stars;
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
  bool odd;  ///< do its vertices, counterclockwise seen from outside, make an odd permutation of their order?

  bool operator<(const Entry& e) const { return others != e.others ? others < e.others : half_face < e.half_face; }
};

/// A half-face as one of its vertices sees it.
struct SeenHalfFace {
  std::uint8_t one = 0, other = 0;  ///< the corners with its other two vertices, ascending
  bool odd = false;                 ///< the value of `Entry::odd` if the vertices of the corners are ascending
};

/// The half-face opposite to `corner`, seen from the vertex in the corner `place`.
constexpr SeenHalfFace see_half_face(unsigned place, unsigned corner) {
  std::array<std::uint8_t, 4> others = {};
  unsigned count = 0;
  for (std::uint8_t k = 0; k < 4; ++k)
    if (k != place && k != corner) others[count++] = k;
  // In their order, the corners of the half-face are counterclockwise if the corner left out is the first or third.
  const unsigned rank = place - (corner < place ? 1 : 0);
  return {others[0], others[1], ((corner ^ rank) & 1) != 0};
}

constexpr auto seen_half_faces = [] {
  std::array<std::array<SeenHalfFace, 4>, 4> seen;
  for (unsigned place = 0; place < 4; ++place)
    for (unsigned corner = 0; corner < 4; ++corner)
      if (place != corner) seen[place][corner] = see_half_face(place, corner);
  return seen;
}();

/// Finds the half-faces of which this vertex is the least. A tetrahedron has three if none of its vertices is less, one
/// if one vertex is less, and none otherwise.
void find_entries(const Topology& topology, std::uint32_t vertex, std::vector<Entry>& entries) {
  constexpr std::uint32_t ahead = 16;
  const auto& tetrahedra = topology.mesh.tetrahedra;
  const auto& [first, items] = topology.stars;
  entries.resize(3 * std::size_t{first[vertex + 1] - first[vertex]});
  Entry* next = entries.data();
  for (std::uint32_t i = first[vertex]; i < first[vertex + 1]; ++i) {
    if (i + ahead < items.size()) prefetch(&tetrahedra[items[i + ahead]]);
    const std::uint32_t t = items[i];
    const auto& tet = tetrahedra[t];
    unsigned lesser = 0, place = 0, least = 0;
    for (unsigned k = 0; k < 4; ++k) {
      lesser += tet[k] < vertex;
      place += tet[k] == vertex ? k : 0;
      least += tet[k] < vertex ? k : 0;
    }
    if (lesser > 1) continue;
    for (unsigned corner = lesser == 1 ? least : 0; corner <= (lesser == 1 ? least : 3); ++corner) {
      if (corner == place) continue;
      const auto [one, other, odd] = seen_half_faces[place][corner];
      *next++ = {edge_key(tet[one], tet[other]), 4 * t + corner, odd != (tet[one] > tet[other])};
    }
  }
  entries.resize(static_cast<std::size_t>(next - entries.data()));
  std::sort(entries.begin(), entries.end());
}

/// The faces whose least vertex is in a range of vertices, numbered from 0.
struct FacesOfRange {
  std::vector<std::uint32_t> first_face;  ///< of each vertex
  std::vector<Edge> half_faces;
  std::vector<std::uint32_t> bad_faces, boundary_faces;
};

FacesOfRange find_faces(const Topology& topology, std::size_t begin, std::size_t end) {
  FacesOfRange range;
  std::vector<Entry> entries;
  for (auto v = static_cast<std::uint32_t>(begin); v < end; ++v) {
    range.first_face.push_back(static_cast<std::uint32_t>(range.half_faces.size()));
    find_entries(topology, v, entries);
    for (std::size_t i = 0, next = 0; i < entries.size(); i = next) {
      const Entry& first = entries[i];
      for (next = i + 1; next < entries.size() && entries[next].others == first.others;) ++next;
      const auto face = static_cast<std::uint32_t>(range.half_faces.size());
      if (next - i == 1)
        range.boundary_faces.push_back(face);
      else if (next - i > 2 || first.odd == entries[i + 1].odd)
        range.bad_faces.push_back(face);
      range.half_faces.push_back({first.half_face, next - i > 1 ? entries[i + 1].half_face : none});
    }
  }
  return range;
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
    faces += static_cast<std::uint32_t>(range.half_faces.size());
  }
  topology.half_faces.resize(faces);
  topology.first_face.resize(vertices + 1);
  topology.first_face[vertices] = faces;
  parallel_for(ranges.size(), 1, [&](std::size_t i) {
    std::ranges::transform(ranges[i].first_face, topology.first_face.begin() + static_cast<std::ptrdiff_t>(length * i),
                           [&](std::uint32_t face) { return offsets[i] + face; });
    std::ranges::copy(ranges[i].half_faces, topology.half_faces.begin() + offsets[i]);
  });
}

/// Finds the faces that the mesh lists.
void find_listed(Topology& topology) {
  const auto& faces = topology.mesh.faces;
  topology.listed_faces.resize(faces.size());
  parallel_for(faces.size(), chunk_length,
               [&](std::size_t i) { topology.listed_faces[i] = find_face(topology, faces[i]); });
  topology.listed.assign(topology.face_count(), false);
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

Face vertices_of_face(const Topology& topology, std::uint32_t face) {
  return ascending(outward(topology.mesh, topology.half_faces[face][0]));
}

std::uint32_t find_face(const Topology& topology, const Face& vertices) {
  const Face wanted = ascending(vertices);
  if (wanted[2] >= topology.mesh.vertices.size()) return none;
  const std::uint32_t end = topology.first_face[wanted[0] + 1];
  const auto faces = std::views::iota(topology.first_face[wanted[0]], end);
  const std::uint32_t found = *std::ranges::lower_bound(
      faces, wanted, {}, [&](std::uint32_t face) { return vertices_of_face(topology, face); });
  return found != end && vertices_of_face(topology, found) == wanted ? found : none;
}

std::uint32_t face_of(const Topology& topology, std::uint32_t half_face) {
  return find_face(topology, outward(topology.mesh, half_face));
}

bool has_edge(const Topology& topology, std::uint32_t a, std::uint32_t b) {
  return std::ranges::any_of(topology.stars.of(a), [&](std::uint32_t t) {
    return std::ranges::find(topology.mesh.tetrahedra[t], b) != topology.mesh.tetrahedra[t].end();
  });
}

}  // namespace ccdt::verify
