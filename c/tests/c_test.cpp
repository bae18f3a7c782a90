#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "c/ccdt.h"

// Only what is in the header of C is used here: the library exports nothing else.

namespace {

constexpr double cube_vertices[] = {0, 0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 1, 0, 0, 1, 0, 1, 1, 1, 0, 1, 1, 1};
constexpr std::uint32_t cube_triangles[] = {0, 1, 3, 0, 3, 2, 4, 6, 7, 4, 7, 5, 0, 4, 5, 0, 5, 1,
                                            2, 3, 7, 2, 7, 6, 0, 2, 6, 0, 6, 4, 1, 5, 7, 1, 7, 3};

/// A handle that is freed.
template <class Handle, void (*Free)(Handle*)>
struct Owner {
  Handle* handle = nullptr;
  Owner() = default;
  Owner(const Owner&) = delete;
  Owner& operator=(const Owner&) = delete;
  ~Owner() { Free(handle); }
};
using Surface = Owner<ccdt_surface, ccdt_surface_free>;
using Options = Owner<ccdt_options, ccdt_options_free>;
using Mesh = Owner<ccdt_mesh, ccdt_mesh_free>;

void make_cube(Surface& surface, std::size_t triangles = 12, const int* markers = nullptr) {
  ASSERT_EQ(ccdt_surface_new(cube_vertices, 8, cube_triangles, triangles, markers, &surface.handle), CCDT_DONE);
}

void set(Options& options, const char* name, const char* value) {
  if (options.handle == nullptr) {
    ASSERT_EQ(ccdt_options_new(&options.handle), CCDT_DONE);
  }
  ASSERT_EQ(ccdt_options_set(options.handle, name, value), CCDT_DONE) << ccdt_error_text();
}

std::size_t tetrahedra_of(const Mesh& mesh) {
  const std::uint32_t* corners = nullptr;
  std::size_t count = 0;
  EXPECT_EQ(ccdt_mesh_tetrahedra(mesh.handle, &corners, &count), CCDT_DONE);
  return count;
}

TEST(C, ArraysAreMeshedAndGivenBack) {
  int markers[12];
  for (int t = 0; t < 12; ++t) markers[t] = t / 2;
  Surface surface;
  make_cube(surface, 12, markers);
  Options options;
  set(options, "edge-length", "0.5");
  set(options, "surface", "refine");
  Mesh mesh;
  ASSERT_EQ(ccdt_mesh_make(surface.handle, options.handle, &mesh.handle), CCDT_DONE) << ccdt_error_text();
  const std::uint32_t* faces = nullptr;
  const int* face_markers = nullptr;
  std::size_t face_count = 0, marker_count = 0;
  ASSERT_EQ(ccdt_mesh_faces(mesh.handle, &faces, &face_count), CCDT_DONE);
  ASSERT_EQ(ccdt_mesh_face_markers(mesh.handle, &face_markers, &marker_count), CCDT_DONE);
  EXPECT_GT(face_count, 12u);
  EXPECT_EQ(marker_count, face_count);
  const double* vertices = nullptr;
  std::size_t vertex_count = 0;
  ASSERT_EQ(ccdt_mesh_vertices(mesh.handle, &vertices, &vertex_count), CCDT_DONE);
  for (std::size_t i = 0; i < 3 * face_count; ++i) EXPECT_LT(faces[i], vertex_count);
  EXPECT_GT(tetrahedra_of(mesh), 10u);
}

TEST(C, AnErrorHasAStatusATextAPlaceAndARemedy) {
  Surface open;
  make_cube(open, 11);
  Mesh mesh;
  EXPECT_EQ(ccdt_mesh_make(open.handle, nullptr, &mesh.handle), CCDT_BAD_INPUT);
  EXPECT_EQ(mesh.handle, nullptr);
  EXPECT_FALSE(std::string(ccdt_error_text()).empty());
  EXPECT_FALSE(std::string(ccdt_error_remedy()).empty());
  std::size_t count = 0;
  ASSERT_NE(ccdt_error_points(&count), nullptr);
  EXPECT_GT(count, 0u);
  EXPECT_EQ(ccdt_surface_check(open.handle), CCDT_BAD_INPUT);
  Surface absent;
  EXPECT_EQ(ccdt_surface_read("absent.stl", &absent.handle), CCDT_BAD_INPUT);
  EXPECT_EQ(std::string(ccdt_error_file()), "absent.stl");
}

TEST(C, WrongOptionsAreRefused) {
  Options options;
  set(options, "edge_length", "1");
  for (const auto& [name, value] : std::vector<std::pair<const char*, const char*>>{{"edge-length", "-1"},
                                                                                    {"edge-length", "nan"},
                                                                                    {"edge-length", "1x"},
                                                                                    {"surface", "shiny"},
                                                                                    {"no", "1"},
                                                                                    {"threads", "0"},
                                                                                    {"sizes", "absent.sol"},
                                                                                    {"size-field", "field.json"}})
    EXPECT_EQ(ccdt_options_set(options.handle, name, value), CCDT_BAD_INPUT) << name << " " << value;
}

TEST(C, NullPointersAreRefused) {
  Surface surface;
  make_cube(surface);
  Mesh mesh;
  EXPECT_EQ(ccdt_mesh_make(nullptr, nullptr, &mesh.handle), CCDT_BAD_CALL);
  EXPECT_EQ(ccdt_mesh_make(surface.handle, nullptr, nullptr), CCDT_BAD_CALL);
  EXPECT_EQ(ccdt_surface_read(nullptr, &surface.handle), CCDT_BAD_CALL);
  EXPECT_EQ(ccdt_mesh_write(nullptr, "a.vtu"), CCDT_BAD_CALL);
  EXPECT_EQ(ccdt_options_set(nullptr, "a", "b"), CCDT_BAD_CALL);
  ccdt_mesh_free(nullptr);
}

TEST(C, ASizeFunctionIsAsked) {
  Surface surface;
  make_cube(surface);
  Options options;
  set(options, "edge-length", "0.5");
  set(options, "surface", "refine");
  Mesh plain, fine;
  ASSERT_EQ(ccdt_mesh_make(surface.handle, options.handle, &plain.handle), CCDT_DONE);
  double length = 0.1;
  const auto constant = [](const double*, std::size_t count, double* lengths, void* data) {
    for (std::size_t i = 0; i < count; ++i) lengths[i] = *static_cast<double*>(data);
  };
  ASSERT_EQ(ccdt_options_set_size_function(options.handle, constant, &length), CCDT_DONE);
  ASSERT_EQ(ccdt_mesh_make(surface.handle, options.handle, &fine.handle), CCDT_DONE) << ccdt_error_text();
  EXPECT_GT(tetrahedra_of(fine), 10 * tetrahedra_of(plain));
}

TEST(C, AFlagCancels) {
  Surface surface;
  make_cube(surface);
  Options options;
  set(options, "edge-length", "0.01");
  set(options, "surface", "refine");
  int flag = 1;
  ASSERT_EQ(ccdt_options_set_cancel_flag(options.handle, &flag), CCDT_DONE);
  Mesh mesh;
  EXPECT_EQ(ccdt_mesh_make(surface.handle, options.handle, &mesh.handle), CCDT_CANCELED);
}

TEST(C, EachThreadHasItsLastError) {
  Surface surface;
  EXPECT_EQ(ccdt_surface_read("absent.stl", &surface.handle), CCDT_BAD_INPUT);
  std::thread([] { EXPECT_EQ(std::string(ccdt_error_text()), ""); }).join();
  EXPECT_NE(std::string(ccdt_error_text()), "");
}

TEST(C, PolygonsHolesAndRegionsAreAdded) {
  Surface surface;
  ASSERT_EQ(ccdt_surface_new(cube_vertices, 8, nullptr, 0, nullptr, &surface.handle), CCDT_DONE);
  constexpr std::uint32_t squares[6][4] = {{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 4, 5, 1},
                                           {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}};
  for (const auto& square : squares) EXPECT_EQ(ccdt_surface_add_polygon(surface.handle, square, 4, 3), CCDT_DONE);
  EXPECT_EQ(ccdt_surface_add_segment(surface.handle, 0, 7, 5), CCDT_DONE);
  const double center[] = {0.5, 0.4, 0.3};
  EXPECT_EQ(ccdt_surface_add_region(surface.handle, center, 42, 0), CCDT_DONE);
  Mesh mesh, better;
  ASSERT_EQ(ccdt_mesh_make(surface.handle, nullptr, &mesh.handle), CCDT_DONE) << ccdt_error_text();
  const int* numbers = nullptr;
  std::size_t count = 0;
  ASSERT_EQ(ccdt_mesh_regions(mesh.handle, &numbers, &count), CCDT_DONE);
  for (std::size_t t = 0; t < count; ++t) EXPECT_EQ(numbers[t], 42);
  EXPECT_EQ(ccdt_mesh_improve(mesh.handle, nullptr, &better.handle), CCDT_DONE) << ccdt_error_text();
  EXPECT_EQ(ccdt_surface_add_hole(surface.handle, center), CCDT_DONE);
  EXPECT_EQ(ccdt_mesh_make(surface.handle, nullptr, &better.handle), CCDT_BAD_INPUT);  // nothing is left
}

TEST(C, AnOpenSurfaceIsRepaired) {
  Surface open, closed;
  make_cube(open, 11);
  EXPECT_EQ(ccdt_surface_repair(open.handle, 0, 0, &closed.handle), CCDT_BAD_INPUT);
  ASSERT_EQ(ccdt_surface_repair(open.handle, 0, 1, &closed.handle), CCDT_DONE) << ccdt_error_text();
  EXPECT_EQ(ccdt_surface_check(closed.handle), CCDT_DONE);
  const std::uint32_t* corners = nullptr;
  std::size_t count = 0;
  ASSERT_EQ(ccdt_surface_triangles(closed.handle, &corners, &count), CCDT_DONE);
  EXPECT_EQ(count, 12u);
}

TEST(C, FilesAreWrittenAndReadBack) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path();
  const std::string file =
      (folder / ("ccdt_c_test_" + std::to_string(std::hash<std::thread::id>()(std::this_thread::get_id())) + ".vtu"))
          .string();
  Surface surface;
  make_cube(surface);
  Mesh mesh, read;
  ASSERT_EQ(ccdt_mesh_make(surface.handle, nullptr, &mesh.handle), CCDT_DONE);
  ASSERT_EQ(ccdt_mesh_write(mesh.handle, file.c_str()), CCDT_DONE) << ccdt_error_text();
  ASSERT_EQ(ccdt_mesh_read(file.c_str(), &read.handle), CCDT_DONE) << ccdt_error_text();
  EXPECT_EQ(tetrahedra_of(read), tetrahedra_of(mesh));
  std::filesystem::remove(file);
}

}  // namespace
