#include "engine/io/formats.h"

#include <algorithm>
#include <array>
#include <ranges>

#include "engine/base/check_arguments.h"
#include "engine/io/bridge_walls.h"
#include "engine/io/plc_files.h"
#include "engine/io/tet_mesh_files.h"
#include "engine/io/text_scanner.h"
#include "engine/plc/check_input.h"

namespace ccdt::io {

namespace {

struct FormatLimits {
  std::size_t most_corners = 0xFFFFFFFFu;  ///< of a facet
  bool several_polygons = false, segments = false, seeds = false, loose_vertices = true, markers = true;
};

/// The functions that read and write a format, and what it can hold.
struct PlcFormat {
  std::string_view ending, name;
  plc::InputPlc (*read)(const FileBytes&);
  void (*write)(const plc::InputPlc&, OutputFile&) = nullptr;  ///< null: not written
  FormatLimits limits = {};
};

constexpr PlcFormat plc_formats[] = {
    {".stl", "STL", read_stl, write_stl, {.most_corners = 3, .loose_vertices = false, .markers = false}},
    {".off", "OFF", read_off, write_off, {.markers = false}},
    {".obj", "OBJ", read_obj, write_obj},
    {".ply", "PLY", read_ply, write_ply},
    {".poly", ".poly", read_poly, write_poly, {.several_polygons = true, .segments = true, .seeds = true}},
    {".smesh", ".smesh", read_smesh, write_smesh, {.segments = true, .seeds = true}},
    {".node", ".node", read_node},
    {".mesh", "Medit .mesh", read_medit_plc, write_medit_plc, {.most_corners = 4, .segments = true}},
    {".meshb", "Medit .meshb", read_meditb_plc, write_meditb_plc, {.most_corners = 4, .segments = true}},
    {".msh", "Gmsh .msh", read_gmsh_plc},
    {".vtu", "VTK .vtu", read_vtu_plc},
    {".vtp", "VTK .vtp", read_vtp},
};

bool has_loose_vertex(const plc::InputPlc& plc) {
  std::vector<bool> used(plc.vertices.size(), false);
  for (const auto& triangle : plc.triangles)
    for (const std::uint32_t v : triangle) used[v] = true;
  for (const plc::PolygonFacet& facet : plc.polygon_facets)
    for (const auto& polygon : facet.polygons)
      for (const std::uint32_t v : polygon) used[v] = true;
  return std::find(used.begin(), used.end(), false) != used.end();
}

/// Why the format cannot hold a facet made of polygons; empty if it can.
std::string objection(const plc::PolygonFacet& facet, const PlcFormat& format) {
  if (!format.limits.several_polygons && (facet.polygons.size() != 1 || !facet.holes.empty()))
    return "facets with holes or several polygons";
  for (const auto& polygon : facet.polygons) {
    if (!format.limits.several_polygons && polygon.size() < 3) return "facets with fewer than three corners";
    if (polygon.size() > format.limits.most_corners)
      return "facets of more than " + std::to_string(format.limits.most_corners) + " corners";
  }
  return {};
}

/// \throw OutputError  the format cannot hold the PLC, or it has no vertices
void check_format_holds(const plc::InputPlc& plc, const PlcFormat& format, const std::string& file) {
  const auto refuse_if = [&](bool condition, const std::string& what, const std::string& where = {}) {
    if (condition)
      throw OutputError(where + std::string(format.name) + " cannot hold " + what, place_in(file),
                        "write a .poly file instead");
  };
  if (plc.vertices.empty()) throw OutputError("there are no vertices to write", place_in(file), "check the model");
  refuse_if(!format.limits.segments && !plc.segments.empty(), "segments");
  refuse_if(!format.limits.seeds && !plc.holes.empty(), "seeds of holes");
  refuse_if(!format.limits.seeds && !plc.regions.empty(), "seeds of regions");
  refuse_if(!std::ranges::all_of(plc.vertices, is_finite), "coordinates that are not finite");
  for (const plc::PolygonFacet& facet : plc.polygon_facets)
    if (const std::string what = objection(facet, format); !what.empty())
      refuse_if(true, what, "facet " + std::to_string(facet.number) + ": ");
  refuse_if(!format.limits.loose_vertices && has_loose_vertex(plc), "vertices without facets");
}

/// \throw OutputError  an index or a list of the mesh is wrong
void check_mesh(const mesh::TetMesh& mesh, const std::string& file) {
  const std::size_t count = mesh.vertices.size();
  if (!are_below(count, mesh.tetrahedra) || !are_below(count, mesh.faces) || !are_below(count, mesh.edges))
    throw OutputError("the mesh has a corner that is not a vertex", place_in(file), "count the vertices from 0");
  if (!is_empty_or_complete(mesh.regions, mesh.tetrahedra) || !is_empty_or_complete(mesh.partitions, mesh.tetrahedra) ||
      !is_empty_or_complete(mesh.face_markers, mesh.faces) || !is_empty_or_complete(mesh.edge_markers, mesh.edges))
    throw OutputError("a list of attributes is not as long as that of the elements", place_in(file),
                      "give none, or one for each element");
  if (!std::ranges::all_of(mesh.vertices, is_finite))
    throw OutputError("a coordinate is not finite", place_in(file), "check the mesh");
}

/// A format with one file, or with several (`..._files`). It holds elements of second order, too, if its writer takes
/// their nodes.
struct TetMeshFormat {
  std::string_view ending;
  mesh::TetMesh (*read)(const FileBytes&) = nullptr;
  void (*write)(const mesh::TetMesh&, OutputFile&) = nullptr;
  void (*write_nodes)(const mesh::ElementNodes&, OutputFile&) = nullptr;
  void (*check)(const std::filesystem::path&) = check_is_no_folder;  ///< can it have this name?
  mesh::TetMesh (*read_files)(const std::filesystem::path&) = nullptr;
  void (*write_files)(const mesh::TetMesh&, const std::filesystem::path&) = nullptr;
  void (*write_node_files)(const mesh::ElementNodes&, const std::filesystem::path&) = nullptr;
  bool has_partitions = false;

