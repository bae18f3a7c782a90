#include <algorithm>
#include <climits>
#include <limits>
#include <tuple>
#include <utility>

#include "engine/base/errors.h"
#include "engine/base/parallel.h"
#include "engine/base/raw_vector.h"
#include "engine/io/formats.h"
#include "engine/io/mesh_surface.h"
#include "engine/io/vtk_arrays.h"
#include "engine/io/vtk_bytes.h"
#include "engine/io/vtk_values.h"
#include "engine/io/xml_text.h"

namespace ccdt::io {

namespace {

// VTK's types of cells
constexpr std::uint8_t vtk_vertex = 1, vtk_poly_vertex = 2, vtk_line = 3, vtk_triangle = 5, vtk_tetrahedron = 10,
                       vtk_quadratic_line = 21, vtk_quadratic_triangle = 22, vtk_quadratic_tetrahedron = 24;

struct VtuCell {
  std::size_t number;
  std::size_t kind;         ///< 0 to 2: which list of a mesh it belongs to; 3: none
  std::int64_t begin, end;  ///< of its corners in the connectivity
  int region, marker;
};

struct VtuCells {
  const VtkArrays& arrays;
  std::size_t vertices = 0;
  StoredNumbers<std::int64_t> connectivity, offsets, types, regions, markers;

  [[noreturn]] void refuse(std::size_t cell, const std::string& what, const char* remedy) const {
    arrays.fail(0, "cell " + std::to_string(cell) + ": " + what, remedy);
  }

  /// Of a cell of this type, as in `VtuCell`.
  std::size_t kind(std::size_t cell, std::int64_t type) const {
    if (type == vtk_tetrahedron) return 0;
    if (type == vtk_triangle) return 1;
    if (type == vtk_line) return 2;
    if (type != vtk_vertex && type != vtk_poly_vertex)
      refuse(cell, "cells of type " + std::to_string(type) + " are not supported",
             "write linear tetrahedra, triangles and lines only");
    return 3;
  }

