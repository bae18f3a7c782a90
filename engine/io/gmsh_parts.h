#pragma once

#include <unordered_map>

#include "engine/io/text_scanner.h"
#include "engine/mesh/tet_mesh.h"

/// What the versions 2 and 4.1 of Gmsh's ASCII format have in common.
namespace ccdt::io {

/// Gmsh's nodes have any positive numbers, mostly but not always 1, 2, 3, ...
class GmshNodes {
 public:
  void add(TextScanner& in, const Item& item, std::int64_t tag, std::size_t index);
  std::uint32_t read_index(TextScanner& in, const Item& item) const;

 private:
  std::size_t consecutive_ = 0;  ///< the node with index i < consecutive_ has the tag i + 1
  std::unordered_map<std::int64_t, std::uint32_t> others_;
};

/// Reads the nodes of an element and adds it to the mesh. Points are skipped.
/// \throw InputError  another type than point, line, triangle and tetrahedron
void read_gmsh_element(TextScanner& in, const Item& item, std::int64_t type, int marker, const GmshNodes& nodes,
                       TetMesh& mesh);

/// Reads the line "$End..." of a section.
void expect_section_end(TextScanner& in, std::string_view section);

/// Versions 2.x: $Nodes and $Elements.
void read_gmsh2_section(TextScanner& in, std::string_view section, GmshNodes& nodes, TetMesh& mesh);

/// The first physical tag of an entity, by its dimension and tag; 0 if it has none.
using GmshPhysicalTags = std::array<std::unordered_map<std::int64_t, int>, 4>;

/// Version 4.1: $Entities, $Nodes and $Elements.
void read_gmsh4_section(TextScanner& in, std::string_view section, GmshPhysicalTags& tags, GmshNodes& nodes,
                        TetMesh& mesh);

}  // namespace ccdt::io
