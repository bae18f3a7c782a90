#include <algorithm>
#include <map>

#include "engine/base/box.h"
#include "engine/io/formats.h"
#include "engine/io/gmsh_types.h"

namespace ccdt::io {

namespace {

/// Lines "number type 2 physical elementary nodes...". The physical tag is the marker itself; the elementary tag, which
/// Gmsh wants positive, numbers the different markers.
template <std::size_t Corners>
void write_elements(const std::vector<std::array<std::uint32_t, Corners>>& elements, const std::vector<int>& markers,
                    std::int64_t type, std::size_t& number, OutputFile& out) {
  std::map<int, std::size_t> elementary;
  for (std::size_t i = 0; i < elements.size(); ++i)
    elementary.try_emplace(attribute_of(markers, i), elementary.size() + 1);
  const auto line = [&](std::size_t i, auto& text) {
    const int marker = attribute_of(markers, i);
    text << number + i + 1 << ' ' << type << " 2 " << marker << ' ' << elementary.at(marker);
    write_corners(elements[i], text);
    text << '\n';
  };
  write_lines(elements.size(), line, out);
  number += elements.size();
}

/// The geometric entities of one dimension by their markers, each with its elements. Nodes belong to an entity, so
/// there is one even if there are no elements.
using Entities = std::map<int, std::vector<std::uint32_t>>;

Entities entities_of(std::size_t elements, const std::vector<int>& markers, bool at_least_one = false) {
  Entities entities;
  if (at_least_one && elements == 0) entities.try_emplace(0);
  for (std::size_t i = 0; i < elements; ++i)
    entities[attribute_of(markers, i)].push_back(static_cast<std::uint32_t>(i));
  return entities;
}

OutputFile& put_integer(std::int32_t value, OutputFile& out) {
  return out.raw(value);
}
OutputFile& put_size(std::size_t value, OutputFile& out) {
  return out.raw(static_cast<std::uint64_t>(value));
}

/// "tag box physical-tags bounding-entities" for each entity, numbered from 1. All have the box of the whole mesh. A
/// marker of 0 is written, too, although it means no group: meshio wants a physical tag for all entities or for none.
void write_entities(const Entities& entities, const Box& box, OutputFile& out) {
  std::int32_t tag = 0;
  for (const auto& [marker, elements] : entities) {
    put_integer(++tag, out);
    for (const Point3& corner : {box.low, box.high}) out.raw(corner.x).raw(corner.y).raw(corner.z);
    put_size(1, out);
    put_integer(marker, out);
    put_size(0, out);
  }
}

/// For each entity a block "dimension tag type count", with "number nodes ..." for each element. The numbers of the
/// elements continue `before` in the order of the mesh, so that a reader can put them into that order.
template <std::size_t Corners>
void write_blocks(const Entities& entities, const std::vector<std::array<std::uint32_t, Corners>>& elements,
                  std::int32_t type, std::size_t before, OutputFile& out) {
  std::int32_t tag = 0;
  for (const auto& [marker, members] : entities) {
    put_integer(Corners - 1, out).raw(++tag).raw(type);
    put_size(members.size(), out);
    for (const std::uint32_t i : members) {
      put_size(before + i + 1, out);
      for (const std::uint32_t v : elements[i]) put_size(std::size_t{v} + 1, out);
    }
  }
}

void write_claims(const mesh::TetMesh& mesh, OutputFile& out) {
  if (const std::string claims = claims_of(mesh); !claims.empty()) out << "$Comments\n" << claims << "\n$EndComments\n";
}

/// Names of faces, without what would end them.
void write_names(const std::map<int, std::string>& names, OutputFile& out) {
  if (names.empty()) return;
  out << "$PhysicalNames\n" << names.size() << '\n';
  for (const auto& [marker, name] : names) {
    out << "2 " << marker << " \"";
    for (const char c : name) out << (static_cast<unsigned char>(c) < ' ' || c == '"' || c == '$' ? '_' : c);
    out << "\"\n";
  }
  out << "$EndPhysicalNames\n";
}

/// One block of all nodes, in the first volume.
void write_node_block(const std::vector<Point3>& vertices, OutputFile& out) {
  out << "$Nodes\n";
  for (const std::size_t n : {std::size_t{1}, vertices.size(), std::size_t{1}, vertices.size()}) put_size(n, out);
  put_integer(3, out).raw(std::int32_t{1}).raw(std::int32_t{0});
  put_size(vertices.size(), out);
  for (std::size_t i = 1; i <= vertices.size(); ++i) put_size(i, out);
  for (const Point3& p : vertices) out.raw(p.x).raw(p.y).raw(p.z);
  out << "\n$EndNodes\n";
}

}  // namespace

void write_gmsh(const mesh::TetMesh& mesh, OutputFile& out) {
  out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
  write_claims(mesh, out);
  write_names(mesh.face_names, out);
  out << "$Nodes\n" << mesh.vertices.size() << '\n';
  write_numbered(mesh.vertices, out);
  out << "$EndNodes\n$Elements\n" << mesh.edges.size() + mesh.faces.size() + mesh.tetrahedra.size() << '\n';
  std::size_t number = 0;
  write_elements(mesh.edges, mesh.edge_markers, gmsh_line, number, out);
  write_elements(mesh.faces, mesh.face_markers, gmsh_triangle, number, out);
  write_elements(mesh.tetrahedra, mesh.regions, gmsh_tetrahedron, number, out);
  out << "$EndElements\n";
}

void write_gmsh4(const mesh::TetMesh& mesh, OutputFile& out) {
  const Entities curves = entities_of(mesh.edges.size(), mesh.edge_markers),
                 surfaces = entities_of(mesh.faces.size(), mesh.face_markers),
                 volumes = entities_of(mesh.tetrahedra.size(), mesh.regions, true);
  out << "$MeshFormat\n4.1 1 8\n";
  put_integer(1, out) << "\n$EndMeshFormat\n";
  write_claims(mesh, out);

  write_names(mesh.face_names, out);
  const Box box = mesh.vertices.empty() ? Box() : bounding_box(mesh.vertices);
  out << "$Entities\n";
  for (const std::size_t n : {std::size_t{0}, curves.size(), surfaces.size(), volumes.size()}) put_size(n, out);
  for (const Entities* entities : {&curves, &surfaces, &volumes}) write_entities(*entities, box, out);
  out << "\n$EndEntities\n";

  write_node_block(mesh.vertices, out);

  const std::size_t edges = mesh.edges.size(), faces = mesh.faces.size();
  const std::size_t elements = edges + faces + mesh.tetrahedra.size();
  out << "$Elements\n";
  for (const std::size_t n : {curves.size() + surfaces.size() + volumes.size(), elements, std::size_t{1}, elements})
    put_size(n, out);
  write_blocks(curves, mesh.edges, gmsh_line, 0, out);
  write_blocks(surfaces, mesh.faces, gmsh_triangle, edges, out);
  write_blocks(volumes, mesh.tetrahedra, gmsh_tetrahedron, edges + faces, out);
  out << "\n$EndElements\n";
}

}  // namespace ccdt::io
