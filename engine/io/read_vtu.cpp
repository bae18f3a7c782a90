#include <climits>
#include <cmath>

#include "engine/io/tet_mesh_formats.h"
#include "engine/io/text_scanner.h"
#include "engine/io/vtk_xml.h"

namespace ccdt::io {

namespace {

constexpr const char* remedy = "export the file again";

const VtkArray& required(const FileBytes& file, const VtkFile& outline, const char* parent, const char* name) {
  const VtkArray* array = outline.find(parent, name);
  if (!array)
    fail_at_byte(file, 0, std::string("it has no array ") + in_quotes(*name ? name : parent) + " in " + parent, remedy);
  return *array;
}

void check_size(const FileBytes& file, const VtkArray& array, std::size_t found, std::size_t due) {
  if (found != due)
    fail_at_byte(file, array.begin,
                 "array " + in_quotes(array.attribute("Name")) + " has " + std::to_string(found) + " values, not " +
                     std::to_string(due),
                 "the file is damaged: export it again");
}

/// A count that the Piece claims.
std::size_t claimed(const FileBytes& file, const VtkFile& outline, const char* name) {
  const auto found = outline.piece.find(name);
  const std::string text = found == outline.piece.end() ? "" : found->second;
  if (text.empty() || text.size() > 10 || text.find_first_not_of("0123456789") != std::string::npos)
    fail_at_byte(file, 0, std::string(name) + " is " + in_quotes(text) + ", not a number below 2^32", remedy);
  return std::stoull(text);
}

std::vector<Point3> read_points(const FileBytes& file, const VtkFile& outline) {
  const VtkArray& array = required(file, outline, "Points", "");
  const auto xyz = read_vtk_array<double>(file, outline, array);
  check_size(file, array, xyz.size(), 3 * claimed(file, outline, "NumberOfPoints"));
  std::vector<Point3> points(xyz.size() / 3);
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i] = {xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]};
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (!std::isfinite(xyz[3 * i + axis]))
        fail_at_byte(file, array.begin,
                     "vertex " + std::to_string(i) + ": a coordinate is not a finite number (NaN or infinite)",
                     "repair this vertex, or export the file again");
  }
  return points;
}

/// Attributes of cells by name, or nothing if there is no such array of one whole number a cell.
std::vector<std::int64_t> read_attributes(const FileBytes& file, const VtkFile& outline, const char* name,
                                          std::size_t cells) {
  const VtkArray* array = outline.find("CellData", name);
  if (!array) return {};
  auto values = read_vtk_array<std::int64_t>(file, outline, *array);
  check_size(file, *array, values.size(), cells);
  for (std::size_t i = 0; i < cells; ++i)
    if (values[i] < INT_MIN || values[i] > INT_MAX)
      fail_at_byte(file, array->begin, "cell " + std::to_string(i) + ": its " + name + " does not fit 32 bits",
                   "use smaller numbers");
  return values;
}

struct Cells {
  const FileBytes& file;
  std::vector<std::int64_t> connectivity, offsets, types, regions, markers;

  template <std::size_t Corners>
  void add(std::size_t cell, const std::vector<std::int64_t>& attributes, std::size_t vertices,
           std::vector<std::array<std::uint32_t, Corners>>& elements, std::vector<int>& element_attributes) const {
    const std::int64_t begin = cell == 0 ? 0 : offsets[cell - 1], end = offsets[cell];
    const std::string name = "cell " + std::to_string(cell);
    if (begin < 0 || end < begin || end - begin != static_cast<std::int64_t>(Corners) ||
        static_cast<std::size_t>(end) > connectivity.size())
      fail_at_byte(file, 0,
                   name + ": its offsets " + std::to_string(begin) + " and " + std::to_string(end) + " are wrong",
                   remedy);
    std::array<std::uint32_t, Corners> corners;
    for (std::size_t k = 0; k < Corners; ++k) {
      const std::int64_t index = connectivity[static_cast<std::size_t>(begin) + k];
      if (index < 0 || static_cast<std::size_t>(index) >= vertices)
        fail_at_byte(file, 0,
                     name + ": vertex index " + std::to_string(index) + " is out of range: the file has " +
                         std::to_string(vertices) + " vertices, counted from 0",
                     remedy);
      corners[k] = static_cast<std::uint32_t>(index);
    }
    elements.push_back(corners);
    element_attributes.push_back(attributes.empty() ? 0 : static_cast<int>(attributes[cell]));
  }
};

Cells read_cells(const FileBytes& file, const VtkFile& outline) {
  const std::size_t count = claimed(file, outline, "NumberOfCells");
  const auto read = [&](const char* name) {
    return read_vtk_array<std::int64_t>(file, outline, required(file, outline, "Cells", name));
  };
  Cells cells{file, read("connectivity"), read("offsets"), read("types"), {}, {}};
  check_size(file, required(file, outline, "Cells", "offsets"), cells.offsets.size(), count);
  check_size(file, required(file, outline, "Cells", "types"), cells.types.size(), count);
  cells.regions = read_attributes(file, outline, "region", count);
  cells.markers = read_attributes(file, outline, "marker", count);
  return cells;
}

bool read_claim(const FileBytes& file, const VtkFile& outline) {
  const VtkArray* array = outline.find("FieldData", "constrained_delaunay");
  if (!array) return false;
  const auto values = read_vtk_array<std::int64_t>(file, outline, *array);
  return values.size() == 1 && values[0] == 1;
}

}  // namespace

TetMesh read_vtu(const FileBytes& file) {
  constexpr std::int64_t vertex = 1, poly_vertex = 2, line = 3, triangle = 5, tetrahedron = 10;
  const VtkFile outline = read_vtk_outline(file);
  TetMesh mesh;
  mesh.vertices = read_points(file, outline);
  const Cells cells = read_cells(file, outline);
  const std::size_t vertices = mesh.vertices.size();
  for (std::size_t i = 0; i < cells.types.size(); ++i) {
    const std::int64_t type = cells.types[i];
    if (type == tetrahedron)
      cells.add(i, cells.regions, vertices, mesh.tetrahedra, mesh.regions);
    else if (type == triangle)
      cells.add(i, cells.markers, vertices, mesh.faces, mesh.face_markers);
    else if (type == line)
      cells.add(i, cells.markers, vertices, mesh.edges, mesh.edge_markers);
    else if (type != vertex && type != poly_vertex)
      fail_at_byte(file, 0,
                   "cell " + std::to_string(i) + ": cells of type " + std::to_string(type) + " are not supported",
                   "write linear tetrahedra, triangles and lines only");
  }
  mesh.constrained_delaunay = read_claim(file, outline);
  return mesh;
}

}  // namespace ccdt::io
