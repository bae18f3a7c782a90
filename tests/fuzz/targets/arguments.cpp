#include <cmath>
#include <limits>
#include <vector>

#include "engine/include/ccdt/ccdt.h"
#include "tests/fuzz/targets/right_mesh.h"
#include "tests/fuzz/targets/temporary_folder.h"

// Calls every public function with arguments that no reader would make: numbers out of range, lists that are too short,
// lengths that are negative or NaN. It must return something valid, or throw an error of ours.

namespace ccdt::fuzz {
namespace {

/// Mostly small whole numbers.
double number(Bytes& bytes) {
  constexpr double huge = std::numeric_limits<double>::max(), tiny = std::numeric_limits<double>::denorm_min();
  constexpr std::array odd = {std::numeric_limits<double>::quiet_NaN(),
                              HUGE_VAL,
                              -HUGE_VAL,
                              huge,
                              -huge,
                              tiny,
                              -1.0,
                              -0.0,
                              1e-9,
                              1e9,
                              1e-300,
                              0.3};
  const std::uint8_t byte = bytes.next();
  return byte < 5 * odd.size() && byte % 5 == 0 ? odd[byte / 5] : byte % 4;
}

/// Mostly the default.
void change(Bytes& bytes, double& option) {
  if (bytes.below(4) == 0) option = number(bytes);
}
template <class Enum>
void change(Bytes& bytes, Enum& option) {
  const std::uint8_t byte = bytes.next();
  option = byte == 255 ? static_cast<Enum>(byte) : names_of(Enum{})[byte % names_of(Enum{}).size()].value;
}

Point3 point(Bytes& bytes) {
  const double x = number(bytes), y = number(bytes), z = number(bytes);
  return {x, y, z};
}

/// Up to `most` things.
template <class Make>
auto several(Bytes& bytes, std::size_t most, const Make& make) {
  std::vector<decltype(make())> things(bytes.below(most + 1));
  for (auto& thing : things) thing = make();
  return things;
}

/// Indices of which few are out of range.
template <std::size_t Size>
std::array<std::uint32_t, Size> indices(Bytes& bytes, std::size_t count) {
  std::array<std::uint32_t, Size> result;
  for (std::uint32_t& index : result) {
    const std::uint8_t byte = bytes.next();
    index =
        byte == 255 || count == 0 ? 0xFFFFFFFFu - byte % 2 : static_cast<std::uint32_t>(byte % (count + byte / 254));
  }
  return result;
}

/// A tetrahedron with a list of the wrong size or an index out of range here and there, or anything.
InputPlc input_of(Bytes& bytes) {
  InputPlc input;
  input.inside = bytes.pick(std::array{InputPlc::Inside::even_odd, InputPlc::Inside::seeds});
  if (bytes.flag()) {
    input.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    input.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  } else {
    input.vertices = several(bytes, 8, [&] { return point(bytes); });
    input.triangles = several(bytes, 8, [&] { return indices<3>(bytes, input.vertices.size()); });
  }
  const std::size_t count = input.vertices.size();
  const auto marker = [&] { return static_cast<int>(bytes.next()); };
  if (bytes.flag()) input.triangle_markers = several(bytes, 8, marker);
  if (bytes.flag()) input.triangle_numbers = several(bytes, 8, [&] { return indices<1>(bytes, 9)[0]; });
  input.polygon_facets = several(bytes, 2, [&] {
    PolygonFacet facet;
    facet.polygons = several(bytes, 3, [&] { return several(bytes, 5, [&] { return indices<1>(bytes, count)[0]; }); });
    facet.holes = several(bytes, 2, [&] { return point(bytes); });
    return facet;
  });
  input.segments = several(bytes, 2, [&] { return indices<2>(bytes, count); });
  if (bytes.flag()) input.segment_markers = several(bytes, 3, marker);
  input.holes = several(bytes, 2, [&] { return point(bytes); });
  input.regions = several(bytes, 2, [&] { return InputPlc::RegionSeed{point(bytes), marker(), number(bytes)}; });
  return input;
}

BackgroundSizes sizes_of(Bytes& bytes) {
  BackgroundSizes sizes;
  sizes.vertices = several(bytes, 5, [&] { return point(bytes); });
  sizes.tetrahedra = several(bytes, 3, [&] { return indices<4>(bytes, sizes.vertices.size()); });
  sizes.sizes = several(bytes, 5, [&] { return number(bytes); });
  return sizes;
}

LocalSize local_size_of(Bytes& bytes) {
  LocalSize size;
  size.edge_length = number(bytes);
  change(bytes, size.volume);
  change(bytes, size.within);
  const auto attribute = [&] { return static_cast<int>(bytes.below(4)); };
  for (std::vector<int>* list : {&size.markers, &size.segments, &size.regions}) *list = several(bytes, 1, attribute);
  size.boxes = several(bytes, 1, [&] { return Box{point(bytes), point(bytes)}; });
  size.balls = several(bytes, 1, [&] { return Ball{point(bytes), number(bytes)}; });
  return size;
}

LocalSizes local_sizes_of(Bytes& bytes) {
  LocalSizes local;
  local.sizes = several(bytes, 2, [&] { return local_size_of(bytes); });
  change(bytes, local.curvature_angle);
  change(bytes, local.elements_through);
  if (bytes.flag())
    local.function = [length = number(bytes)](std::span<const Point3>, std::span<double> lengths) {
      std::ranges::fill(lengths, length);
    };
  return local;
}

MeshOptions options_of(Bytes& bytes) {
  MeshOptions options;
  options.face_protection = bytes.flag();
  change(bytes, options.lattice);
  change(bytes, options.protection);
  change(bytes, options.locator);
  change(bytes, options.delaunay);
  change(bytes, options.visibility);
  change(bytes, options.surface);
  for (double* option :
       {&options.least_core, &options.grid_scale, &options.sharp_angle, &options.thin_tetrahedra, &options.edge_length,
        &options.grading, &options.flatness, &options.sphere_factor, &options.clearance, &options.radius_edge})
    change(bytes, *option);
  options.threads = bytes.pick(std::array{1u, 0u, 2u, 1000000000u, 0xFFFFFFFFu});
  Improvement improvement = Improvement::all;
  change(bytes, improvement);
  options.improve.improvement = improvement;
  change(bytes, options.improve.objective);
  change(bytes, options.improve.boundary);
  change(bytes, options.improve.steiner);
  for (double* option : {&options.improve.target_dihedral, &options.improve.target_r, &options.improve.time})
    change(bytes, *option);
  if (bytes.flag()) options.background = sizes_of(bytes);
  if (bytes.flag()) options.local = local_sizes_of(bytes);
  change(bytes, options.surface_factor);
  change(bytes, options.tetrahedra);
  change(bytes, options.most_tetrahedra);
  return options;
}

TetMesh mesh_of(Bytes& bytes) {
  TetMesh mesh;
  mesh.vertices = several(bytes, 8, [&] { return point(bytes); });
  const std::size_t count = mesh.vertices.size();
  const auto attribute = [&] { return static_cast<int>(bytes.next()); };
  mesh.tetrahedra = several(bytes, 4, [&] { return indices<4>(bytes, count); });
  mesh.regions = several(bytes, 4, attribute);
  mesh.faces = several(bytes, 4, [&] { return indices<3>(bytes, count); });
  mesh.face_markers = several(bytes, 4, attribute);
  mesh.edges = several(bytes, 4, [&] { return indices<2>(bytes, count); });
  mesh.edge_markers = several(bytes, 4, attribute);
  return mesh;
}

void write_plc_somewhere(Bytes& bytes) {
  const char* ending = bytes.pick(std::array{".stl", ".off", ".obj", ".ply", ".poly", ".smesh", ".mesh", ".meshb", ""});
  write_plc(input_of(bytes), temporary_folder().path() / (std::string("input") + ending));
}

void write_mesh_somewhere(Bytes& bytes) {
  const char* ending = bytes.pick(std::array{".mesh", ".meshb", ".vtu", ".msh", ".msh4", ".node", ""});
  write_tet_mesh(mesh_of(bytes), temporary_folder().path() / (std::string("mesh") + ending));
}

/// All indices are in range, and all lists are complete.
void require_whole(const TetMesh& mesh) {
  const auto are_in_range = [&](const auto& elements) {
    return std::ranges::all_of(elements, [&](const auto& corners) {
      return std::ranges::all_of(corners, [&](std::uint32_t v) { return v < mesh.vertices.size(); });
    });
  };
  require(are_in_range(mesh.tetrahedra) && are_in_range(mesh.faces) && are_in_range(mesh.edges),
          "a corner is no vertex");
  require(mesh.regions.size() == mesh.tetrahedra.size() && mesh.edge_markers.size() == mesh.edges.size() &&
              (mesh.face_markers.empty() || mesh.face_markers.size() == mesh.faces.size()),
          "a list is not complete");
  require(std::ranges::all_of(mesh.vertices, is_finite), "a vertex is not finite");
}

void mesh_anything(Bytes& bytes) {
  const MeshOptions options = options_of(bytes);
  number_of_threads(options), improvement_of(options);
  const InputPlc input = input_of(bytes);
  require_whole(mesh_plc(input, options, limited_to(2)).mesh);
  if (options.surface == SurfaceRule::keep) require_right_mesh(input, options, 2);
}

void improve_anything(Bytes& bytes) {
  const MeshOptions options = options_of(bytes);
  TetMesh mesh = bytes.flag() ? mesh_plc(input_of(bytes), {}, limited_to(2)).mesh : mesh_of(bytes);
  if (bytes.flag()) mesh.regions = several(bytes, 4, [&] { return static_cast<int>(bytes.next()); });
  const bool has_regions = !mesh.regions.empty(), has_edge_markers = !mesh.edge_markers.empty();
  TetMesh better = improve_tet_mesh(std::move(mesh), options.improve, options.threads, limited_to(2)).mesh;
  if (!has_regions) better.regions.resize(better.tetrahedra.size());
  if (!has_edge_markers) better.edge_markers.resize(better.edges.size());
  require_whole(better);
}

void remesh(Bytes& bytes) {
  RemeshOptions options{.edge_length = 0.5};
  for (double* option : {&options.edge_length, &options.sharp_angle, &options.flatness}) change(bytes, *option);
  const LocalSizes local = local_sizes_of(bytes);
  const BackgroundSizes background = sizes_of(bytes);
  if (bytes.flag()) options.local = &local;
  if (bytes.flag()) options.background = &background;
  remesh_surface(input_of(bytes), options, limited_to(2));
}

void repair_anything(Bytes& bytes) {
  repair::RepairOptions options;
  for (double* option : {&options.flatness, &options.gap, &options.limit, &options.seconds}) change(bytes, *option);
  repair_input(input_of(bytes), options, limited_to(2));
}

void try_bytes(Bytes bytes) {
  switch (bytes.below(8)) {
    case 0:
      return mesh_anything(bytes);
    case 1: {
      double flatness = usual_flatness;
      change(bytes, flatness);
      find_faults(input_of(bytes), flatness, limited_to(2));
      break;
    }
    case 2:
      return repair_anything(bytes);
    case 3:
      return remesh(bytes);
    case 4:
      return write_plc_somewhere(bytes);
    case 5:
      return write_mesh_somewhere(bytes);
    case 6:
      return improve_anything(bytes);
    default: {
      const auto points = several(bytes, 8, [&] { return point(bytes); });
      flatness_for(points, number(bytes));
    }
  }
}

}  // namespace
}  // namespace ccdt::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  ccdt::fuzz::accepts([&] { ccdt::fuzz::try_bytes({data, size}); });
  return 0;
}
