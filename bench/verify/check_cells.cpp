#include <cmath>

#include "bench/verify/checks.h"
#include "bench/verify/exact.h"
#include "bench/verify/findings.h"

namespace ccdt::verify {

namespace {

void check_array(Check& check, const char* what, std::size_t size, std::size_t wanted) {
  ++check.checked;
  if (size == wanted || size == 0) return;
  fail(check, [&] { return std::to_string(size) + " " + what + " for " + std::to_string(wanted) + " elements"; });
}

template <class Elements>
void check_elements(Check& check, const char* what, const Elements& elements, std::size_t vertices) {
  check.checked += elements.size();
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const auto sorted = ascending(elements[i]);
    if (sorted.back() < vertices && std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end()) continue;
    fail(check, [&] {
      std::string s = std::string(what) + " " + std::to_string(i) + " has the vertices";
      for (const std::uint32_t v : elements[i]) s += " " + std::to_string(v);
      return s + " of " + std::to_string(vertices);
    });
  }
}

}  // namespace

Check check_coordinates(const mesh::TetMesh& mesh) {
  Check check = make_check("finite coordinates");
  check.checked = mesh.vertices.size();
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const Point3& p = mesh.vertices[v];
    if (std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)) continue;
    fail(check, [&] { return "vertex " + std::to_string(v) + " is at " + text(p); });
  }
  return check;
}

Check check_indices(const mesh::TetMesh& mesh) {
  Check check = make_check("valid elements");
  if (mesh.tetrahedra.empty()) fail(check, [] { return std::string("the mesh has no tetrahedra"); });
  check_elements(check, "tetrahedron", mesh.tetrahedra, mesh.vertices.size());
  check_elements(check, "face", mesh.faces, mesh.vertices.size());
  check_elements(check, "edge", mesh.edges, mesh.vertices.size());
  check_array(check, "regions", mesh.regions.size(), mesh.tetrahedra.size());
  check_array(check, "face markers", mesh.face_markers.size(), mesh.faces.size());
  check_array(check, "edge markers", mesh.edge_markers.size(), mesh.edges.size());
  return check;
}

Check check_orientation(const mesh::TetMesh& mesh, const Progress& progress) {
  Check check = make_check("positive orientation");
  check.checked = mesh.tetrahedra.size();
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) {
    if (t % 65536 == 0) report(progress, "verify orientation", t, mesh.tetrahedra.size());
    const auto& [a, b, c, d] = mesh.tetrahedra[t];
    if (orientation(mesh.vertices[a], mesh.vertices[b], mesh.vertices[c], mesh.vertices[d]) > 0) continue;
    fail(check, [&] { return "tetrahedron " + std::to_string(t) + ":" + text(mesh.vertices, mesh.tetrahedra[t]); });
  }
  return check;
}

Check check_distinct_vertices(const mesh::TetMesh& mesh, const Topology& topology) {
  Check check = make_check("distinct vertices");
  std::vector<std::uint32_t> order;
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v)
    if (topology.used(v)) order.push_back(v);
  check.checked = order.size();
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t a, std::uint32_t b) { return as_array(mesh.vertices[a]) < as_array(mesh.vertices[b]); });
  for (std::size_t i = 1; i < order.size(); ++i) {
    if (mesh.vertices[order[i - 1]] != mesh.vertices[order[i]]) continue;
    fail(check, [&] {
      return "vertices " + std::to_string(order[i - 1]) + " and " + std::to_string(order[i]) + " are both at " +
             text(mesh.vertices[order[i]]);
    });
  }
  return check;
}

Check check_used_vertices(const mesh::TetMesh& mesh, const Topology& topology) {
  Check check = make_check("vertices in use", false);
  check.checked = mesh.vertices.size();
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
    if (topology.used(v)) continue;
    fail(check, [&] { return "no tetrahedron has the vertex " + std::to_string(v) + " at " + text(mesh.vertices[v]); });
  }
  return check;
}

Check check_shared_faces(const mesh::TetMesh& mesh, const Topology& topology) {
  Check check = make_check("faces of one or two tetrahedra");
  check.checked = topology.faces.size();
  for (const std::uint32_t f : topology.bad_faces) {
    fail(check, [&] {
      return "more than two tetrahedra, or two on one side, at the face" + text(mesh.vertices, topology.faces[f]);
    });
  }
  return check;
}

}  // namespace ccdt::verify
