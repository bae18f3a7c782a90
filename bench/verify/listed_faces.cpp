#include "bench/verify/listed_faces.h"

#include <algorithm>
#include <unordered_map>

#include "bench/verify/findings.h"

namespace ccdt::verify {
namespace {

std::string described(const mesh::TetMesh& mesh, const Face& face) {
  return "the face" + text(mesh.vertices, face);
}

}  // namespace

Check check_listed_faces(const Topology& topology) {
  const mesh::TetMesh& mesh = topology.mesh;
  Check check{.name = "listed faces"};
  if (mesh.faces.empty()) return check;
  std::vector<bool> listed(topology.face_count(), false);
  check.checked = mesh.faces.size();
  for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
    const Face& vertices = mesh.faces[i];
    const std::uint32_t face = topology.listed_faces[i];
    if (face == none) {
      fail(check, [&] { return described(mesh, vertices) + " is listed, but belongs to no tetrahedron"; });
    } else if (listed[face]) {
      fail(check, [&] { return described(mesh, vertices) + " is listed twice"; });
    } else {
      listed[face] = true;
    }
  }
  for (const std::uint32_t f : topology.boundary_faces) {
    if (listed[f]) continue;
    ++check.checked;
    fail(check, [&] { return described(mesh, vertices_of_face(topology, f)) + " is on the boundary, but not listed"; });
  }
  return check;
}

Check check_listed_facets(const Topology& topology, const FacetMatches& matches, bool required) {
  const mesh::TetMesh& mesh = topology.mesh;
  Check check{.name = listed_facets_check, .checked = mesh.faces.size()};
  if (mesh.faces.empty() && required)
    fail(check, [&] { return "none of the " + std::to_string(matches.faces.size()) + " faces on facets is listed"; });
  if (mesh.faces.empty()) return check;
  for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
    const std::uint32_t face = topology.listed_faces[i];
    if (face == none || topology.on_boundary(face) || matches.is_matched[face]) continue;
    fail(check, [&] { return described(mesh, mesh.faces[i]) + " is listed, but is inside and on no facet"; });
  }
  for (const MatchedFace& matched : matches.faces) {
    if (topology.listed[matched.face] || topology.on_boundary(matched.face)) continue;
    ++check.checked;
    fail(check,
         [&] { return described(mesh, vertices_of_face(topology, matched.face)) + " is on a facet, but not listed"; });
  }
  return check;
}

Check check_face_markers(const Topology& topology, const Surface& surface, const FacetMatches& matches) {
  const mesh::TetMesh& mesh = topology.mesh;
  Check check{.name = "face markers"};
  if (mesh.face_markers.empty()) {
    if (!mesh.faces.empty() && std::ranges::any_of(surface.marker, [](int marker) { return marker != 0; }))
      check.not_compared = "the mesh has no markers of faces";
    return check;
  }
  std::unordered_multimap<std::uint32_t, int> markers;  // by face
  for (const MatchedFace& matched : matches.faces)
    if (surface.marker[matched.piece] != 0) markers.emplace(matched.face, surface.marker[matched.piece]);
  for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
    const auto [first, last] = markers.equal_range(topology.listed_faces[i]);
    if (first == last) continue;
    ++check.checked;
    if (std::any_of(first, last, [&](const auto& marker) { return marker.second == mesh.face_markers[i]; })) continue;
    fail(check, [&, marker = first->second] {
      return described(mesh, mesh.faces[i]) + " has the marker " + std::to_string(mesh.face_markers[i]) +
             " and stands for a facet with the marker " + std::to_string(marker);
    });
  }
  return check;
}

}  // namespace ccdt::verify
