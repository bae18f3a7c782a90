#include <map>
#include <unordered_map>

#include "engine/io/formats.h"
#include "engine/io/text_scanner.h"

namespace ccdt::io {

namespace {

constexpr std::int64_t line = 1, triangle = 2, tetrahedron = 4, point = 15;  // Gmsh's types of elements

std::string end_of(std::string_view section) {
  return "$End" + std::string(section.substr(1));
}

/// Reads the versions 2.x and 4.1, ASCII, section by section.
class GmshReader {
 public:
  explicit GmshReader(const FileBytes& file) : in_(file, TextScanner::no_comments) {}

  mesh::TetMesh read() {
    int version = 0;
    bool has_elements = false;
    while (!in_.at_end()) {
      const std::string_view section = in_.word("section");
      if (!section.starts_with("$") || section.size() < 2 || section.starts_with("$End"))
        in_.fail("section", "expected the start of a section ($...), found " + in_quotes(section));
      if (section == "$MeshFormat") {
        version = read_format();
      } else if (section != "$Nodes" && section != "$Elements" && (section != "$Entities" || version != 4)) {
        while (in_.word(section) != end_of(section)) in_.skip_line();
        continue;
      } else if (version == 0) {
        in_.fail(section, "there is no $MeshFormat before it", "save the mesh as version 2.2 or 4.1, ASCII");
      } else if (section == "$Entities") {
        read_entities();
      } else if (section == "$Nodes") {
        version == 2 ? read_nodes_2() : read_nodes_4();
      } else {
        version == 2 ? read_elements_2() : read_elements_4();
        has_elements = true;
      }
      in_.expect(section, end_of(section), "correct the counts of this section, or export the file again");
    }
    if (!has_elements) in_.fail_truncated("$Elements");
    return std::move(mesh_);
  }

 private:
  /// \return the major version: 2 or 4
  int read_format() {
    const Item item = "$MeshFormat";
    const std::string_view version = in_.word(item);
    const bool is_2 = version.starts_with("2");
    if (!is_2 && version != "4.1")
      in_.fail(item, "version " + in_quotes(version) + " is not supported",
               "save the mesh as version 2.2 or 4.1, ASCII");
    if (in_.integer(item) != 0)
      in_.fail(item, "the file is binary", "save the mesh as ASCII (gmsh -save -format msh2 -bin 0)");
    in_.integer(item);
    return is_2 ? 2 : 4;
  }

  /// Counts of points, curves, surfaces and volumes; then for each "tag box physical-tags [bounding entities]".
  void read_entities() {
    const Item item = "entity";
    std::array<std::size_t, 4> counts;
    for (std::size_t& count : counts) count = in_.count(item, 10);
    for (std::size_t dimension = 0; dimension < 4; ++dimension) {
      for (std::size_t i = 0; i < counts[dimension]; ++i) {
        const std::int64_t tag = in_.integer(item);
        for (int k = 0; k < (dimension == 0 ? 3 : 6); ++k) in_.number(item);
        const std::size_t tags = in_.count(item, 2);
        if (tags > 0) physical_tags_[dimension][tag] = in_.attribute(item);
        for (std::size_t k = 1; k < tags; ++k) in_.attribute(item);
        const std::size_t bounding = dimension == 0 ? 0 : in_.count(item, 2);
        for (std::size_t k = 0; k < bounding; ++k) in_.integer(item);
      }
    }
  }

  /// "tag x y z" each
  void read_nodes_2() {
    const std::size_t count = in_.count("number of nodes", 8);
    mesh_.vertices.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
      const Item vertex{"vertex", i};
      add_node(vertex, mesh_.vertices.size());
      mesh_.vertices.push_back(in_.point(vertex));
    }
  }

  /// "number type tags physical elementary ... nodes ..." each
  void read_elements_2() {
    const std::size_t count = in_.count("number of elements", 8);
    for (std::size_t i = 0; i < count; ++i) {
      const Item item{"element", i};
      in_.integer(item);
      const std::int64_t type = in_.integer(item);
      const std::size_t tags = in_.count(item, 2);
      const int physical = tags > 0 ? in_.attribute(item) : 0;
      for (std::size_t k = 1; k < tags; ++k) in_.integer(item);
      read_element(item, type, physical);
    }
  }

  /// "blocks nodes smallest largest"; a block is "dimension tag parametric count", the nodes' tags, their coordinates.
  void read_nodes_4() {
    const std::size_t blocks = in_.count("number of blocks", 8), total = in_.count("number of nodes", 8);
    in_.skip_line();
    mesh_.vertices.reserve(total);
    for (std::size_t b = 0; b < blocks; ++b) {
      const Item block{"block of nodes", b};
      const std::size_t dimension = read_dimension(block);
      in_.integer(block);
      const std::size_t parameters = in_.integer(block) != 0 ? dimension : 0;
      const std::size_t count = in_.count(block, 8), first = mesh_.vertices.size();
      for (std::size_t i = 0; i < count; ++i) add_node(block, first + i);
      for (std::size_t i = 0; i < count; ++i) {
        const Item vertex{"vertex", first + i};
        mesh_.vertices.push_back(in_.point(vertex));
        for (std::size_t k = 0; k < parameters; ++k) in_.word(vertex);
      }
    }
  }

