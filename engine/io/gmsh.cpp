#include <algorithm>
#include <numeric>
#include <unordered_map>
#include <utility>

#include "engine/io/formats.h"
#include "engine/io/gmsh_source.h"
#include "engine/io/gmsh_types.h"
#include "engine/io/mesh_surface.h"

namespace ccdt::io {

namespace {

std::string end_of(std::string_view section) {
  return "$End" + std::string(section.substr(1));
}

constexpr const char* version_remedy = "save the mesh as version 2.2 or 4.1";

/// Puts elements and their markers into the order of the elements' numbers.
template <std::size_t Corners>
void sort_by_number(std::vector<std::int64_t>& numbers, std::vector<std::array<std::uint32_t, Corners>>& elements,
                    std::vector<int>& markers) {
  if (std::ranges::is_sorted(numbers)) return;
  std::vector<std::size_t> order(numbers.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return numbers[i]; });
  const auto arranged = [&](auto values) {
    std::ranges::transform(order, values.begin(), [&, old = values](std::size_t i) { return old[i]; });
    return values;
  };
  elements = arranged(std::move(elements));
  markers = arranged(std::move(markers));
}

/// Reads the versions 2.x and 4.1, in text and in binary, section by section.
class GmshReader {
 public:
  explicit GmshReader(const FileBytes& file) : in_(file) {}

  mesh::TetMesh read() {
    TextScanner& text = in_.text();
    bool has_elements = false;
    while (!text.at_end()) {
      const std::string_view section = text.word("section");
      if (!section.starts_with("$") || section.size() < 2 || section.starts_with("$End"))
        text.fail("section", "expected the start of a section ($...), found " + in_quotes(section));
      if (section == "$MeshFormat")
        read_format();
      else if (section == "$PhysicalNames")
        read_names();
      else if (section != "$Nodes" && section != "$Elements" && (!is_entities(section) || version_ != 4))
        skip_section(section);
      else if (version_ == 0)
        text.fail(section, "there is no $MeshFormat before it", version_remedy);
      else
        read_section(section);
      has_elements = has_elements || section == "$Elements";
      text.expect(section, end_of(section), "correct the counts of this section, or export the file again");
    }
    if (!has_elements) text.fail_truncated("$Elements");
    sort_by_number(edge_numbers_, mesh_.edges, mesh_.edge_markers);
    sort_by_number(face_numbers_, mesh_.faces, mesh_.face_markers);
    sort_by_number(tetrahedron_numbers_, mesh_.tetrahedra, mesh_.regions);
    if (version_ == 4) drop_missing_markers();
    return std::move(mesh_);
  }

 private:
  /// Without physical groups there are no markers. (Version 2 has a tag for each element, which is 0.)
  void drop_missing_markers() {
    if (physical_tags_[1].empty() && physical_tags_[2].empty()) mesh_.face_markers.clear(), mesh_.edge_markers.clear();
  }

  static bool is_entities(std::string_view section) {
    return section == "$Entities" || section == "$PartitionedEntities";
  }

  void read_format() {
    const Item item = "$MeshFormat";
    TextScanner& text = in_.text();
    const std::string_view version = text.word(item);
    const bool is_2 = version.starts_with("2");
    if (!is_2 && version != "4.1")
      text.fail(item, "version " + in_quotes(version) + " is not supported", version_remedy);
    version_ = is_2 ? 2 : 4;
    const std::int64_t mode = text.integer(item);
    const std::int64_t size = text.integer(item);
    if (mode == 0) return;
    if (mode != 1) text.fail(item, "it is neither text nor binary", version_remedy);
    if (size != 8) text.fail(item, "its numbers have " + std::to_string(size) + " bytes, not 8", version_remedy);
    in_.become_binary(item);
  }

  void skip_section(std::string_view section) {
    TextScanner& text = in_.text();
    if (in_.is_binary()) return in_.skip_to(end_of(section), section);
    while (text.peek() != end_of(section)) {
      text.word(section);
      text.skip_line();
    }
  }

  void read_section(std::string_view section) {
    if (version_ == 4) in_.begin_numbers();
    if (is_entities(section))
      read_entities(section != "$Entities");
    else if (section == "$Nodes")
      version_ == 2 ? read_nodes_2() : read_nodes_4();
    else if (version_ == 4)
      read_elements_4();
    else
      in_.is_binary() ? read_binary_elements_2() : read_elements_2();
    in_.end_numbers();
  }

