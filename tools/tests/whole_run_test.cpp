#include <algorithm>
#include <cstring>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "engine/io/plc_files.h"
#include "engine/io/tet_mesh_files.h"
#include "engine/tests/shared/mesh_test_solids.h"
#include "tools/tests/program.h"

// From a file to a verified mesh, and from a bad file to one message, only through the program.

namespace ccdt {
namespace {

using namespace mesh_test;

class WholeRun : public Program {
 protected:
  void expect_meshed_and_verified(const std::string& file, const std::string& options, const std::string& output) {
    SCOPED_TRACE(file + " " + options + " " + output);
    const Outcome mesh = run("mesh " + file + " -o " + output + " " + options);
    ASSERT_EQ(mesh.exit_code, 0) << mesh.err;
    EXPECT_EQ(mesh.err, "");
    const Outcome verify = run("verify " + file + " " + output);
    EXPECT_EQ(verify.exit_code, 0) << verify.out << verify.err;
  }

  void expect_verified_plain_and_rotated(const plc::InputPlc& plc, const std::string& ending) {
    io::write_plc(plc, work() / ("plain" + ending));
    io::write_plc(rotated(oblique, plc), work() / ("rotated" + ending));
    for (const std::string name : {"plain", "rotated"})
      for (const std::string lattice : {"none", "fcc", "bcc", "sc"})
        expect_meshed_and_verified(name + ending, "--lattice " + lattice, "mesh.vtu");
  }

  /// The tetrahedra of a mesh file as a text that does not depend on their order.
  static std::string sorted_tetrahedra(const std::filesystem::path& file) {
    auto cells = io::read_tet_mesh(file).tetrahedra;
    for (auto& cell : cells) std::ranges::sort(cell);
    std::ranges::sort(cells);
    std::string text;
    for (const auto& cell : cells)
      for (const std::uint32_t v : cell) text += std::to_string(v) + " ";
    return text;
  }

  /// Exit code 3, one message that names the file and has all of `data`, and nothing written.
  void expect_refused(const std::string& file, const std::vector<std::string>& data) {
    SCOPED_TRACE(file);
    const std::size_t before = file_count();
    const Outcome outcome = run("mesh " + file + " -o out.vtu");
    EXPECT_EQ(outcome.exit_code, 3) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(outcome.err.rfind("ccdt: " + file, 0), 0u) << outcome.err;
    EXPECT_EQ(outcome.err.find("ccdt:", 1), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find("\n  "), std::string::npos) << "no remedy: " << outcome.err;
    for (const std::string& one : data) EXPECT_NE(outcome.err.find(one), std::string::npos) << one << outcome.err;
    EXPECT_EQ(file_count(), before);
  }

