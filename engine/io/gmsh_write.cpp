#include <algorithm>
#include <array>
#include <map>
#include <utility>
#include <vector>

#include "engine/base/box.h"
#include "engine/io/formats.h"
#include "engine/io/gmsh_types.h"
#include "engine/mesh/lower_partitions.h"

namespace ccdt::io {

namespace {

/// The node k of an element in Gmsh's order, in which the last two edges of a tetrahedron change places.
template <std::size_t Corners>
std::uint32_t gmsh_node(const mesh::ElementNodes& nodes, const std::array<std::uint32_t, Corners>& corners,
                        std::size_t k) {
  return nodes.node(corners, k < 8 ? k : 17 - k);
}

/// Lines "number type 2 physical elementary nodes...", or "number type 4 physical elementary 1 partition nodes...". The
/// physical tag is the marker itself; the elementary tag, which Gmsh wants positive, numbers the different markers.
template <std::size_t Corners>
void write_elements(const mesh::ElementNodes& nodes, const std::vector<std::array<std::uint32_t, Corners>>& elements,
                    const std::vector<int>& markers, const std::vector<int>& partitions, std::int32_t type,
                    std::size_t& number, OutputFile& out) {
  if (nodes.are_second_order()) type = second_order_of(type);
  std::map<int, std::size_t> elementary;
  for (std::size_t i = 0; i < elements.size(); ++i)
    elementary.try_emplace(attribute_of(markers, i), elementary.size() + 1);
  const auto line = [&](std::size_t i, auto& text) {
    const int marker = attribute_of(markers, i);
    text << number + i + 1 << ' ' << type << (partitions.empty() ? " 2 " : " 4 ") << marker << ' '
         << elementary.at(marker);
    if (!partitions.empty()) text << " 1 " << partitions[i];
    for (std::size_t k = 0; k < nodes.per_element(Corners); ++k) text << ' ' << gmsh_node(nodes, elements[i], k) + 1;
    text << '\n';
  };
  write_lines(elements.size(), line, out);
  number += elements.size();
}

/// The elements of one dimension with the same marker, or those of them in one partition.
struct Entity {
  std::int32_t tag;
  int marker;
  std::vector<std::uint32_t> elements;
  std::int32_t parent = 0;  ///< the tag of the entity that this is a part of
  int partition = 0;
};

/// The geometric entities of one dimension. If the mesh has partitions, the elements belong to the parts.
struct Entities {
  std::vector<Entity> whole, parts;

