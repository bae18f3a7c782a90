#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "engine/io/plc_files.h"
#include "engine/io/tet_mesh_files.h"
#include "tools/tests/program.h"

namespace ccdt {
namespace {

constexpr std::size_t around = 24;

/// A square plate of thickness 0.5 with a round hole. Vertices 4k to 4k+3 are at the angle k/24: on the rim of the
/// square and of the hole, below and above.
plc::InputPlc plate_with_hole() {
  plc::InputPlc plate;
  for (std::uint32_t k = 0; k < around; ++k) {
    const double angle = 2 * M_PI * k / around, c = std::cos(angle), s = std::sin(angle);
    const double rim = 2 / std::max(std::fabs(c), std::fabs(s));
    for (const double radius : {rim, 1.0})
      for (const double z : {0.0, 0.5}) plate.vertices.push_back({radius * c, radius * s, z});
    const std::uint32_t here = 4 * k, next = 4 * ((k + 1) % around);
    const auto quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c_, std::uint32_t d) {
      plate.triangles.push_back({a, b, c_});
      plate.triangles.push_back({a, c_, d});
    };
    quad(here, next, next + 1, here + 1);          // outside
    quad(here + 2, here + 3, next + 3, next + 2);  // hole
    quad(here, here + 2, next + 2, next);          // below
    quad(here + 1, next + 1, next + 3, here + 3);  // above
  }
  return plate;
}

/// The corners of the faces with each marker.
std::map<int, std::vector<Point3>> points_by_marker(const std::filesystem::path& file) {
  const mesh::TetMesh mesh = io::read_tet_mesh(file);
  std::map<int, std::vector<Point3>> points;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    for (const std::uint32_t v : mesh.faces[f]) points[mesh.face_markers[f]].push_back(mesh.vertices[v]);
  return points;
}

bool are_in_an_axis_plane(const std::vector<Point3>& points) {
  for (const auto axis : {&Point3::x, &Point3::y, &Point3::z})
    if (std::ranges::all_of(points, [&](const Point3& p) { return std::fabs(p.*axis - points[0].*axis) < 1e-6; }))
      return true;
  return false;
}

TEST_F(Program, MarkersByAngleDivideABoxIntoItsSides) {
  ASSERT_EQ(run("model cube --edge-length 0.5 -o box.stl").exit_code, 0);
  ASSERT_EQ(run("mesh box.stl -o box.msh --markers by-angle").exit_code, 0);
  const auto box = points_by_marker(work() / "box.msh");
  EXPECT_EQ(box.size(), 6u);
  int expected = 1;
  for (const auto& [marker, points] : box) {
    EXPECT_EQ(marker, expected++);
    EXPECT_TRUE(are_in_an_axis_plane(points)) << marker;
  }
  EXPECT_EQ(run("verify box.stl box.msh --markers by-angle").exit_code, 0);
  ASSERT_EQ(run("mesh box.stl -o plain.msh").exit_code, 0);
  EXPECT_EQ(points_by_marker(work() / "plain.msh").size(), 1u);
}

TEST_F(Program, MarkersByAngleTakeTheWallOfAHoleAsOneSurface) {
  io::write_plc(plate_with_hole(), work() / "plate.stl");
  ASSERT_EQ(run("mesh plate.stl -o plate.msh --markers by-angle").exit_code, 0);
  const auto surfaces = points_by_marker(work() / "plate.msh");
  ASSERT_EQ(surfaces.size(), 7u);
  for (const auto& [marker, points] : surfaces) {
    const bool is_wall = std::ranges::all_of(points, [](const Point3& p) { return std::hypot(p.x, p.y) < 1.001; });
    EXPECT_EQ(is_wall, marker == 2) << "the second triangle that begins a surface is that of the hole";
    EXPECT_NE(is_wall, are_in_an_axis_plane(points)) << marker;
  }
  EXPECT_EQ(run("verify plate.stl plate.msh --markers by-angle").exit_code, 0);
  // The wall turns by 15 degrees at each of its edges.
  ASSERT_EQ(run("mesh plate.stl -o plate.msh --markers by-angle --sharp-angle 14").exit_code, 0);
  EXPECT_EQ(points_by_marker(work() / "plate.msh").size(), 6 + around);
  EXPECT_EQ(run("verify plate.stl plate.msh --markers by-angle --sharp-angle 14").exit_code, 0);
  EXPECT_EQ(run("verify plate.stl plate.msh --markers by-angle").exit_code, 1);
}

TEST_F(Program, MarkersByAngleAreThoseOfARepairedCopyToo) {
  plc::InputPlc plate = plate_with_hole();
  plate.triangles.push_back(plate.triangles[0]);
  io::write_plc(plate, work() / "twice.stl");
  EXPECT_EQ(run("mesh twice.stl -o twice.msh --markers by-angle").exit_code, 3);
  ASSERT_EQ(run("mesh twice.stl -o twice.msh --markers by-angle --repair").exit_code, 0);
  EXPECT_EQ(points_by_marker(work() / "twice.msh").size(), 7u);
  ASSERT_EQ(run("check twice.stl --repair -o once.obj --markers by-angle").exit_code, 0);
  EXPECT_EQ(run("verify once.obj twice.msh").exit_code, 0);
  EXPECT_EQ(run("check twice.stl --repair -o once.off --markers by-angle").exit_code, 3) << "it would lose the markers";
  EXPECT_EQ(run("check twice.stl --markers by-angle").exit_code, 2);
}

TEST_F(Program, MarkersByAngleReplaceNoMarkersOfTheFile) {
  plc::InputPlc plate = plate_with_hole();
  plate.triangle_markers.assign(plate.triangles.size(), 5);
  io::write_plc(plate, work() / "plate.obj");
  ASSERT_EQ(run("mesh plate.obj -o plate.msh --markers by-angle").exit_code, 0) << "one marker says nothing";
  EXPECT_EQ(points_by_marker(work() / "plate.msh").size(), 7u);
  plate.triangle_markers[0] = 6;
  io::write_plc(plate, work() / "plate.obj");
  EXPECT_EQ(run("mesh plate.obj -o plate.msh --markers by-angle").exit_code, 3);
  EXPECT_EQ(run("verify plate.obj plate.msh --markers by-angle").exit_code, 3);
}

}  // namespace
}  // namespace ccdt
