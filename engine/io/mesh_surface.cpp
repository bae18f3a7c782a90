#include "engine/io/mesh_surface.h"

#include <algorithm>
#include <utility>

#include "engine/io/formats.h"
#include "engine/io/mesh_regions.h"

namespace ccdt::io {
namespace {

/// The vertices of facets and segments, which get their new numbers.
std::vector<Point3> keep_used(const std::vector<Point3>& vertices, mesh::TetMesh& mesh) {
  std::vector<std::uint32_t> number(vertices.size(), none);
  std::vector<Point3> used;
  const auto for_each_corner = [&](const auto& visit) {
    for (auto& face : mesh.faces) std::ranges::for_each(face, visit);
    for (auto& edge : mesh.edges) std::ranges::for_each(edge, visit);
  };
  for_each_corner([&](std::uint32_t v) { number[v] = 0; });
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    if (number[v] == none) continue;
    number[v] = static_cast<std::uint32_t>(used.size());
    used.push_back(vertices[v]);
  }
  for_each_corner([&](std::uint32_t& v) { v = number[v]; });
  return used;
}

}  // namespace

plc::InputPlc surface_of(mesh::TetMesh mesh) {
  plc::InputPlc plc;
  if (!mesh.tetrahedra.empty()) {
    plc.inside = plc::InputPlc::Inside::seeds;
    MeshSeeds seeds = bound_regions(mesh);
    plc.regions = std::move(seeds.regions);
    plc.holes = std::move(seeds.cavities);
    plc.notes.push_back("the file has tetrahedra, so the boundaries of their regions were used; tetrahedra: " +
                        std::to_string(mesh.tetrahedra.size()));
  }
  plc.vertices = keep_used(mesh.vertices, mesh);
  for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
    const int marker = attribute_of(mesh.face_markers, i);
    add_facet(plc, mesh.faces[i], marker, i);
    if (const auto name = mesh.face_names.find(marker); name != mesh.face_names.end()) plc.marker_names.insert(*name);
  }
  for (std::size_t i = 0; i < mesh.edges.size(); ++i)
    add_facet(plc, mesh.edges[i], attribute_of(mesh.edge_markers, i), 0);
  finish_facets(plc);
  return plc;
}

}  // namespace ccdt::io