  const std::vector<Entity>& with_elements() const { return parts.empty() ? whole : parts; }
};

/// \param partitions  of the elements; empty: there are none
Entities entities_of(ElementGroups by_marker, const std::vector<int>& partitions) {
  Entities entities;
  std::int32_t tag = 0;
  for (auto& [marker, elements] : by_marker) entities.whole.push_back({++tag, marker, std::move(elements)});
  if (partitions.empty()) return entities;
  for (const Entity& entity : entities.whole) {
    ElementGroups by_partition;
    for (const std::uint32_t i : entity.elements) by_partition[partitions[i]].push_back(i);
    for (auto& [partition, elements] : by_partition)
      entities.parts.push_back({++tag, entity.marker, std::move(elements), entity.tag, partition});
  }
  return entities;
}

/// Nodes belong to an entity, so there is a volume even if there are no tetrahedra.
ElementGroups volumes_of(const mesh::TetMesh& mesh) {
  ElementGroups volumes = group_elements(mesh.tetrahedra.size(), mesh.regions);
  if (volumes.empty()) volumes.try_emplace(0);
  return volumes;
}

OutputFile& put_integer(std::int32_t value, OutputFile& out) {
  return out.raw(value);
}
OutputFile& put_size(std::size_t value, OutputFile& out) {
  return out.raw(static_cast<std::uint64_t>(value));
}

/// "tag [parent-dimension parent-tag partitions] box physical-tags bounding-entities" for each entity. All have the box
/// of the whole mesh. A marker of 0 is written, too, although it means no group: meshio wants a physical tag for all
/// entities or for none.
void write_entities(const std::vector<Entity>& entities, std::int32_t dimension, const Box& box, OutputFile& out) {
  for (const Entity& entity : entities) {
    put_integer(entity.tag, out);
    if (entity.partition > 0) {
      put_integer(dimension, out).raw(entity.parent);
      put_size(1, out);
      put_integer(entity.partition, out);
    }
    for (const Point3& corner : {box.low, box.high}) out.raw(corner.x).raw(corner.y).raw(corner.z);
    put_size(1, out);
    put_integer(entity.marker, out);
    put_size(0, out);
  }
}

/// Curves, surfaces and volumes.
using AllEntities = std::array<Entities, 3>;

void write_all_entities(const AllEntities& entities, std::vector<Entity> Entities::*list, const Box& box,
                        OutputFile& out) {
  put_size(0, out);  // points
  for (const Entities& some : entities) put_size((some.*list).size(), out);
  for (std::int32_t dimension = 1; dimension <= 3; ++dimension)
    write_entities(entities[static_cast<std::size_t>(dimension - 1)].*list, dimension, box, out);
}

/// The parts of entities in partitions; no element is in several.
void write_partitioned_entities(const AllEntities& entities, const std::vector<int>& partitions, const Box& box,
                                OutputFile& out) {
  out << "$PartitionedEntities\n";
  put_size(static_cast<std::size_t>(*std::ranges::max_element(partitions)), out);
  put_size(0, out);  // ghosts
  write_all_entities(entities, &Entities::parts, box, out);
  out << "\n$EndPartitionedEntities\n";
}

/// For each entity a block "dimension tag type count", with "number nodes ..." for each element. The numbers of the
/// elements continue `before` in the order of the mesh, so that a reader can put them into that order.
template <std::size_t Corners>
void write_blocks(const mesh::ElementNodes& nodes, const std::vector<Entity>& entities,
                  const std::vector<std::array<std::uint32_t, Corners>>& elements, std::int32_t type,
                  std::size_t before, OutputFile& out) {
  if (nodes.are_second_order()) type = second_order_of(type);
  for (const Entity& entity : entities) {
    put_integer(Corners - 1, out).raw(entity.tag).raw(type);
    put_size(entity.elements.size(), out);
    for (const std::uint32_t i : entity.elements) {
      put_size(before + i + 1, out);
      for (std::size_t k = 0; k < nodes.per_element(Corners); ++k)
        put_size(std::size_t{gmsh_node(nodes, elements[i], k)} + 1, out);
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

/// One block of all nodes, in this volume.
void write_node_block(const mesh::ElementNodes& nodes, std::int32_t volume, OutputFile& out) {
  const std::size_t count = nodes.count();
  out << "$Nodes\n";
  for (const std::size_t n : {std::size_t{1}, count, std::size_t{1}, count}) put_size(n, out);
  put_integer(3, out).raw(volume).raw(std::int32_t{0});
  put_size(count, out);
  for (std::size_t i = 1; i <= count; ++i) put_size(i, out);
  for (std::size_t i = 0; i < count; ++i) {
    const Point3 p = nodes.point(i);
    out.raw(p.x).raw(p.y).raw(p.z);
  }
  out << "\n$EndNodes\n";
}

}  // namespace

void write_gmsh(const mesh::ElementNodes& nodes, OutputFile& out) {
  const mesh::TetMesh& mesh = nodes.mesh();
  out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
  write_claims(mesh, out);
  write_names(mesh.face_names, out);
  out << "$Nodes\n" << nodes.count() << '\n';
  const auto node = [&](std::size_t i, auto& text) { text << i + 1 << ' ' << nodes.point(i) << '\n'; };
  write_lines(nodes.count(), node, out);
  out << "$EndNodes\n$Elements\n" << mesh.edges.size() + mesh.faces.size() + mesh.tetrahedra.size() << '\n';
  std::size_t number = 0;
  const mesh::LowerPartitions lower = mesh::lower_partitions(mesh);
  write_elements(nodes, mesh.edges, mesh.edge_markers, lower.of_edges, gmsh_line, number, out);
  write_elements(nodes, mesh.faces, mesh.face_markers, lower.of_faces, gmsh_triangle, number, out);
  write_elements(nodes, mesh.tetrahedra, mesh.regions, mesh.partitions, gmsh_tetrahedron, number, out);
  out << "$EndElements\n";
}

void write_gmsh4(const mesh::ElementNodes& nodes, OutputFile& out) {
  const mesh::TetMesh& mesh = nodes.mesh();
  const mesh::LowerPartitions lower = mesh::lower_partitions(mesh);
  const AllEntities entities = {entities_of(group_elements(mesh.edges.size(), mesh.edge_markers), lower.of_edges),
                                entities_of(group_elements(mesh.faces.size(), mesh.face_markers), lower.of_faces),
                                entities_of(volumes_of(mesh), mesh.partitions)};
  out << "$MeshFormat\n4.1 1 8\n";
  put_integer(1, out) << "\n$EndMeshFormat\n";
  write_claims(mesh, out);

  write_names(mesh.face_names, out);
  const Box box = mesh.vertices.empty() ? Box() : bounding_box(mesh.vertices);
  out << "$Entities\n";
  write_all_entities(entities, &Entities::whole, box, out);
  out << "\n$EndEntities\n";
  if (!mesh.partitions.empty()) write_partitioned_entities(entities, mesh.partitions, box, out);

  const auto& [curves, surfaces, volumes] = entities;
  write_node_block(nodes, volumes.with_elements().front().tag, out);

  const std::size_t edges = mesh.edges.size(), faces = mesh.faces.size();
  const std::size_t elements = edges + faces + mesh.tetrahedra.size();
  out << "$Elements\n";
  std::size_t blocks = 0;
  for (const Entities& some : entities) blocks += some.with_elements().size();
  for (const std::size_t n : {blocks, elements, std::size_t{1}, elements}) put_size(n, out);
  write_blocks(nodes, curves.with_elements(), mesh.edges, gmsh_line, 0, out);
  write_blocks(nodes, surfaces.with_elements(), mesh.faces, gmsh_triangle, edges, out);
  write_blocks(nodes, volumes.with_elements(), mesh.tetrahedra, gmsh_tetrahedron, edges + faces, out);
  out << "\n$EndElements\n";
}

}  // namespace ccdt::io