  /// "blocks elements smallest largest"; a block is "dimension tag type count", then "number nodes ..." an element.
  void read_elements_4() {
    const std::size_t blocks = in_.count("number of blocks", 8);
    in_.skip_line();
    for (std::size_t b = 0; b < blocks; ++b) {
      const Item block{"block of elements", b};
      const auto& tags = physical_tags_[read_dimension(block)];
      const auto physical = tags.find(in_.integer(block));
      const int marker = physical == tags.end() ? 0 : physical->second;
      const std::int64_t type = in_.integer(block);
      const std::size_t count = in_.count(block, 4);
      for (std::size_t i = 0; i < count; ++i) {
        const Item item{"element", i};
        in_.integer(item);
        read_element(item, type, marker);
      }
    }
  }

  std::size_t read_dimension(const Item& block) {
    const std::int64_t dimension = in_.integer(block);
    if (dimension < 0 || dimension > 3) in_.fail(block, "its dimension is " + std::to_string(dimension));
    return static_cast<std::size_t>(dimension);
  }

  /// Reads the nodes of an element and adds it to the mesh. Points are skipped.
  void read_element(const Item& item, std::int64_t type, int marker) {
    if (type == line)
      add_element(item, marker, mesh_.edges, mesh_.edge_markers);
    else if (type == triangle)
      add_element(item, marker, mesh_.faces, mesh_.face_markers);
    else if (type == tetrahedron)
      add_element(item, marker, mesh_.tetrahedra, mesh_.regions);
    else if (type == point)
      read_index(item);
    else
      in_.fail(item, "elements of type " + std::to_string(type) + " are not supported",
               "write linear tetrahedra, triangles and lines only");
  }

  template <std::size_t Corners>
  void add_element(const Item& item, int marker, std::vector<std::array<std::uint32_t, Corners>>& elements,
                   std::vector<int>& markers) {
    std::array<std::uint32_t, Corners> corners;
    for (std::uint32_t& corner : corners) corner = read_index(item);
    elements.push_back(corners);
    markers.push_back(marker);
  }

  /// Reads the tag of a node. Gmsh's nodes have any positive numbers, mostly but not always 1, 2, 3, ...
  void add_node(const Item& item, std::size_t index) {
    const std::int64_t tag = in_.integer(item);
    if (other_tags_.empty() && index == consecutive_tags_ && tag == static_cast<std::int64_t>(index) + 1)
      ++consecutive_tags_;
    else if (is_consecutive(tag) || !other_tags_.emplace(tag, static_cast<std::uint32_t>(index)).second)
      in_.fail(item, "there are two nodes with the number " + std::to_string(tag));
  }

  std::uint32_t read_index(const Item& item) {
    const std::int64_t tag = in_.integer(item);
    if (is_consecutive(tag)) return static_cast<std::uint32_t>(tag - 1);
    const auto found = other_tags_.find(tag);
    if (found == other_tags_.end())
      in_.fail(item, "vertex index " + std::to_string(tag) + " is out of range: there is no such node");
    return found->second;
  }

  bool is_consecutive(std::int64_t tag) const {
    return tag >= 1 && tag <= static_cast<std::int64_t>(consecutive_tags_);
  }

  TextScanner in_;
  mesh::TetMesh mesh_;
  std::size_t consecutive_tags_ = 0;  ///< the node with index i < consecutive_tags_ has the tag i + 1
  std::unordered_map<std::int64_t, std::uint32_t> other_tags_;
  /// The first physical tag of an entity, by its dimension and tag; missing if it has none.
  std::array<std::unordered_map<std::int64_t, int>, 4> physical_tags_;
};

/// Lines "number type 2 physical elementary nodes...". The physical tag is the marker as it is; the elementary tag,
/// which Gmsh wants positive, numbers the different markers.
template <std::size_t Corners>
void write_elements(const std::vector<std::array<std::uint32_t, Corners>>& elements, const std::vector<int>& markers,
                    std::int64_t type, std::size_t& number, OutputFile& out) {
  std::map<int, std::size_t> elementary;
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const int marker = attribute_of(markers, i);
    const std::size_t entity = elementary.try_emplace(marker, elementary.size() + 1).first->second;
    out << ++number << ' ' << type << " 2 " << marker << ' ' << entity;
    write_corners(elements[i], out);
    out << '\n';
  }
}

}  // namespace

mesh::TetMesh read_gmsh(const FileBytes& file) {
  mesh::TetMesh mesh = GmshReader(file).read();
  mesh.constrained_delaunay = has_claim(file, constrained_delaunay_claim);
  return mesh;
}

/// Version 2.2, which most programs read.
void write_gmsh(const mesh::TetMesh& mesh, OutputFile& out) {
  out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
  if (mesh.constrained_delaunay) out << "$Comments\n" << constrained_delaunay_claim << "\n$EndComments\n";
  out << "$Nodes\n" << mesh.vertices.size() << '\n';
  write_numbered(mesh.vertices, out);
  out << "$EndNodes\n$Elements\n" << mesh.edges.size() + mesh.faces.size() + mesh.tetrahedra.size() << '\n';
  std::size_t number = 0;
  write_elements(mesh.edges, mesh.edge_markers, line, number, out);
  write_elements(mesh.faces, mesh.face_markers, triangle, number, out);
  write_elements(mesh.tetrahedra, mesh.regions, tetrahedron, number, out);
  out << "$EndElements\n";
}

}  // namespace ccdt::io
