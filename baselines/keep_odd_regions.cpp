#include <algorithm>
#include <array>
#include <deque>

#include "baselines/common.h"

namespace ccdt {
namespace {

using Face = std::array<std::uint32_t, 3>;

constexpr std::uint32_t nobody = 0xFFFFFFFFu;

Face sorted(Face face) {
  std::ranges::sort(face);
  return face;
}

Face face_opposite(const std::array<std::uint32_t, 4>& t, int corner) {
  Face face{};
  for (int i = 0, k = 0; i < 4; ++i)
    if (i != corner) face[static_cast<std::size_t>(k++)] = t[static_cast<std::size_t>(i)];
  return sorted(face);
}

/// For each tetrahedron its four neighbours, or `nobody`.
std::vector<std::array<std::uint32_t, 4>> neighbours_of(const TetMesh& mesh) {
  struct Side {
    Face face;
    std::uint32_t tetrahedron;
    int corner;
  };
  std::vector<Side> sides;
  sides.reserve(4 * mesh.tetrahedra.size());
  for (std::uint32_t t = 0; t < mesh.tetrahedra.size(); ++t)
    for (int corner = 0; corner < 4; ++corner) sides.push_back({face_opposite(mesh.tetrahedra[t], corner), t, corner});
  std::ranges::sort(sides, {}, &Side::face);

  std::vector<std::array<std::uint32_t, 4>> neighbours(mesh.tetrahedra.size(), {nobody, nobody, nobody, nobody});
  for (std::size_t i = 0; i + 1 < sides.size(); ++i) {
    const Side &a = sides[i], &b = sides[i + 1];
    if (a.face != b.face) continue;
    neighbours[a.tetrahedron][static_cast<std::size_t>(a.corner)] = b.tetrahedron;
    neighbours[b.tetrahedron][static_cast<std::size_t>(b.corner)] = a.tetrahedron;
  }
  return neighbours;
}

/// For each tetrahedron whether an odd number of facets is between it and infinity.
std::vector<char> is_odd(const TetMesh& mesh) {
  std::vector<Face> facets;
  facets.reserve(mesh.faces.size());
  for (const Face& face : mesh.faces) facets.push_back(sorted(face));
  std::ranges::sort(facets);

  const auto neighbours = neighbours_of(mesh);
  std::vector<char> parity(mesh.tetrahedra.size(), -1);
  std::deque<std::uint32_t> open;  // a breadth-first fill from the hull inwards
  const auto visit = [&](std::uint32_t t, int value) {
    if (parity[t] >= 0) return;
    parity[t] = static_cast<char>(value);
    open.push_back(t);
  };
  for (std::uint32_t t = 0; t < mesh.tetrahedra.size(); ++t) {
    if (std::ranges::find(neighbours[t], nobody) == neighbours[t].end()) continue;
    visit(t, 1);
    while (!open.empty()) {
      const std::uint32_t here = open.front();
      open.pop_front();
      for (int corner = 0; corner < 4; ++corner) {
        const std::uint32_t next = neighbours[here][static_cast<std::size_t>(corner)];
        if (next == nobody || parity[next] >= 0) continue;
        const bool crosses = std::ranges::binary_search(facets, face_opposite(mesh.tetrahedra[here], corner));
        visit(next, parity[here] ^ static_cast<int>(crosses));
      }
    }
  }
  return parity;
}

/// Keeps the entries of an array, and of its attributes if it has them, for which `keep` holds.
template <class Element, class Attribute, class Keep>
void filter(std::vector<Element>& elements, std::vector<Attribute>& attributes, Keep keep) {
  const bool with_attributes = attributes.size() == elements.size();
  std::size_t kept = 0;
  for (std::size_t i = 0; i < elements.size(); ++i) {
    if (!keep(i)) continue;
    elements[kept] = elements[i];
    if (with_attributes) attributes[kept] = attributes[i];
    ++kept;
  }
  elements.resize(kept);
  if (with_attributes) attributes.resize(kept);
}

void drop_unused_vertices(TetMesh& mesh) {
  std::vector<std::uint32_t> renumbered(mesh.vertices.size(), nobody);
  for (const auto& t : mesh.tetrahedra)
    for (const auto v : t) renumbered[v] = 0;
  std::uint32_t kept = 0;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    if (renumbered[v] == nobody) continue;
    mesh.vertices[kept] = mesh.vertices[v];
    renumbered[v] = kept++;
  }
  mesh.vertices.resize(kept);
  const auto gone = [&](const auto& element) {
    return std::ranges::any_of(element, [&](std::uint32_t v) { return renumbered[v] == nobody; });
  };
  filter(mesh.faces, mesh.face_markers, [&](std::size_t i) { return !gone(mesh.faces[i]); });
  filter(mesh.edges, mesh.edge_markers, [&](std::size_t i) { return !gone(mesh.edges[i]); });
  for (auto& t : mesh.tetrahedra)
    for (auto& v : t) v = renumbered[v];
  for (auto& face : mesh.faces)
    for (auto& v : face) v = renumbered[v];
  for (auto& edge : mesh.edges)
    for (auto& v : edge) v = renumbered[v];
}

}  // namespace

void keep_odd_regions(TetMesh& mesh) {
  const std::vector<char> odd = is_odd(mesh);
  if (std::ranges::all_of(odd, [](char parity) { return parity == 1; })) return;
  filter(mesh.tetrahedra, mesh.regions, [&](std::size_t t) { return odd[t] == 1; });
  drop_unused_vertices(mesh);
}

}  // namespace ccdt
