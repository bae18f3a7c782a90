#include <bit>
#include <cstdint>

#include "engine/io/tet_mesh_formats.h"

namespace ccdt::io {

namespace {

static_assert(std::endian::native == std::endian::little, "arrays are written as they are in memory");

constexpr int line = 3, triangle = 5, tetrahedron = 10;  // VTK's cell types

/// Declares the arrays one by one; each is appended behind the XML with its length before it.
class Arrays {
 public:
  Arrays(OutputFile& out) : out_(out) {}

  void declare(const char* type, const char* name, std::size_t bytes, const char* more = "") {
    out_ << "        <DataArray type=\"" << type << "\" Name=\"" << name << "\"" << more
         << " format=\"appended\" offset=\"" << offset_ << "\"/>\n";
    offset_ += sizeof(std::uint64_t) + bytes;
  }

 private:
  OutputFile& out_;
  std::size_t offset_ = 0;
};

struct Sizes {
  std::size_t vertices, cells, corners;
};

void write_outline(const TetMesh& mesh, const Sizes& n, OutputFile& out) {
  out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
         "header_type=\"UInt64\">\n  <UnstructuredGrid>\n    <FieldData>\n      <DataArray type=\"Int32\" "
         "Name=\"constrained_delaunay\" NumberOfTuples=\"1\" format=\"ascii\">"
      << (mesh.constrained_delaunay ? 1 : 0) << "</DataArray>\n    </FieldData>\n    <Piece NumberOfPoints=\""
      << n.vertices << "\" NumberOfCells=\"" << n.cells << "\">\n";
  Arrays arrays(out);
  out << "      <Points>\n";
  arrays.declare("Float64", "Points", 24 * n.vertices, " NumberOfComponents=\"3\"");
  out << "      </Points>\n      <Cells>\n";
  arrays.declare("Int64", "connectivity", 8 * n.corners);
  arrays.declare("Int64", "offsets", 8 * n.cells);
  arrays.declare("UInt8", "types", n.cells);
  out << "      </Cells>\n      <CellData Scalars=\"region\">\n";
  arrays.declare("Int32", "region", 4 * n.cells);
  arrays.declare("Int32", "marker", 4 * n.cells);
  out << "      </CellData>\n    </Piece>\n  </UnstructuredGrid>\n  <AppendedData encoding=\"raw\">\n_";
}

template <class Elements>
void write_connectivity(const Elements& elements, OutputFile& out) {
  for (const auto& corners : elements)
    for (const std::uint32_t v : corners) out.raw(static_cast<std::int64_t>(v));
}

void write_offsets(std::size_t count, int corners, std::int64_t& offset, OutputFile& out) {
  for (std::size_t i = 0; i < count; ++i) out.raw(offset += corners);
}

void write_types(std::size_t count, int type, OutputFile& out) {
  for (std::size_t i = 0; i < count; ++i) out.raw(static_cast<std::uint8_t>(type));
}

void write_attributes(std::size_t count, const std::vector<int>& attributes, OutputFile& out) {
  for (std::size_t i = 0; i < count; ++i) out.raw(static_cast<std::int32_t>(attribute_of(attributes, i)));
}

}  // namespace

/// Tetrahedra come first, then the faces and edges on facets and segments. `region` is of the tetrahedra, `marker` of
/// the others; each is 0 where the other one counts.
void write_vtu(const TetMesh& mesh, OutputFile& out) {
  const std::size_t tetrahedra = mesh.tetrahedra.size(), faces = mesh.faces.size(), edges = mesh.edges.size();
  const Sizes n{mesh.vertices.size(), tetrahedra + faces + edges, 4 * tetrahedra + 3 * faces + 2 * edges};
  const auto begin_array = [&](std::size_t bytes) { out.raw(static_cast<std::uint64_t>(bytes)); };
  write_outline(mesh, n, out);
  begin_array(24 * n.vertices);
  for (const Point3& p : mesh.vertices) out.raw(p.x).raw(p.y).raw(p.z);
  begin_array(8 * n.corners);
  write_connectivity(mesh.tetrahedra, out);
  write_connectivity(mesh.faces, out);
  write_connectivity(mesh.edges, out);
  begin_array(8 * n.cells);
  std::int64_t offset = 0;
  write_offsets(tetrahedra, 4, offset, out);
  write_offsets(faces, 3, offset, out);
  write_offsets(edges, 2, offset, out);
  begin_array(n.cells);
  write_types(tetrahedra, tetrahedron, out);
  write_types(faces, triangle, out);
  write_types(edges, line, out);
  begin_array(4 * n.cells);
  write_attributes(tetrahedra, mesh.regions, out);
  write_attributes(faces + edges, {}, out);
  begin_array(4 * n.cells);
  write_attributes(tetrahedra, {}, out);
  write_attributes(faces, mesh.face_markers, out);
  write_attributes(edges, mesh.edge_markers, out);
  out << "\n  </AppendedData>\n</VTKFile>\n";
}

}  // namespace ccdt::io