  void expect_surface_refused(const plc::InputPlc& plc, const std::vector<std::string>& data) {
    io::write_plc(plc, work() / "surface.off");
    expect_refused("surface.off", data);
  }
};

TEST_F(WholeRun, SurfacesOfEveryFormat) {
  const plc::InputPlc surface = cube_with_cubic_hole();
  for (const std::string ending : {".off", ".obj", ".ply", ".stl"}) {
    io::write_plc(surface, work() / ("part" + ending));
    for (const std::string output : {"mesh.vtu", "mesh.mesh", "mesh.meshb", "mesh.msh", "mesh.msh4", "mesh.node"})
      expect_meshed_and_verified("part" + ending, "--lattice none", output);
  }
}

TEST_F(WholeRun, Surfaces) {
  for (const plc::InputPlc& plc : {plc_test::schoenhardt(), cube_with_cubic_hole(), two_cubes_as_surface(), two_bars()})
    expect_verified_plain_and_rotated(plc, ".off");
}

TEST_F(WholeRun, ComplexesWithRegionsSlitsAndDanglingParts) {
  for (const plc::InputPlc& plc : {two_cubes(), cube_within_cube(), cube_with_slit(), cube_with_dangling_facet(),
                                   cube_with_dangling_segment(), cube_with_turnstile()})
    expect_verified_plain_and_rotated(plc, ".poly");
}

TEST_F(WholeRun, CubeWithAFineGridPlainAndRotatedNeedsNoSteinerVertex) {
  for (const plc::InputPlc& plc : {gridded_cube(60), rotated(oblique, gridded_cube(60))}) {
    io::write_plc(plc, work() / "cube.off");
    expect_meshed_and_verified("cube.off", "--lattice none --report report.json", "mesh.vtu");
    EXPECT_NE(text_of(work() / "report.json").find("\"steiner_vertices\": 0,"), std::string::npos);
  }
}

TEST_F(WholeRun, TheReportSaysHowTheEdgesOfTheInputBecamePartOfTheMesh) {
  const auto meshed = [&](const plc::InputPlc& plc, const std::string& options) {
    io::write_plc(plc, work() / "part.poly");
    const Outcome mesh = run("mesh part.poly -o mesh.vtu --report report.json " + options);
    EXPECT_EQ(mesh.exit_code, 0) << mesh.err;
    const auto counts = nlohmann::json::parse(text_of(work() / "report.json")).at("counts");
    return std::pair(mesh.out, counts.at("segments").dump() + " " + counts.at("steiner_vertices").dump());
  };
  const auto [cube, cube_counts] = meshed(seeded_cube(), "--lattice none");
  EXPECT_EQ(cube_counts, R"({"all":12,"delaunay":12,"front":0,"grazeable":0,"pieces":0,"restored":0,"split":0} 0)");
  EXPECT_NE(cube.find("12: 12"), std::string::npos) << cube;

  // Each of the three reflex edges is split at its midpoint. Two of the midpoints are not needed.
  const auto [twisted, twisted_counts] = meshed(plc_test::schoenhardt(), "--lattice none --protection midpoint");
  EXPECT_EQ(twisted_counts, R"({"all":12,"delaunay":9,"front":0,"grazeable":3,"pieces":6,"restored":2,"split":3} 1)");
  EXPECT_NE(twisted.find("12: 9"), std::string::npos) << twisted;

  // The end of one bar is in the spheres of another one's edge, which is convex and needs no split.
  const auto [bars, bars_counts] = meshed(two_bars(), "--lattice none");
  EXPECT_EQ(bars_counts, R"({"all":36,"delaunay":35,"front":1,"grazeable":0,"pieces":0,"restored":0,"split":0} 0)");
  EXPECT_NE(bars.find("36: 35"), std::string::npos) << bars;
}

TEST_F(WholeRun, ModelsOfTheProgramItself) {
  for (const std::string name : {"piston", "bracket", "stepping-pole"}) {
    const std::string file = name == "bracket" ? "model.poly" : "model.off";
    ASSERT_EQ(run("model " + name + " --edge-length 8 -o " + file).exit_code, 0);
    for (const std::string lattice : {"none", "fcc", "bcc", "sc"})
      expect_meshed_and_verified(file, "--lattice " + lattice, "mesh.vtu");
    expect_meshed_and_verified(file, "--face-protection off", "mesh.vtu");
  }
}

TEST_F(WholeRun, RemeshedSurfacesKeepWhatTheyBound) {
  for (const plc::InputPlc& plc : {two_cubes(), cube_with_slit(), rotated(oblique, cube_with_dangling_facet()),
                                   rotated(oblique, gridded_plate(4, 0.05))}) {
    io::write_plc(plc, work() / "plc.poly");
    const Outcome mesh =
        run("mesh plc.poly -o mesh.vtu --surface remesh --edge-length 0.4 --surface-output new.poly --report r.json");
    ASSERT_EQ(mesh.exit_code, 0) << mesh.err;
    EXPECT_NE(text_of(work() / "r.json").find("\"surface\": \"remesh\""), std::string::npos);
    const Outcome verify = run("verify new.poly mesh.vtu");
    EXPECT_EQ(verify.exit_code, 0) << verify.out << verify.err;
  }
}

TEST_F(WholeRun, RefinedSurfacesAreThoseOfTheInput) {
  for (const plc::InputPlc& plc : {two_cubes(), cube_with_slit(), rotated(oblique, cube_with_dangling_facet())}) {
    io::write_plc(plc, work() / "plc.poly");
    for (const std::string options : {"", " --edge-length 0.4", " --edge-length 0.5 --lattice none"}) {
      const Outcome mesh = run("mesh plc.poly -o mesh.vtu --surface refine --report r.json" + options);
      ASSERT_EQ(mesh.exit_code, 0) << mesh.err;
      EXPECT_NE(text_of(work() / "r.json").find("\"surface\": \"refine\""), std::string::npos);
      const Outcome verify = run("verify plc.poly mesh.vtu");
      EXPECT_EQ(verify.exit_code, 0) << verify.out << verify.err;
    }
  }
}

TEST_F(WholeRun, EveryCombinationOfStrategiesWritesTheSameMesh) {
  io::write_plc(rotated(oblique, two_bars()), work() / "bars.off");
  std::set<std::string> meshes;
  for (const std::string delaunay : {"insert", "core", "wrap"})
    for (const std::string locator : {"grid", "octree", "cavity"})
      for (const std::string check : {"on", "off"}) {
        const std::string options = " --delaunay " + delaunay + " --locator " + locator + " --face-protection " + check;
        ASSERT_EQ(run("mesh bars.off -o mesh.node --edge-length 1 --report r.json" + options).exit_code, 0) << options;
        const std::string report = text_of(work() / "r.json");
        EXPECT_NE(report.find("\"delaunay\": \"" + delaunay + "\""), std::string::npos);
        EXPECT_NE(report.find("\"locator\": \"" + locator + "\""), std::string::npos);
        meshes.insert(sorted_tetrahedra(work() / "mesh.node"));
      }
  EXPECT_EQ(meshes.size(), 1u);
}

TEST_F(WholeRun, OpenSurfaceIsRefusedWithItsBoundary) {
  plc::InputPlc cube = unit_cube();
  cube.triangles.pop_back();
  expect_surface_refused(cube, {"(1, 0, 0)"});
}

TEST_F(WholeRun, SelfIntersectingSurfaceIsRefusedWithBothFacets) {
  plc::InputPlc pierced = box({0, 0, 0}, {4, 4, 4});
  const auto tip = static_cast<std::uint32_t>(pierced.vertices.size());
  pierced.vertices.insert(pierced.vertices.end(), {{1, 1, 1}, {3, 1, 1}, {1, 3, 1}, {1.5, 1.25, 5}});
  const std::uint32_t corner[4] = {tip, tip + 1, tip + 2, tip + 3};
  for (const auto& t : {Triangle{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}})
    pierced.triangles.push_back({corner[t[0]], corner[t[1]], corner[t[2]]});
  // The facets 2 and 3 are the top; the sides of the tetrahedron, 13 to 15, go through it.
  io::write_plc(pierced, work() / "surface.off");
  expect_refused("surface.off", {"2, 13"});
}

TEST_F(WholeRun, FacetsThatCoverEachOtherAreRefusedWithTheirPlace) {
  plc::InputPlc doubled = unit_cube();
  append(doubled, box({0.25, 0.25, 1}, {0.75, 0.75, 2}));  // on the top, which continues below it
  expect_surface_refused(doubled, {"1)"});
}

TEST_F(WholeRun, BrokenFilesAreRefused) {
  write("empty.off", "");
  expect_refused("empty.off", {});
  write("nan.off", "OFF\n4 4 0\n0 0 0\n1 nan 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n");
  expect_refused("nan.off", {":4"});
  std::filesystem::create_directory(work() / "folder.stl");
  expect_refused("folder.stl", {});
  io::write_plc(unit_cube(), work() / "cube.stl");
  const std::string whole = text_of(work() / "cube.stl");
  for (const std::size_t size : {std::size_t{90}, whole.size() / 2, whole.size() - 1}) {
    write("truncated.stl", whole.substr(0, size));
    expect_refused("truncated.stl", {});
  }
}

TEST_F(WholeRun, HeadersThatClaimGigabytesAreRefused) {
  std::string stl(84 + 50, '\0');
  const std::uint32_t claimed = 2147483648u / 50;
  std::memcpy(stl.data() + 80, &claimed, sizeof claimed);
  write("claims.stl", stl);
  expect_refused("claims.stl", {});
  write("claims.off", "OFF\n89478485 178956970 0\n0 0 0\n");
  expect_refused("claims.off", {});
  write("claims.poly", "89478485 3 0 0\n1 0 0 0\n");
  expect_refused("claims.poly", {});
  write("claims.mesh", "MeshVersionFormatted 2\nDimension 3\nVertices\n89478485\n0 0 0 0\n");
  expect_refused("claims.mesh", {});
  write("claims.ply",
        "ply\nformat binary_little_endian 1.0\nelement vertex 178956970\nproperty float x\nproperty float y\n"
        "property float z\nelement face 178956970\nproperty list uchar int vertex_indices\nend_header\nabcd");
  expect_refused("claims.ply", {});
}

TEST_F(WholeRun, SegmentThatCannotBeProtectedExitsWithFour) {
  plc::InputPlc input = seeded_cube();
  input.vertices.insert(input.vertices.end(), {{1, 1.5, 1}, {2, 1.5, 1}});
  for (const auto& [y, z] : {std::array{1e-8, 0.0}, {-5e-9, 9e-9}, {-5e-9, -9e-9}})
    input.vertices.push_back({1.3, 1.5 + y, 1 + z});
  input.segments = {{8, 9}};
  io::write_plc(input, work() / "segment.poly");
  const Outcome outcome = run("mesh segment.poly -o out.vtu --protection midpoint");
  EXPECT_EQ(outcome.exit_code, 4) << outcome.err;
  EXPECT_NE(outcome.err.find("(1, 1.5, 1)"), std::string::npos) << outcome.err;
  EXPECT_EQ(file_count(), 1u);
}

}  // namespace
}  // namespace ccdt
