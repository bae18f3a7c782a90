#include "engine/io/formats.h"

namespace ccdt::io {

namespace {

/// An array of numbers in the text of the file.
///
/// \param line  as for `write_lines`
template <class Line>
void write_array(const char* type, std::size_t count, std::size_t columns, const Line& line, OutputFile& out) {
  out << "        <DataItem Dimensions=\"" << count << ' ' << columns << "\" NumberType=\"" << type
      << "\" Precision=\"8\" Format=\"XML\">\n";
  write_lines(count, line, out);
  out << "        </DataItem>\n";
}

/// All nodes, and elements of one kind with their attribute. FEniCS finds the mesh and its attribute by the name of the
/// grid.
template <std::size_t Corners>
void write_xdmf(const mesh::ElementNodes& nodes, const std::vector<std::array<std::uint32_t, Corners>>& elements,
                const std::string& type, const char* attribute, const std::vector<int>& attributes, OutputFile& out) {
  const std::size_t per_element = nodes.per_element(Corners);
  out << "<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\">\n  <Domain>\n"
         "    <Grid Name=\"mesh\" GridType=\"Uniform\">\n      <Topology TopologyType=\""
      << type << (nodes.are_second_order() ? "_" + std::to_string(per_element) : "") << "\" NumberOfElements=\""
      << elements.size() << "\" NodesPerElement=\"" << per_element << "\">\n";
  const auto element = [&](std::size_t i, auto& text) {
    for (std::size_t k = 0; k < per_element; ++k) text << (k > 0 ? " " : "") << nodes.node(elements[i], k);
    text << '\n';
  };
  write_array("Int", elements.size(), per_element, element, out);
  out << "      </Topology>\n      <Geometry GeometryType=\"XYZ\">\n";
  const auto point = [&](std::size_t i, auto& text) { text << nodes.point(i) << '\n'; };
  write_array("Float", nodes.count(), 3, point, out);
  out << "      </Geometry>\n      <Attribute Name=\"" << attribute << "\" AttributeType=\"Scalar\" Center=\"Cell\">\n";
  const auto value = [&](std::size_t i, auto& text) { text << attribute_of(attributes, i) << '\n'; };
  write_array("Int", elements.size(), 1, value, out);
  out << "      </Attribute>\n    </Grid>\n  </Domain>\n</Xdmf>\n";
}

}  // namespace

void write_xdmf_files(const mesh::ElementNodes& nodes, const std::filesystem::path& file) {
  write_with_boundary(
      nodes, file, ".boundary.xdmf",
      [](const mesh::ElementNodes& all, OutputFile& out) {
        write_xdmf(all, all.mesh().tetrahedra, "Tetrahedron", "region", all.mesh().regions, out);
      },
      [](const mesh::ElementNodes& all, OutputFile& out) {
        write_xdmf(all, all.mesh().faces, "Triangle", "marker", all.mesh().face_markers, out);
      });
}

}  // namespace ccdt::io