  template <std::size_t Corners>
  std::array<std::uint32_t, Corners> corners(const VtuCell& cell) const {
    const auto [number, kind, begin, end, region, marker] = cell;
    if (begin < 0 || end < begin || end - begin != static_cast<std::int64_t>(Corners) ||
        static_cast<std::size_t>(end) > connectivity.size())
      refuse(number, "its offsets " + std::to_string(begin) + " and " + std::to_string(end) + " are wrong",
             VtkArrays::damaged_remedy);
    std::array<std::int64_t, Corners> indices;
    connectivity.read(static_cast<std::size_t>(begin), static_cast<std::size_t>(end), indices.data());
    std::array<std::uint32_t, Corners> its;
    for (std::size_t k = 0; k < Corners; ++k) {
      if (indices[k] < 0 || static_cast<std::size_t>(indices[k]) >= vertices)
        refuse(number,
               "vertex index " + std::to_string(indices[k]) + " is out of range: the file has " +
                   std::to_string(vertices) + " vertices, counted from 0",
               VtkArrays::damaged_remedy);
      its[k] = static_cast<std::uint32_t>(indices[k]);
    }
    return its;
  }
};

/// Calls visit(cell) for a range of cells.
template <class Visit>
void visit_cells(const VtuCells& cells, std::size_t range_begin, std::size_t range_end, const Visit& visit) {
  Few types, ends, regions = {}, markers = {};
  std::int64_t corners_begin = 0;
  if (range_begin > 0) cells.offsets.read(range_begin - 1, range_begin, &corners_begin);
  for_few(range_begin, range_end, [&](std::size_t begin, std::size_t end) {
    cells.types.read(begin, end, types.data());
    cells.offsets.read(begin, end, ends.data());
    if (cells.regions.size() > 0) cells.regions.read(begin, end, regions.data());
    if (cells.markers.size() > 0) cells.markers.read(begin, end, markers.data());
    for (std::size_t cell = begin, i = 0; cell < end; ++cell, ++i) {
      visit(VtuCell{cell, cells.kind(cell, types[i]), corners_begin, ends[i], static_cast<int>(regions[i]),
                    static_cast<int>(markers[i])});
      corners_begin = ends[i];
    }
  });
}

/// How many cells are of each kind.
using KindCounts = std::array<std::size_t, 4>;

KindCounts count_kinds(const VtuCells& cells, std::size_t range_begin, std::size_t range_end) {
  KindCounts counts = {};
  Few types;
  for_few(range_begin, range_end, [&](std::size_t begin, std::size_t end) {
    cells.types.read(begin, end, types.data());
    for (std::size_t cell = begin; cell < end; ++cell) ++counts[cells.kind(cell, types[cell - begin])];
  });
  return counts;
}

/// Enters a range of cells into the lists of the mesh; `at` is the first place for each kind.
void enter_cells(const VtuCells& cells, std::size_t begin, std::size_t end, KindCounts at, mesh::TetMesh& mesh) {
  visit_cells(cells, begin, end, [&](const VtuCell& cell) {
    const std::size_t place = at[cell.kind]++;
    if (cell.kind == 0) mesh.tetrahedra[place] = cells.corners<4>(cell), mesh.regions[place] = cell.region;
    if (cell.kind == 1) mesh.faces[place] = cells.corners<3>(cell), mesh.face_markers[place] = cell.marker;
    if (cell.kind == 2) mesh.edges[place] = cells.corners<2>(cell), mesh.edge_markers[place] = cell.marker;
  });
}

/// \throw InputError  a cell is wrong; names one of these
void enter_all_cells(const VtuCells& cells, mesh::TetMesh& mesh) {
  const std::size_t size = cells.types.size();
  std::vector<KindCounts> starts = parallel_chunks(
      size, vtk_range_length, [&](std::size_t begin, std::size_t end) { return count_kinds(cells, begin, end); });
  KindCounts sum = {};
  for (KindCounts& start : starts)
    for (std::size_t kind = 0; kind < sum.size(); ++kind) sum[kind] += std::exchange(start[kind], sum[kind]);
  mesh.tetrahedra.resize(sum[0]), mesh.regions.resize(sum[0]);
  mesh.faces.resize(sum[1]), mesh.face_markers.resize(sum[1]);
  mesh.edges.resize(sum[2]), mesh.edge_markers.resize(sum[2]);
  parallel_for(starts.size(), 1, [&](std::size_t i) {
    enter_cells(cells, i * vtk_range_length, std::min(size, (i + 1) * vtk_range_length), starts[i], mesh);
  });
}

VtuCells read_cells(const VtkArrays& arrays, std::size_t vertices) {
  const std::size_t count = arrays.claimed("NumberOfCells");
  const auto read = [&](const char* name) { return arrays.read<std::int64_t>(arrays.required("Cells", name)); };
  VtuCells cells{arrays, vertices, read("connectivity"), read("offsets"), read("types"), {}, {}};
  arrays.check_size(arrays.required("Cells", "offsets"), cells.offsets.size(), count);
  arrays.check_size(arrays.required("Cells", "types"), cells.types.size(), count);
  cells.regions = read_vtk_attributes(arrays, "region", count);
  cells.markers = read_vtk_attributes(arrays, "marker", count);
  return cells;
}

void refuse_first_wrong_cell(const VtuCells& cells) {
  visit_cells(cells, 0, cells.types.size(), [&](const VtuCell& cell) {
    if (cell.kind == 0) cells.corners<4>(cell);
    if (cell.kind == 1) cells.corners<3>(cell);
    if (cell.kind == 2) cells.corners<2>(cell);
  });
}

/// What names of markers are in the file: arrays of the field data with this name and two numbers, the marker and the
/// dimension of what it marks, as meshio gives the names of Gmsh's groups. (It reads no strings from such files.)
constexpr int face_dimension = 2;

void write_names(const std::map<int, std::string>& names, OutputFile& out) {
  for (const auto& [marker, name] : names)
    out << "      <DataArray type=\"Int32\" Name=\"" << xml_text(name) << "\" NumberOfTuples=\"2\" format=\"ascii\">"
        << marker << ' ' << face_dimension << "</DataArray>\n";
}

std::map<int, std::string> read_names(const VtkArrays& arrays) {
  std::map<int, std::string> names;
  for (const VtkArrays::Array& array : arrays.all("FieldData")) {
    if (array.attribute("type").value() != std::string_view("Int32")) continue;
    const StoredNumbers<std::int64_t> numbers = arrays.read<std::int64_t>(array);
    if (numbers.size() != 2) continue;
    std::array<std::int64_t, 2> values;
    numbers.read(0, 2, values.data());
    if (values[1] == face_dimension) names[static_cast<int>(values[0])] = array.attribute("Name").value();
  }
  return names;
}

bool is_one(const StoredNumbers<std::int64_t>& numbers) {
  std::int64_t first = 0;
  if (numbers.size() == 1) numbers.read(0, 1, &first);
  return first == 1;
}

/// An array that is appended after the XML.
struct AppendedArray {
  const char *type, *name;
  std::string bytes;
  const char* attributes = "";
};

/// The tetrahedra of a mesh, or its faces and edges in one list, with the points that a file has for them.
struct CellList {
  const mesh::ElementNodes& nodes;
  std::vector<std::uint32_t> node_of_point;  ///< empty: every node of the mesh is a point
  std::vector<std::uint32_t> point_of_node;  ///< empty likewise
  std::size_t tetrahedra, faces, edges;      ///< how many of each
  std::size_t per_tetrahedron = nodes.per_element(4), per_face = nodes.per_element(3), per_edge = nodes.per_element(2);

