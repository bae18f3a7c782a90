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

/// All vertices, and elements of one kind with their attribute. FEniCS finds the mesh and its attribute by the name of
/// the grid.
template <std::size_t Corners>
void write_xdmf(const std::vector<Point3>& vertices, const char* type,
                const std::vector<std::array<std::uint32_t, Corners>>& elements, const char* attribute,
                const std::vector<int>& attributes, OutputFile& out) {
  out << "<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\">\n  <Domain>\n"
         "    <Grid Name=\"mesh\" GridType=\"Uniform\">\n      <Topology TopologyType=\""
      << type << "\" NumberOfElements=\"" << elements.size() << "\" NodesPerElement=\"" << Corners << "\">\n";
  const auto element = [&](std::size_t i, auto& text) {
    write_corners(elements[i], text, 0);
    text << '\n';
  };
  write_array("Int", elements.size(), Corners, element, out);
  out << "      </Topology>\n      <Geometry GeometryType=\"XYZ\">\n";
  const auto point = [&](std::size_t i, auto& text) { text << vertices[i] << '\n'; };
  write_array("Float", vertices.size(), 3, point, out);
  out << "      </Geometry>\n      <Attribute Name=\"" << attribute << "\" AttributeType=\"Scalar\" Center=\"Cell\">\n";
  const auto value = [&](std::size_t i, auto& text) { text << attribute_of(attributes, i) << '\n'; };
  write_array("Int", elements.size(), 1, value, out);
  out << "      </Attribute>\n    </Grid>\n  </Domain>\n</Xdmf>\n";
}

}  // namespace

void write_xdmf_files(const mesh::TetMesh& mesh, const std::filesystem::path& file) {
  write_with_boundary(
      mesh, file, ".boundary.xdmf",
      [](const mesh::TetMesh& m, OutputFile& out) {
        write_xdmf(m.vertices, "Tetrahedron", m.tetrahedra, "region", m.regions, out);
      },
      [](const mesh::TetMesh& m, OutputFile& out) {
        write_xdmf(m.vertices, "Triangle", m.faces, "marker", m.face_markers, out);
      });
}

}  // namespace ccdt::io
