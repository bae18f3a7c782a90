#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>

#include "engine/base/errors.h"
#include "engine/io/plc_files.h"
#include "engine/io/tet_mesh_files.h"

namespace ccdt::io_test {

/// A temporary folder for a test, removed at its end.
class Folder {
 public:
  Folder() {
    static int counter = 0;
    path_ = std::filesystem::temp_directory_path() /
            ("ccdt-io-" + std::to_string(::getpid()) + "-" + std::to_string(counter++));
    std::filesystem::create_directories(path_);
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  const std::filesystem::path& path() const { return path_; }
  std::size_t files() const {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(path_), {}));
  }

 private:
  std::filesystem::path path_;
};

inline std::filesystem::path put(const std::filesystem::path& file, std::string_view bytes) {
  std::ofstream(file, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  return file;
}

inline std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Reads a PLC file of this name and content.
inline plc::InputPlc plc_of(const std::string& name, std::string_view bytes) {
  const Folder folder;
  return io::read_plc(put(folder / name, bytes));
}

inline mesh::TetMesh mesh_of(const std::string& name, std::string_view bytes) {
  const Folder folder;
  return io::read_tet_mesh(put(folder / name, bytes));
}

/// What an error must carry, whatever its wording; missing parts are not compared.
struct Expected {
  std::string_view data = {};  ///< what the message quotes from the file, or a number
  std::optional<long long> line = std::nullopt, byte = std::nullopt, facet = std::nullopt;
};

/// Runs `read` and expects an InputError that names a file, has a remedy, and carries the expected data.
template <class Read>
void expect_input_error(Read read, const Expected& expected) {
  try {
    read();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(expected.data), std::string::npos) << error.what();
    EXPECT_FALSE(error.remedy().empty()) << error.what();
    EXPECT_FALSE(error.place().file.empty()) << error.what();
    if (expected.line) {
      EXPECT_EQ(error.place().line, *expected.line) << error.what();
    }
    if (expected.byte) {
      EXPECT_EQ(error.place().byte, *expected.byte) << error.what();
    }
    if (expected.facet) {
      EXPECT_EQ(error.place().facets, std::vector<long long>{*expected.facet}) << error.what();
    }
    return;
  }
  ADD_FAILURE() << "not refused";
}

inline void expect_refused(const std::string& name, std::string_view bytes, const Expected& expected) {
  SCOPED_TRACE(name);
  expect_input_error([&] { plc_of(name, bytes); }, expected);
}

inline void expect_mesh_refused(const std::string& name, std::string_view bytes, const Expected& expected) {
  SCOPED_TRACE(name);
  expect_input_error([&] { mesh_of(name, bytes); }, expected);
}

/// Coordinates that show every lost bit.
inline const std::vector<Point3> awkward_points = {{0.1, 1.0 / 3, -0.0},
                                                   {1e-310, 1e300, 3},
                                                   {-1.0000000000000002, 2, 123456789.123456789},
                                                   {5e-324, 0.3, 7},
                                                   {1, 1, 1}};

/// A tetrahedron and a quadrilateral over the awkward points.
inline plc::InputPlc awkward_surface() {
  plc::InputPlc plc;
  plc.vertices = awkward_points;
  plc.triangles = {{0, 1, 2}, {2, 1, 3}, {4, 0, 2}};
  plc.triangle_numbers = {0, 2, 3};
  plc.polygon_facets.push_back({{{0, 1, 3, 4}}, {}, 0, 1});
  return plc;
}

/// All that a .poly can hold.
inline plc::InputPlc rich_plc() {
  plc::InputPlc plc = awkward_surface();
  plc.inside = plc::InputPlc::Inside::seeds;
  plc.triangle_markers = {5, -7, 0};
  plc.polygon_facets[0].marker = 9;
  plc.polygon_facets[0].polygons.push_back({1, 2});
  plc.polygon_facets[0].polygons.push_back({3});
  plc.polygon_facets[0].holes = {{0.1, 0.2, 0.3}};
  plc.segments = {{0, 4}, {1, 3}};
  plc.segment_markers = {0, 3};
  plc.holes = {{0.5, 0.25, 1.0 / 3}};
  plc.regions = {{{1, 2, 3}, -4, 0}, {{0.1, 0.2, 0.7}, 12, 0.001}};
  return plc;
}

inline void expect_same_points(const std::vector<Point3>& a, const std::vector<Point3>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i], b[i]) << "point " << i;
    EXPECT_EQ(std::signbit(a[i].z), std::signbit(b[i].z)) << "point " << i;
  }
}

inline void expect_same_plc(const plc::InputPlc& a, const plc::InputPlc& b) {
  EXPECT_EQ(a.inside, b.inside);
  expect_same_points(a.vertices, b.vertices);
  EXPECT_EQ(a.triangles, b.triangles);
  EXPECT_EQ(a.triangle_markers, b.triangle_markers);
  EXPECT_EQ(a.triangle_numbers, b.triangle_numbers);
  ASSERT_EQ(a.polygon_facets.size(), b.polygon_facets.size());
  for (std::size_t i = 0; i < a.polygon_facets.size(); ++i) {
    EXPECT_EQ(a.polygon_facets[i].polygons, b.polygon_facets[i].polygons);
    expect_same_points(a.polygon_facets[i].holes, b.polygon_facets[i].holes);
    EXPECT_EQ(a.polygon_facets[i].marker, b.polygon_facets[i].marker);
    EXPECT_EQ(a.polygon_facets[i].number, b.polygon_facets[i].number);
  }
  EXPECT_EQ(a.segments, b.segments);
  EXPECT_EQ(a.segment_markers, b.segment_markers);
  expect_same_points(a.holes, b.holes);
  ASSERT_EQ(a.regions.size(), b.regions.size());
  for (std::size_t i = 0; i < a.regions.size(); ++i) {
    EXPECT_EQ(a.regions[i].seed, b.regions[i].seed);
    EXPECT_EQ(a.regions[i].attribute, b.regions[i].attribute);
    EXPECT_EQ(a.regions[i].max_volume, b.regions[i].max_volume);
  }
}

/// Two tetrahedra with all attributes, of all signs.
inline mesh::TetMesh small_mesh() {
  mesh::TetMesh mesh;
  mesh.vertices = awkward_points;
  mesh.tetrahedra = {{0, 1, 2, 3}, {1, 2, 3, 4}};
  mesh.regions = {0, -12};
  mesh.faces = {{0, 1, 2}, {4, 3, 2}, {0, 1, 3}};
  mesh.face_markers = {-1, 0, 2000000000};
  mesh.edges = {{0, 1}, {3, 4}};
  mesh.edge_markers = {7, 0};
  mesh.constrained_delaunay = true;
  return mesh;
}

inline void expect_same_mesh(const mesh::TetMesh& a, const mesh::TetMesh& b) {
  expect_same_points(a.vertices, b.vertices);
  EXPECT_EQ(a.tetrahedra, b.tetrahedra);
  EXPECT_EQ(a.regions, b.regions);
  EXPECT_EQ(a.faces, b.faces);
  EXPECT_EQ(a.face_markers, b.face_markers);
  EXPECT_EQ(a.edges, b.edges);
  EXPECT_EQ(a.edge_markers, b.edge_markers);
  EXPECT_EQ(a.constrained_delaunay, b.constrained_delaunay);
}

}  // namespace ccdt::io_test
