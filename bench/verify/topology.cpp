#include "bench/verify/topology.h"

#include <algorithm>

namespace ccdt::verification {

namespace {

struct Entry {
  std::uint32_t middle, largest, half_face;
  friend bool operator<(const Entry& a, const Entry& b) {
    if (a.middle != b.middle) return a.middle < b.middle;
    return a.largest != b.largest ? a.largest < b.largest : a.half_face < b.half_face;
  }
};

std::array<std::uint32_t, 3> ascending(std::array<std::uint32_t, 3> v) {
  std::sort(v.begin(), v.end());
  return v;
}

/// Is the cyclic order of `v` that of its ascending order?
bool is_even(const std::array<std::uint32_t, 3>& v) {
  return (v[0] < v[1]) == ((v[1] < v[2]) == (v[0] < v[2]));
}

void find_stars(const TetMesh& mesh, Topology& topology) {
  auto& begin = topology.star_begin;
  begin.assign(mesh.vertices.size() + 1, 0);
  for (const auto& tet : mesh.tetrahedra)
    for (const std::uint32_t v : tet) ++begin[v + 1];
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) begin[v + 1] += begin[v];
  std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
  topology.star.resize(4 * mesh.tetrahedra.size());
  for (std::uint32_t t = 0; t < mesh.tetrahedra.size(); ++t)
    for (const std::uint32_t v : mesh.tetrahedra[t]) topology.star[next[v]++] = t;
}

/// All half-faces, those with the same smallest vertex together: a counting sort, then many small sorts.
std::vector<Entry> sorted_half_faces(const TetMesh& mesh, std::vector<std::uint32_t>& begin) {
  const auto half_faces = static_cast<std::uint32_t>(4 * mesh.tetrahedra.size());
  begin.assign(mesh.vertices.size() + 1, 0);
  for (std::uint32_t h = 0; h < half_faces; ++h) ++begin[ascending(outward(mesh, h))[0] + 1];
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) begin[v + 1] += begin[v];
  std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
  std::vector<Entry> entries(half_faces);
  for (std::uint32_t h = 0; h < half_faces; ++h) {
    const auto v = ascending(outward(mesh, h));
    entries[next[v[0]]++] = {v[1], v[2], h};
  }
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    std::sort(entries.begin() + begin[v], entries.begin() + begin[v + 1]);
  return entries;
}

}  // namespace

std::array<std::uint32_t, 3> outward(const TetMesh& mesh, std::uint32_t half_face) {
  const auto& tet = mesh.tetrahedra[half_face / 4];
  const auto& corner = outward_face[half_face % 4];
  return {tet[corner[0]], tet[corner[1]], tet[corner[2]]};
}

Topology find_topology(const TetMesh& mesh) {
  Topology topology;
  find_stars(mesh, topology);
  std::vector<std::uint32_t> begin;
  const std::vector<Entry> entries = sorted_half_faces(mesh, begin);
  topology.face_of.resize(entries.size());
  topology.faces.reserve(entries.size() / 2);
  topology.half_faces.reserve(entries.size() / 2);
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
    for (std::uint32_t i = begin[v]; i < begin[v + 1];) {
      std::uint32_t end = i;
      while (end < begin[v + 1] && entries[end].middle == entries[i].middle &&
             entries[end].largest == entries[i].largest)
        topology.face_of[entries[end++].half_face] = static_cast<std::uint32_t>(topology.faces.size());
      const std::uint32_t first = entries[i].half_face;
      const std::uint32_t second = end - i > 1 ? entries[i + 1].half_face : none;
      if (end - i > 2 || (end - i == 2 && is_even(outward(mesh, first)) == is_even(outward(mesh, second))))
        topology.wrong_faces.push_back(static_cast<std::uint32_t>(topology.faces.size()));
      topology.faces.push_back({v, entries[i].middle, entries[i].largest});
      topology.half_faces.push_back({first, second});
      i = end;
    }
  }
  return topology;
}

std::uint32_t find_face(const Topology& topology, std::array<std::uint32_t, 3> vertices) {
  const auto wanted = ascending(vertices);
  const auto found = std::lower_bound(topology.faces.begin(), topology.faces.end(), wanted);
  if (found == topology.faces.end() || *found != wanted) return none;
  return static_cast<std::uint32_t>(found - topology.faces.begin());
}

bool has_edge(const TetMesh& mesh, const Topology& topology, std::uint32_t a, std::uint32_t b) {
  for (std::uint32_t i = topology.star_begin[a]; i < topology.star_begin[a + 1]; ++i) {
    const auto& tet = mesh.tetrahedra[topology.star[i]];
    if (std::find(tet.begin(), tet.end(), b) != tet.end()) return true;
  }
  return false;
}

}  // namespace ccdt::verification