  std::size_t size() const { return tetrahedra + faces + edges; }
  std::size_t corner_count() const { return per_tetrahedron * tetrahedra + per_face * faces + per_edge * edges; }
  std::size_t point_count() const { return point_of_node.empty() ? nodes.count() : node_of_point.size(); }

  std::uint32_t node(std::size_t point) const {
    return point_of_node.empty() ? static_cast<std::uint32_t>(point) : node_of_point[point];
  }

  std::uint32_t corner(std::size_t i) const {
    const mesh::TetMesh& mesh = nodes.mesh();
    if (tetrahedra > 0) return nodes.node(mesh.tetrahedra[i / per_tetrahedron], i % per_tetrahedron);
    if (i < per_face * faces) return point_of_node[nodes.node(mesh.faces[i / per_face], i % per_face)];
    i -= per_face * faces;
    return point_of_node[nodes.node(mesh.edges[i / per_edge], i % per_edge)];
  }

  /// Where the corners of a cell end.
  std::size_t corners_end(std::size_t cell) const {
    const std::size_t end = cell + 1;
    if (tetrahedra > 0) return per_tetrahedron * end;
    return end <= faces ? per_face * end : per_face * faces + per_edge * (end - faces);
  }

  std::uint8_t type(std::size_t cell) const {
    if (nodes.are_second_order())
      return tetrahedra > 0 ? vtk_quadratic_tetrahedron : cell < faces ? vtk_quadratic_triangle : vtk_quadratic_line;
    return tetrahedra > 0 ? vtk_tetrahedron : cell < faces ? vtk_triangle : vtk_line;
  }

  bool has_attributes() const { return tetrahedra > 0 || !lacks_markers(nodes.mesh()); }

  bool has_partitions() const { return tetrahedra > 0 && !nodes.mesh().partitions.empty(); }
  std::int32_t partition(std::size_t tetrahedron) const { return nodes.mesh().partitions[tetrahedron]; }

