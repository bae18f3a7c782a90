#include "engine/io/gmsh_parts.h"

namespace ccdt::io {

namespace {

/// Counts of points, curves, surfaces and volumes; then for each "tag box physical-tags [bounding entities]".
void read_entities(TextScanner& in, GmshPhysicalTags& tags) {
  const Item item{"entity"};
  std::array<std::size_t, 4> counts;
  for (std::size_t& count : counts) count = in.count(item, 10);
  for (std::size_t dimension = 0; dimension < 4; ++dimension) {
    for (std::size_t i = 0; i < counts[dimension]; ++i) {
      const std::int64_t tag = in.integer(item);
      for (int k = 0; k < (dimension == 0 ? 3 : 6); ++k) in.number(item);
      const std::size_t physical = in.count(item, 2);
      for (std::size_t k = 0; k < physical; ++k) {
        const int value = in.attribute(item);
        if (k == 0) tags[dimension][tag] = value;
      }
      const std::size_t bounding = dimension == 0 ? 0 : in.count(item, 2);
      for (std::size_t k = 0; k < bounding; ++k) in.integer(item);
    }
  }
}

std::size_t read_dimension(TextScanner& in, const Item& block) {
  const std::int64_t dimension = in.integer(block);
  if (dimension < 0 || dimension > 3) in.fail(block, "its dimension is " + std::to_string(dimension));
  return static_cast<std::size_t>(dimension);
}

/// "blocks nodes smallest largest"; a block is "dimension tag parametric count", the nodes' tags, their coordinates.
void read_nodes(TextScanner& in, GmshNodes& nodes, TetMesh& mesh) {
  const std::size_t blocks = in.count({"number of blocks"}, 8), total = in.count({"number of nodes"}, 8);
  in.skip_line();
  mesh.vertices.reserve(total);
  for (std::size_t b = 0; b < blocks; ++b) {
    const Item block{"block of nodes", static_cast<std::int64_t>(b)};
    const std::size_t dimension = read_dimension(in, block);
    in.integer(block);
    const std::size_t parameters = in.integer(block) != 0 ? dimension : 0;
    const std::size_t count = in.count(block, 8), first = mesh.vertices.size();
    for (std::size_t i = 0; i < count; ++i) nodes.add(in, block, in.integer(block), first + i);
    for (std::size_t i = 0; i < count; ++i) {
      const Item vertex{"vertex", static_cast<std::int64_t>(first + i)};
      mesh.vertices.push_back(in.point(vertex));
      for (std::size_t k = 0; k < parameters; ++k) in.word(vertex);
    }
  }
}

/// "blocks elements smallest largest"; a block is "dimension tag type count", then "number nodes ..." an element.
void read_elements(TextScanner& in, const GmshPhysicalTags& tags, const GmshNodes& nodes, TetMesh& mesh) {
  const std::size_t blocks = in.count({"number of blocks"}, 8);
  in.skip_line();
  for (std::size_t b = 0; b < blocks; ++b) {
    const Item block{"block of elements", static_cast<std::int64_t>(b)};
    const std::size_t dimension = read_dimension(in, block);
    const auto physical = tags[dimension].find(in.integer(block));
    const int marker = physical == tags[dimension].end() ? 0 : physical->second;
    const std::int64_t type = in.integer(block);
    const std::size_t count = in.count(block, 4);
    for (std::size_t i = 0; i < count; ++i) {
      const Item item{"element", static_cast<std::int64_t>(i)};
      in.integer(item);
      read_gmsh_element(in, item, type, marker, nodes, mesh);
    }
  }
}

}  // namespace

void read_gmsh4_section(TextScanner& in, std::string_view section, GmshPhysicalTags& tags, GmshNodes& nodes,
                        TetMesh& mesh) {
  if (section == "$Entities")
    read_entities(in, tags);
  else if (section == "$Nodes")
    read_nodes(in, nodes, mesh);
  else
    read_elements(in, tags, nodes, mesh);
}

}  // namespace ccdt::io