  /// Counts of points, curves, surfaces and volumes; then for each "tag box physical-tags [bounding entities]". If they
  /// are parts of entities in partitions, the number of partitions and a list of ghosts come first, and after each tag
  /// "parent-dimension parent-tag partitions".
  void read_entities(bool are_parts) {
    const Item item = "entity";
    if (are_parts) {
      in_.size(item);
      in_.skip_integers(item, 2 * in_.count(item, 4, 8));
    }
    std::array<std::size_t, 4> counts;
    for (std::size_t& count : counts) count = in_.count(item, 10, 36);
    for (std::size_t dimension = 0; dimension < 4; ++dimension) {
      for (std::size_t i = 0; i < counts[dimension]; ++i) {
        const std::int64_t tag = in_.integer(item);
        if (are_parts) {
          in_.skip_integers(item, 2);
          in_.skip_integers(item, in_.count(item, 2, 4));
        }
        in_.skip_numbers(item, dimension == 0 ? 3 : 6);
        const std::size_t tags = in_.count(item, 2, 4);
        if (tags > 0) physical_tags_[dimension][tag] = in_.attribute(item);
        for (std::size_t k = 1; k < tags; ++k) in_.attribute(item);
        if (dimension > 0) in_.skip_integers(item, in_.count(item, 2, 4));
      }
    }
  }

  /// A count, then lines "dimension tag "name"", which are always text. Those of surfaces are kept.
  void read_names() {
    const Item item = "physical name";
    TextScanner& text = in_.text();
    const std::size_t count = text.count(item, 6);
    for (std::size_t i = 0; i < count; ++i) {
      const std::int64_t dimension = text.integer(item);
      const int tag = text.attribute(item);
      std::string_view name = text.rest_of_line();
      if (name.size() < 2 || name.front() != '"' || name.back() != '"')
        text.fail(item, "expected a name in quotes, found " + in_quotes(name));
      if (dimension == 2) mesh_.face_names[tag] = name.substr(1, name.size() - 2);
    }
  }

  /// The count of a section of version 2, which is text even if the section is binary.
  std::size_t read_count_2(const Item& item, std::size_t least_bytes_each) {
    const std::size_t count = in_.text().count(item, least_bytes_each);
    in_.begin_numbers();
    return count;
  }

  /// "tag x y z" each
  void read_nodes_2() {
    const std::size_t count = read_count_2("number of nodes", 8);
    mesh_.vertices.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
      const Item vertex{"vertex", i};
      add_node(vertex, in_.integer(vertex), mesh_.vertices.size());
      mesh_.vertices.push_back(in_.point(vertex));
    }
  }

  /// "number type tags physical elementary ... nodes ..." each
  void read_elements_2() {
    const std::size_t count = read_count_2("number of elements", 8);
    for (std::size_t i = 0; i < count; ++i) {
      const Item item{"element", i};
      const std::int64_t number = in_.integer(item), type = in_.integer(item);
      read_element(item, number, type, read_tags_2(item, in_.short_count(item, 2, 4)));
    }
  }

  /// Blocks "type elements tags" of elements "number physical elementary ... nodes ..."
  void read_binary_elements_2() {
    const std::size_t count = read_count_2("number of elements", 8);
    for (std::size_t i = 0; i < count;) {
      const Item block{"block of elements before element", i};
      const std::int64_t type = in_.integer(block);
      const std::size_t elements = in_.short_count(block, 2, 8), tags = in_.short_count(block, 2, 0);
      if (elements == 0 || elements > count - i)
        in_.fail(block, "it claims " + std::to_string(elements) + " of " + std::to_string(count - i) + " elements");
      for (const std::size_t end = i + elements; i < end; ++i) {
        const Item item{"element", i};
        const std::int64_t number = in_.integer(item);
        read_element(item, number, type, read_tags_2(item, tags));
      }
    }
  }

  /// \return the first tag, the physical one, or 0
  int read_tags_2(const Item& item, std::size_t tags) {
    const int physical = tags > 0 ? in_.attribute(item) : 0;
    for (std::size_t k = 1; k < tags; ++k) in_.integer(item);
    return physical;
  }

  /// "blocks nodes smallest largest"; a block is "dimension tag parametric count", the nodes' tags, their coordinates.
  void read_nodes_4() {
    const std::size_t blocks = in_.count("number of blocks", 8, 20), total = in_.count("number of nodes", 8, 32);
    skip_range("number of nodes");
    mesh_.vertices.reserve(total);
    for (std::size_t b = 0; b < blocks; ++b) {
      const Item block{"block of nodes", b};
      const std::size_t dimension = read_dimension(block);
      in_.integer(block);
      const std::size_t parameters = in_.integer(block) != 0 ? dimension : 0;
      const std::size_t count = in_.count(block, 8, 32), first = mesh_.vertices.size();
      for (std::size_t i = 0; i < count; ++i) add_node(block, in_.size(block), first + i);
      for (std::size_t i = 0; i < count; ++i) {
        const Item vertex{"vertex", first + i};
        mesh_.vertices.push_back(in_.point(vertex));
        in_.skip_numbers(vertex, parameters);
      }
    }
  }