  /// The region of a tetrahedron, or the marker of a face or an edge.
  std::int32_t attribute(std::size_t cell) const {
    const mesh::TetMesh& mesh = nodes.mesh();
    if (tetrahedra > 0) return attribute_of(mesh.regions, cell);
    return cell < faces ? attribute_of(mesh.face_markers, cell) : attribute_of(mesh.edge_markers, cell - faces);
  }
};

CellList tetrahedra_of(const mesh::ElementNodes& nodes) {
  return {nodes, {}, {}, nodes.mesh().tetrahedra.size(), 0, 0};
}

CellList boundary_of(const mesh::ElementNodes& nodes) {
  const mesh::TetMesh& mesh = nodes.mesh();
  // One more than there are nodes: an empty list means something else.
  CellList cells{
      nodes, {}, std::vector<std::uint32_t>(nodes.count() + 1, none), 0, mesh.faces.size(), mesh.edges.size()};
  const auto note = [&](const auto& elements) {
    for (const auto& corners : elements)
      for (std::size_t k = 0; k < nodes.per_element(corners.size()); ++k)
        cells.point_of_node[nodes.node(corners, k)] = 0;
  };
  note(mesh.faces);
  note(mesh.edges);
  for (std::uint32_t v = 0; v < nodes.count(); ++v) {
    if (cells.point_of_node[v] == none) continue;
    cells.point_of_node[v] = static_cast<std::uint32_t>(cells.node_of_point.size());
    cells.node_of_point.push_back(v);
  }
  return cells;
}

AppendedArray points_of(const CellList& cells) {
  const auto coordinate = [&](std::size_t i) { return as_array(cells.nodes.point(cells.node(i / 3)))[i % 3]; };
  return {"Float64", "Points", compress_values(3 * cells.point_count(), coordinate), " NumberOfComponents=\"3\""};
}

/// The corners of the cells, and where the corners of each end.
template <class Index>
std::array<AppendedArray, 2> corners_of(const CellList& cells, const char* type) {
  const auto corner = [&](std::size_t i) { return static_cast<Index>(cells.corner(i)); };
  const auto end = [&](std::size_t cell) { return static_cast<Index>(cells.corners_end(cell)); };
  return {{{type, "connectivity", compress_values(cells.corner_count(), corner)},
           {type, "offsets", compress_values(cells.size(), end)}}};
}

/// Declares a group of arrays. Their bytes begin `offset` bytes after the start of the appended data; `offset` moves
/// past them.
void declare(const char* group, const char* attributes, std::span<const AppendedArray> arrays, std::size_t& offset,
             OutputFile& out) {
  out << "      <" << group << attributes << ">\n";
  for (const AppendedArray& array : arrays) {
    out << "        <DataArray type=\"" << array.type << "\" Name=\"" << array.name << "\"" << array.attributes
        << " format=\"appended\" offset=\"" << offset << "\"/>\n";
    offset += array.bytes.size();
  }
  out << "      </" << group << ">\n";
}

/// \param attribute  what the attribute of the cells is called
void write_grid(const CellList& list, const char* attribute, OutputFile& out) {
  const bool is_short = std::max(list.corner_count(), list.point_count()) <= INT_MAX;
  const std::array<AppendedArray, 1> points = {points_of(list)};
  auto [corners, offsets] =
      is_short ? corners_of<std::int32_t>(list, "Int32") : corners_of<std::int64_t>(list, "Int64");
  const auto of_cells = [&](auto(CellList::*of_cell)(std::size_t) const) {
    return compress_values(list.size(), [&](std::size_t cell) { return (list.*of_cell)(cell); });
  };
  const std::array<AppendedArray, 3> cells = {std::move(corners), std::move(offsets),
                                              AppendedArray{"UInt8", "types", of_cells(&CellList::type)}};
  std::vector<AppendedArray> of_each_cell;
  if (list.has_attributes()) of_each_cell.push_back({"Int32", attribute, of_cells(&CellList::attribute)});
  if (list.has_partitions()) of_each_cell.push_back({"Int32", "partition", of_cells(&CellList::partition)});
  std::vector<AppendedArray> of_each_point;
  if (!list.point_of_node.empty())
    of_each_point.push_back({"UInt32", vtu_point_vertex,
                             compress_values(list.point_count(), [&](std::size_t point) { return list.node(point); })});

  out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
         "header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\">\n  <UnstructuredGrid>\n    <FieldData>\n"
         "      <DataArray type=\"Int32\" Name=\"constrained_delaunay\" NumberOfTuples=\"1\" format=\"ascii\">"
      << (list.nodes.mesh().constrained_delaunay ? 1 : 0) << "</DataArray>\n";
  if (list.tetrahedra == 0) write_names(list.nodes.mesh().face_names, out);
  out << "    </FieldData>\n    <Piece NumberOfPoints=\"" << list.point_count() << "\" NumberOfCells=\"" << list.size()
      << "\">\n";
  std::size_t offset = 0;
  declare("Points", "", points, offset, out);
  declare("Cells", "", cells, offset, out);
  if (!of_each_point.empty()) declare("PointData", "", of_each_point, offset, out);
  if (!of_each_cell.empty())
    declare("CellData", (" Scalars=\"" + std::string(attribute) + "\"").c_str(), of_each_cell, offset, out);
  out << "    </Piece>\n  </UnstructuredGrid>\n  <AppendedData encoding=\"raw\">\n_";
  for (const std::span<const AppendedArray> arrays :
       {std::span<const AppendedArray>(points), {cells}, {of_each_point}, {of_each_cell}})
    for (const AppendedArray& array : arrays) out << array.bytes;
  out << "\n  </AppendedData>\n</VTKFile>\n";
}

}  // namespace

mesh::TetMesh read_vtu(const FileBytes& file) {
  const VtkArrays arrays(file);
  mesh::TetMesh mesh;
  mesh.vertices = read_vtk_points(arrays);
  const VtuCells cells = read_cells(arrays, mesh.vertices.size());
  try {
    enter_all_cells(cells, mesh);
  } catch (const InputError&) {
    refuse_first_wrong_cell(cells);
    throw;
  }
  if (cells.markers.size() == 0) mesh.face_markers.clear(), mesh.edge_markers.clear();
  mesh.face_names = read_names(arrays);
  if (const auto claim = arrays.find("FieldData", "constrained_delaunay"))
    mesh.constrained_delaunay = is_one(arrays.read<std::int64_t>(claim));
  return mesh;
}

plc::InputPlc read_vtu_plc(const FileBytes& file) {
  return surface_of(read_vtu(file));
}

void write_vtu_tetrahedra(const mesh::ElementNodes& nodes, OutputFile& out) {
  write_grid(tetrahedra_of(nodes), "region", out);
}

void write_vtu_boundary(const mesh::ElementNodes& nodes, OutputFile& out) {
  write_grid(boundary_of(nodes), "marker", out);
}

}  // namespace ccdt::io
