#include <string>
#include <utility>
#include <vector>

#include "engine/io/formats.h"
#include "engine/io/vtk_arrays.h"

namespace ccdt::io {
namespace {

constexpr const char* boundary_ending = ".boundary.vtu";

/// Adds the faces and edges of the second file, unless it is another program's.
void add_boundary(const FileBytes& file, mesh::TetMesh& mesh) {
  const VtkArrays arrays(file);
  const auto array = arrays.find("PointData", vtu_point_vertex);
  if (!array) return;
  mesh::TetMesh boundary = read_vtu(file);
  const auto numbers = arrays.read<std::int64_t>(array);
  arrays.check_size(array, numbers.size(), boundary.vertices.size());
  std::vector<std::int64_t> vertices(numbers.size());
  numbers.read(0, vertices.size(), vertices.data());
  for (std::size_t point = 0; point < vertices.size(); ++point)
    if (vertices[point] < 0 || static_cast<std::size_t>(vertices[point]) >= mesh.vertices.size() ||
        mesh.vertices[static_cast<std::size_t>(vertices[point])] != boundary.vertices[point])
      arrays.fail(arrays.begin_of(array),
                  "point " + std::to_string(point) + " is not a vertex of the mesh in the file of tetrahedra beside it",
                  "write both files again, or remove this one");
  const auto number = [&](auto& elements) {
    for (auto& corners : elements)
      for (std::uint32_t& v : corners) v = static_cast<std::uint32_t>(vertices[v]);
  };
  number(boundary.faces);
  number(boundary.edges);
  mesh.faces = std::move(boundary.faces), mesh.face_markers = std::move(boundary.face_markers);
  mesh.face_names = std::move(boundary.face_names);
  mesh.edges = std::move(boundary.edges), mesh.edge_markers = std::move(boundary.edge_markers);
}

}  // namespace

mesh::TetMesh read_vtu_files(const std::filesystem::path& file) {
  mesh::TetMesh mesh = read_vtu(read_whole_file(file));
  const auto boundary = sibling(file, boundary_ending);
  if (mesh.faces.empty() && mesh.edges.empty() && is_there(boundary)) add_boundary(read_whole_file(boundary), mesh);
  return mesh;
}

void write_with_boundary(const mesh::ElementNodes& nodes, const std::filesystem::path& file, const char* ending,
                         void (*write_tetrahedra)(const mesh::ElementNodes&, OutputFile&),
                         void (*write_boundary)(const mesh::ElementNodes&, OutputFile&)) {
  OutputFile tetrahedra(file), boundary(sibling(file, ending));
  write_tetrahedra(nodes, tetrahedra);
  write_boundary(nodes, boundary);
  for (OutputFile* out : {&tetrahedra, &boundary}) out->close();
  for (OutputFile* out : {&boundary, &tetrahedra}) out->commit();  // that of tetrahedra never comes without the other
}

void write_vtu_files(const mesh::ElementNodes& nodes, const std::filesystem::path& file) {
  write_with_boundary(nodes, file, boundary_ending, write_vtu_tetrahedra, write_vtu_boundary);
}

}  // namespace ccdt::io