  /// "blocks elements smallest largest"; a block is "dimension tag type count", then "number nodes ..." for each
  /// element.
  void read_elements_4() {
    const std::size_t blocks = in_.count("number of blocks", 8, 20);
    in_.count("number of elements", 4, 16);
    skip_range("number of elements");
    for (std::size_t b = 0; b < blocks; ++b) {
      const Item block{"block of elements", b};
      const auto& tags = physical_tags_[read_dimension(block)];
      const auto physical = tags.find(in_.integer(block));
      const int marker = physical == tags.end() ? 0 : physical->second;
      const std::int64_t type = in_.integer(block);
      const std::size_t count = in_.count(block, 4, 16);
      for (std::size_t i = 0; i < count; ++i) {
        const Item item{"element", i};
        const std::int64_t number = in_.size(item);
        read_element(item, number, type, marker);
      }
    }
  }

  /// The smallest and the largest number.
  void skip_range(const Item& item) {
    if (!in_.is_binary()) return in_.skip_line();
    in_.size(item);
    in_.size(item);
  }

  std::size_t read_dimension(const Item& block) {
    const std::int64_t dimension = in_.integer(block);
    if (dimension < 0 || dimension > 3) in_.fail(block, "its dimension is " + std::to_string(dimension));
    return static_cast<std::size_t>(dimension);
  }

  /// Reads the nodes of an element and adds it to the mesh. Points are skipped.
  void read_element(const Item& item, std::int64_t number, std::int64_t type, int marker) {
    if (type == gmsh_line)
      add_element(item, marker, mesh_.edges, mesh_.edge_markers), edge_numbers_.push_back(number);
    else if (type == gmsh_triangle)
      add_element(item, marker, mesh_.faces, mesh_.face_markers), face_numbers_.push_back(number);
    else if (type == gmsh_tetrahedron)
      add_element(item, marker, mesh_.tetrahedra, mesh_.regions), tetrahedron_numbers_.push_back(number);
    else if (type == gmsh_point)
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

  /// Gmsh's nodes may have any positive numbers, usually 1, 2, 3, ...
  void add_node(const Item& item, std::int64_t tag, std::size_t index) {
    if (other_tags_.empty() && index == consecutive_tags_ && tag == static_cast<std::int64_t>(index) + 1)
      ++consecutive_tags_;
    else if (is_consecutive(tag) || !other_tags_.emplace(tag, static_cast<std::uint32_t>(index)).second)
      in_.fail(item, "there are two nodes with the number " + std::to_string(tag));
  }

  std::uint32_t read_index(const Item& item) {
    const std::int64_t tag = version_ == 4 ? in_.size(item) : in_.integer(item);
    if (is_consecutive(tag)) return static_cast<std::uint32_t>(tag - 1);
    const auto found = other_tags_.find(tag);
    if (found == other_tags_.end())
      in_.fail(item, "vertex index " + std::to_string(tag) + " is out of range: there is no such node");
    return found->second;
  }

  bool is_consecutive(std::int64_t tag) const {
    return tag >= 1 && tag <= static_cast<std::int64_t>(consecutive_tags_);
  }

  GmshSource in_;
  int version_ = 0;  ///< 2 or 4
  mesh::TetMesh mesh_;
  std::vector<std::int64_t> edge_numbers_, face_numbers_, tetrahedron_numbers_;
  std::size_t consecutive_tags_ = 0;  ///< the node with index i < consecutive_tags_ has the tag i + 1
  std::unordered_map<std::int64_t, std::uint32_t> other_tags_;
  /// The first physical tag of an entity, by its dimension and tag; missing if it has none.
  std::array<std::unordered_map<std::int64_t, int>, 4> physical_tags_;
};

}  // namespace

plc::InputPlc read_gmsh_plc(const FileBytes& file) {
  return surface_of(GmshReader(file).read());
}

mesh::TetMesh read_gmsh(const FileBytes& file) {
  mesh::TetMesh mesh = GmshReader(file).read();
  take_claims(head_of(file), mesh);
  return mesh;
}

}  // namespace ccdt::io
