#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>

#include "engine/include/ccdt/ccdt.h"

namespace ccdt {
namespace {

InputPlc tetrahedron() {
  InputPlc input;
  input.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  input.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  return input;
}

/// Every function that takes an input refuses it.
void expect_refused(const std::function<void(InputPlc&)>& spoil) {
  InputPlc input = tetrahedron();
  spoil(input);
  EXPECT_THROW(mesh_plc(input), InputError);
  EXPECT_THROW(find_faults(input), InputError);
  EXPECT_THROW(repair_input(input), InputError);
  EXPECT_THROW(remesh_surface(input, {.edge_length = 0.5}), InputError);
  EXPECT_THROW(write_plc(input, std::filesystem::temp_directory_path() / "refused.poly"), InputError);
}

TEST(Arguments, AnIndexOutOfRangeIsAnErrorOfTheInput) {
  expect_refused([](InputPlc& input) { input.triangles[2][1] = 4; });
  expect_refused([](InputPlc& input) { input.segments = {{0, 0xFFFFFFFFu}}; });
  expect_refused([](InputPlc& input) { input.polygon_facets = {{{{0, 1, 9}}, {}}}; });
}

TEST(Arguments, AListThatIsTooShortIsAnErrorOfTheInput) {
  expect_refused([](InputPlc& input) { input.triangle_markers = {1, 2}; });
  expect_refused([](InputPlc& input) { input.triangle_numbers = {0}; });
  expect_refused([](InputPlc& input) { input.segments = {{0, 1}, {1, 2}}, input.segment_markers = {1}; });
}

TEST(Arguments, ASeedThatIsNotFiniteIsAnErrorOfTheInput) {
  expect_refused([](InputPlc& input) { input.holes = {{0, std::nan(""), 0}}; });
  expect_refused([](InputPlc& input) { input.regions = {{{HUGE_VAL, 0, 0}, 1, 0}}; });
}

TEST(Arguments, AnOptionOutOfRangeIsAnError) {
  const InputPlc input = tetrahedron();
  const auto expect_refused = [&](const auto& spoil) {
    MeshOptions options;
    spoil(options);
    EXPECT_THROW(mesh_plc(input, options), InputError);
  };
  for (const double length : {-1.0, std::nan(""), HUGE_VAL})
    for (const SurfaceRule rule : {SurfaceRule::keep, SurfaceRule::refine, SurfaceRule::remesh})
      expect_refused([&](MeshOptions& o) { o.surface = rule, o.edge_length = length; });
  expect_refused([](MeshOptions& o) { o.flatness = -1; });
  expect_refused([](MeshOptions& o) { o.grading = std::nan(""); });
  expect_refused([](MeshOptions& o) { o.grid_scale = 0; });
  expect_refused([](MeshOptions& o) { o.threads = std::numeric_limits<unsigned>::max(); });
  expect_refused([](MeshOptions& o) { o.lattice = static_cast<Lattice>(99); });
  EXPECT_THROW(find_faults(input, std::nan("")), InputError);
  EXPECT_THROW(repair_input(input, {.gap = -1}), InputError);
  EXPECT_THROW(repair_input(input, {.seconds = std::nan("")}), InputError);
}

TEST(Arguments, TooManyTrianglesAreALimit) {
  for (const double length : {1e-6, 1e-300, std::numeric_limits<double>::denorm_min()})
    EXPECT_THROW(remesh_surface(tetrahedron(), {.edge_length = length}), LimitError);
}

TEST(Arguments, TheCommandLineAndTheLibraryHaveTheSameBounds) {
  MeshOptions options;
  options.improve.target_dihedral = 61;
  EXPECT_THROW(mesh_plc(tetrahedron(), options), InputError);
  EXPECT_THROW(improve_tet_mesh(mesh_plc(tetrahedron()).mesh, options.improve), InputError);
}

TEST(Arguments, ABackgroundNeedsASizeForEachVertex) {
  const auto expect_refused = [](const BackgroundSizes& background) {
    MeshOptions options;
    options.background = background;
    EXPECT_THROW(mesh_plc(tetrahedron(), options), InputError);
  };
  expect_refused({"", "", {{0, 0, 0}}, {}, {}});
  expect_refused({"", "", {{0, 0, 0}}, {}, {0}});
  expect_refused({"", "", {{0, 0, 0}}, {{0, 0, 0, 1}}, {1}});
  expect_refused({"", "", {{0, 0, std::nan("")}}, {}, {1}});
  MeshOptions options;
  options.background = {"", "", {{0, 0, 0}}, {}, {1}};
  EXPECT_EQ(mesh_plc(tetrahedron(), options).mesh.tetrahedra.size(), 1u);
}

TEST(Arguments, AMeshThatIsNotOneIsNotWritten) {
  const auto expect_refused = [](const auto& spoil) {
    TetMesh mesh = mesh_plc(tetrahedron()).mesh;
    spoil(mesh);
    for (const char* ending : {".mesh", ".meshb", ".vtu", ".msh", ".msh4", ".node"})
      EXPECT_THROW(write_tet_mesh(mesh, std::filesystem::temp_directory_path() / ("refused" + std::string(ending))),
                   OutputError);
  };
  expect_refused([](TetMesh& mesh) { mesh.tetrahedra[0][3] = 4; });
  expect_refused([](TetMesh& mesh) { mesh.faces[0][0] = 4; });
  expect_refused([](TetMesh& mesh) { mesh.edges = {{0, 4}}; });
  expect_refused([](TetMesh& mesh) { mesh.regions = {1, 2}; });
  expect_refused([](TetMesh& mesh) { mesh.face_markers.pop_back(); });
  expect_refused([](TetMesh& mesh) { mesh.vertices[0].x = HUGE_VAL; });
}

}  // namespace
}  // namespace ccdt