  bool has_second_order() const { return write_nodes || write_node_files; }
};

constexpr TetMeshFormat mesh_formats[] = {
    {".mesh", read_medit_mesh, write_medit_mesh},
    {".meshb", read_meditb_mesh, write_meditb_mesh},
    {.ending = ".vtu", .read_files = read_vtu_files, .write_node_files = write_vtu_files, .has_partitions = true},
    {.ending = ".msh", .read = read_gmsh, .write_nodes = write_gmsh, .has_partitions = true},
    {.ending = ".msh4", .read = read_gmsh, .write_nodes = write_gmsh4, .has_partitions = true},
    {.ending = ".inp", .write_nodes = write_abaqus},
    {.ending = ".xdmf", .write_node_files = write_xdmf_files},
    {.ending = ".polymesh", .check = check_replaces_poly_mesh, .write_files = write_poly_mesh},
    {.ending = ".node", .read_files = read_tetgen_mesh, .write_files = write_tetgen_mesh},
    {.ending = ".ele", .read_files = read_tetgen_mesh, .write_files = write_tetgen_mesh},
    {.ending = ".face", .read_files = read_tetgen_mesh, .write_files = write_tetgen_mesh},
};

constexpr const char* read_plc_endings =
    ".stl, .off, .obj, .ply, .poly, .smesh, .node, .mesh, .meshb, .msh, .vtu and .vtp";
constexpr const char* read_mesh_endings =
    ".mesh and .meshb (Medit), .vtu (VTK), .msh and .msh4 (Gmsh), .node, .ele and .face (TetGen)";
constexpr const char* written_mesh_endings =
    ".mesh and .meshb (Medit), .vtu (VTK), .msh and .msh4 (Gmsh), .inp (Abaqus, CalculiX), .xdmf (FEniCS), .polymesh "
    "(OpenFOAM), .node, .ele and .face (TetGen)";

/// The format with this ending; null if there is none.
template <class Format, std::size_t Count>
const Format* format_called(std::string_view ending, const Format (&formats)[Count]) {
  const auto format = std::ranges::find(formats, ending, &Format::ending);
  return format == std::end(formats) ? nullptr : format;
}

template <class Format, std::size_t Count>
const Format* format_of(const std::filesystem::path& file, const Format (&formats)[Count]) {
  return format_called(lower_ending(file), formats);
}

/// The ending of the format whose keyword the file begins with; empty for formats without a keyword.
std::string_view ending_shown_by(const FileBytes& file) {
  TextScanner in(file);
  const std::string_view first = in.peek();
  if (first == "ply") return ".ply";
  if (first == "OFF") return ".off";
  if (first == "MeshVersionFormatted") return ".mesh";
  if (first == "$MeshFormat") return ".msh";
  if (!equal_ignoring_case(first, "solid")) return {};
  in.skip_line();
  return equal_ignoring_case(in.peek(), "facet") ? ".stl" : std::string_view();
}

[[noreturn]] void fail_to_read(const std::filesystem::path& file, const std::string& known_endings) {
  check_is_file(file);  // "no such file" is the better message
  const auto of_cad = std::to_array<std::string_view>({".step", ".stp", ".iges", ".igs", ".brep"});
  if (std::ranges::find(of_cad, lower_ending(file)) != of_cad.end())
    throw InputError("a file '" + lower_ending(file) + "' has curved surfaces and no triangles",
                     place_in(file.string()),
                     "let Gmsh make triangles: gmsh part.step -2 -setnumber Mesh.StlOneSolidPerSurface 1 -o part.stl");
  throw InputError("unknown file extension '" + lower_ending(file) + "'", place_in(file.string()),
                   "convert the file, or rename it to one of " + known_endings);
}

[[noreturn]] void fail_to_write(const std::string& ending, const std::filesystem::path& file,
                                const std::string& known_endings) {
  throw OutputError("unknown file extension '" + ending + "'", place_in(file.string()),
                    "choose one of " + known_endings);
}

/// \throw OutputError  there is none, or it does not hold elements of this order, or partitions
const TetMeshFormat& written_mesh_format(const std::filesystem::path& file, const std::string& format, int order,
                                         bool partitioned) {
  const std::string ending = format.empty() ? lower_ending(file) : "." + format;
  const TetMeshFormat* const found = format_called(ending, mesh_formats);
  if (!found) fail_to_write(ending, file, written_mesh_endings);
  if (order == 2 && !found->has_second_order())
    throw OutputError("this format does not hold elements of second order", place_in(file.string()),
                      "choose .msh, .msh4, .vtu, .inp or .xdmf");
  if (partitioned && !found->has_partitions)
    throw OutputError("this format does not hold partitions", place_in(file.string()), "choose .msh, .msh4 or .vtu");
  return *found;
}

}  // namespace

namespace {

constexpr std::string_view constrained_delaunay_claim = "ccdt constrained_delaunay",
                           no_markers_claim = "ccdt no_markers";

}  // namespace

std::string claims_of(const mesh::TetMesh& mesh) {
  std::string claims;
  const auto claim_if = [&](bool condition, std::string_view claim) {
    if (condition) (claims += claims.empty() ? "" : ", ") += claim;
  };
  claim_if(mesh.constrained_delaunay, constrained_delaunay_claim);
  claim_if(lacks_markers(mesh), no_markers_claim);
  return claims;
}

void take_claims(std::string_view part_of_file, mesh::TetMesh& mesh) {
  const auto is_there = [&](std::string_view claim) { return part_of_file.find(claim) != std::string_view::npos; };
  mesh.constrained_delaunay = is_there(constrained_delaunay_claim);
  if (is_there(no_markers_claim)) mesh.face_markers.clear(), mesh.edge_markers.clear();
}

void add_facet(plc::InputPlc& plc, std::span<const std::uint32_t> corners, int marker, std::size_t facet_number) {
  const std::uint32_t number = static_cast<std::uint32_t>(facet_number);
  if (corners.size() == 3) {
    plc.triangles.push_back({corners[0], corners[1], corners[2]});
    plc.triangle_markers.push_back(marker);
    plc.triangle_numbers.push_back(number);
  } else if (corners.size() > 3) {
    plc.polygon_facets.push_back({{{corners.begin(), corners.end()}}, {}, marker, number});
  } else if (corners.size() == 2) {
    plc.segments.push_back({corners[0], corners[1]});
    plc.segment_markers.push_back(marker);
  }
}

void finish_facets(plc::InputPlc& plc) {
  for (std::vector<int>* markers : {&plc.triangle_markers, &plc.segment_markers})
    if (std::ranges::all_of(*markers, [](int m) { return m == 0; })) markers->clear();
  const auto indices = std::views::iota(std::size_t{0}, plc.triangle_numbers.size());
  if (std::ranges::equal(plc.triangle_numbers, indices)) plc.triangle_numbers.clear();
}

std::vector<FacetLoop> facets_in_order(const plc::InputPlc& plc) {
  std::vector<FacetLoop> loops;
  loops.reserve(plc.facet_count());
  for (std::size_t i = 0; i < plc.triangles.size(); ++i)
    loops.push_back({plc.triangles[i], attribute_of(plc.triangle_markers, i), nullptr,
                     plc.triangle_numbers.empty() ? static_cast<std::uint32_t>(i) : plc.triangle_numbers[i]});
  for (const plc::PolygonFacet& facet : plc.polygon_facets) {
    const bool is_empty = facet.polygons.empty();
    loops.push_back(
        {is_empty ? std::span<const std::uint32_t>() : facet.polygons[0], facet.marker, &facet, facet.number});
  }
  if (!plc.polygon_facets.empty() || !plc.triangle_numbers.empty())
    std::ranges::stable_sort(loops, {}, &FacetLoop::number);
  return loops;
}

ElementGroups group_elements(std::size_t count, const std::vector<int>& attributes) {
  ElementGroups groups;
  for (std::size_t i = 0; i < count; ++i) groups[attribute_of(attributes, i)].push_back(static_cast<std::uint32_t>(i));
  return groups;
}

bool is_plc_file(const std::filesystem::path& file) {
  return format_of(without_gzip(file), plc_formats) != nullptr;
}

plc::InputPlc read_plc(const FileBytes& file, const std::string& format) {
  const std::string ending = format.empty() ? lower_ending(without_gzip(file.name)) : "." + format;
  const std::string_view shown = ending_shown_by(file);
  const PlcFormat* const contents = format_called(shown.empty() ? ending : shown, plc_formats);
  if (!contents)
    throw InputError("its format is not known", place_in(file.name), std::string("name one of ") + read_plc_endings);
  plc::InputPlc plc = contents->read(file);
  plc.name = file.name;
  drop_bridge_walls(plc);
  if (contents->ending != ending && !ending.empty())
    plc.notes.push_back("the file is named '" + ending + "' but contains " + std::string(contents->name) +
                        ", and was read as such");
  return plc;
}

plc::InputPlc read_plc(const std::filesystem::path& file) {
  if (!is_plc_file(file)) fail_to_read(file, std::string(read_plc_endings) + ", each also with .gz");
  return read_plc(read_inflated_file(file), {});
}

std::vector<std::string> plc_format_names(bool written) {
  std::vector<std::string> names;
  for (const PlcFormat& format : plc_formats)
    if (format.write || !written) names.emplace_back(format.ending.substr(1));
  return names;
}

bool keeps_markers(const std::filesystem::path& file) {
  const PlcFormat* format = format_of(file, plc_formats);
  return format && format->limits.markers;
}

void write_plc(const plc::InputPlc& plc, const std::filesystem::path& file) {
  with_file_in_errors(file.string(), [&] { plc::check_input(plc); });
  const PlcFormat* format = format_of(file, plc_formats);
  if (!format || !format->write)
    fail_to_write(lower_ending(file), file, ".stl, .off, .obj, .ply, .poly, .smesh, .mesh and .meshb");
  check_format_holds(plc, *format, file.string());
  OutputFile out(file);
  format->write(plc, out);
  out.commit();
}

bool is_one_file(const std::string& format) {
  const TetMeshFormat* const found = format_called("." + format, mesh_formats);
  return found && (found->write || found->write_nodes);
}

bool is_tet_mesh_file(const std::filesystem::path& file) {
  return format_of(file, mesh_formats) != nullptr;
}

std::vector<std::string> tet_mesh_formats() {
  std::vector<std::string> names;
  for (const TetMeshFormat& format : mesh_formats) names.emplace_back(format.ending.substr(1));
  return names;
}

void check_tet_mesh_output(const std::filesystem::path& file, const std::string& format, int order, bool partitioned) {
  written_mesh_format(file, format, order, partitioned).check(file);
}

void write_tet_mesh(const mesh::TetMesh& mesh, const std::filesystem::path& file, const std::string& format,
                    int order) {
  check_mesh(mesh, file.string());
  const TetMeshFormat& found = written_mesh_format(file, format, order, !mesh.partitions.empty());
  if (found.write_files) return found.write_files(mesh, file);
  const mesh::ElementNodes nodes(mesh, order);
  if (found.write_node_files) return found.write_node_files(nodes, file);
  OutputFile out(file);
  found.write ? found.write(mesh, out) : found.write_nodes(nodes, out);
  out.commit();
}

mesh::TetMesh read_tet_mesh(const std::filesystem::path& file) {
  const TetMeshFormat* format = format_of(file, mesh_formats);
  if (!format || (!format->read && !format->read_files)) fail_to_read(file, read_mesh_endings);
  return format->read ? format->read(read_whole_file(file)) : format->read_files(file);
}

mesh::TetMesh read_tet_mesh(const FileBytes& file, const std::string& format) {
  const TetMeshFormat* const found = format_called("." + format, mesh_formats);
  if (!found || !found->read)
    throw InputError("no mesh can be read from one file of the format '" + format + "'", place_in(file.name),
                     "choose .mesh, .meshb, .msh or .msh4");
  return found->read(file);
}

}  // namespace ccdt::io
