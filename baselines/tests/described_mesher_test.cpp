#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <utility>

#include "baselines/external_program.h"
#include "baselines/known_meshers.h"
#include "baselines/mesher_description.h"
#include "baselines/mesher_input.h"
#include "baselines/tests/plain_options.h"
#include "baselines/tests/shapes.h"
#include "engine/base/digits.h"
#include "engine/base/errors.h"
#include "engine/io/tet_mesh_files.h"

namespace ccdt {
namespace {

/// A mesher made of a shell script, in whose folder there is a mesh of a cube.
class ScriptMesher : public testing::Test {
 protected:
  ScriptMesher() {
    TetMesh mesh = shapes::cube_mesh();
    for (auto& t : mesh.tetrahedra) std::swap(t[0], t[1]);  // some programs orient the other way
    io::write_tet_mesh(mesh, folder_.path() / "cube.mesh");
    description_.file = folder_.path() / "mine.json";
    description_.name = "mine";
    description_.command = {"./mine.sh", "{input}", "{here}/cube.mesh", "{max_volume}", "{quality}"};
    description_.input_format = "off";
    description_.output = "{stem}.out.mesh";
    description_.choices = {{"quality", baselines::ChoiceCondition::improvement, "good, edges of {edge_length}", ""}};
    script(R"(cp "$2" input.out.mesh; echo "read in 5 s"; echo "refined in 0.25 s"; echo "optimized in 0.5 s")");
  }

  void script(const std::string& body) const {
    const auto file = folder_.path() / "mine.sh";
    std::ofstream(file) << "#!/bin/sh\n" << body << "\n";
    std::filesystem::permissions(file, std::filesystem::perms::owner_all);
  }

  baselines::MesherRun run(const InputPlc& plc = shapes::cube(), const MeshOptions& options = unimproved()) const {
    return baselines::described_mesher(description_).run(plc, options, {});
  }

  /// The message of the error that a run ends with.
  std::string reason() const {
    try {
      run();
    } catch (const Error& error) {
      EXPECT_NE(error.remedy(), "");
      return error.what();
    }
    return "it does not fail";
  }

  const std::filesystem::path& folder() const { return folder_.path(); }

  baselines::MesherDescription description_;

 private:
  baselines::TemporaryFolder folder_;
};

TEST_F(ScriptMesher, GivesAMeshThatIsOrientedAndHasItsBoundary) {
  const baselines::MesherRun made = run();
  EXPECT_EQ(made.result.counts.tetrahedra, 6u);
  EXPECT_EQ(made.result.counts.faces, 12u);
  EXPECT_EQ(made.result.counts.steiner_vertices + made.result.counts.interior_vertices, 0u);
  for (const auto& t : made.result.mesh.tetrahedra) {
    const auto& v = made.result.mesh.vertices;
    EXPECT_GT(dot(cross(v[t[1]] - v[t[0]], v[t[2]] - v[t[0]]), v[t[3]] - v[t[0]]), 0);
  }
}

TEST_F(ScriptMesher, GetsTheChosenOptionsAndReportsItsCommand) {
  MeshOptions options = {.edge_length = 2};
  options.improve.improvement = Improvement::all;
  const std::string folder_name = folder().string();
  EXPECT_EQ(run(shapes::cube(), options).settings.at(1).second, "./mine.sh input.off " + folder_name + "/cube.mesh " +
                                                                    digits(baselines::largest_tetrahedron_volume(2)) +
                                                                    " 'good, edges of 2'");
  options.improve.improvement = Improvement::none;
  const baselines::MesherSettings settings =
      baselines::settings_of(baselines::described_mesher(description_), shapes::cube(), options);
  EXPECT_TRUE(settings.at(1).second.ends_with(" ''")) << settings.at(1).second;
}

TEST_F(ScriptMesher, FindsItsFilesAndItsEnvironment) {
  description_.files = {{"size.txt", "h = {edge_length} {1}"}};
  description_.environment = {{"CCDT_TEST_WORD", "{stem}"}};
  script(R"sh(
    [ "$(cat size.txt)" = "h = 0.5 {1}" ] && [ "$CCDT_TEST_WORD" = input ] && [ -f "$1" ] && cp "$2" input.out.mesh)sh");
  EXPECT_EQ(run(shapes::cube(), unimproved(0.5)).settings.at(2).second, "h = 0.5 {1}");
}

TEST_F(ScriptMesher, TakesTheSecondsFromTheLogOrSaysThatItCannot) {
  description_.seconds_pattern = "^(?!read).* in ([0-9.]+) s";
  EXPECT_EQ(run().result.costs.mesh_seconds, 0.75);
  EXPECT_TRUE(run().notes.empty());
  description_.seconds_pattern = "took ([0-9.]+) s";
  EXPECT_GT(run().result.costs.mesh_seconds, 0);
  EXPECT_EQ(run().notes.size(), 1u);
}

TEST_F(ScriptMesher, ThatFailsIsQuoted) {
  script("echo first; echo 'facet 7 is bad' >&2; exit 4");
  EXPECT_EQ(reason(), "mine ended with code 4; it printed: first | facet 7 is bad");
  script("kill -SEGV $$");
  EXPECT_EQ(reason(), "mine ended with code 139, by signal 11; it printed: ");
  script("echo done");
  EXPECT_EQ(reason(), "mine wrote no file input.out.mesh; it printed: done");
  script("echo nonsense > input.out.mesh");
  EXPECT_TRUE(reason().starts_with("what mine wrote cannot be read: input.out.mesh, line 1: ")) << reason();
  description_.command[0] = "no-such-mesher";
  description_.install = "get it somewhere";
  EXPECT_EQ(reason(), "/command/0: there is no program 'no-such-mesher'");
}

TEST_F(ScriptMesher, MayEndWithAnotherCodeThatMeansSuccess) {
  script(R"(cp "$2" input.out.mesh; exit 2)");
  EXPECT_THROW(run(), MeshError);
  description_.success_codes = {0, 2};
  EXPECT_EQ(run().result.counts.tetrahedra, 6u);
}

TEST_F(ScriptMesher, SaysItsVersionOnce) {
  EXPECT_EQ(baselines::version_of(baselines::described_mesher(description_)), baselines::unknown_version);
  description_.version_command = {"./mine.sh", "{here}/said"};
  description_.version_pattern = "version ([0-9.]+)";
  script("[ -f \"$1\" ] && exit; touch \"$1\"; echo Mine; echo 'this is version 4.2, of 2026'; exit 1");
  const baselines::Mesher mine = baselines::described_mesher(description_);
  EXPECT_EQ(baselines::version_of(mine), "4.2");
  EXPECT_EQ(baselines::version_of(mine), "4.2");
  EXPECT_EQ(baselines::version_of(baselines::described_mesher(description_)), baselines::unknown_version)
      << "now it says nothing";
}

TEST_F(ScriptMesher, GetsTrianglesWhereItReadsASurface) {
  InputPlc plc = shapes::cube();
  plc.triangles.clear();
  for (const auto& polygon : std::vector<std::vector<std::uint32_t>>{
           {0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}})
    plc.polygon_facets.push_back({{polygon}, {}, 0, static_cast<std::uint32_t>(plc.polygon_facets.size())});
  script(R"([ $(grep -c '^3 ' "$1") = 12 ] && cp "$2" input.out.mesh)");
  EXPECT_EQ(run(plc).result.counts.tetrahedra, 6u);
}

TEST_F(ScriptMesher, RefusesWhatItsFormatCannotHold) {
  InputPlc plc = shapes::cube();
  plc.holes = {{0.5, 0.5, 0.5}};
  EXPECT_THROW(run(plc), MeshError);
  description_.input_format = "poly";
  EXPECT_EQ(run(plc).result.counts.tetrahedra, 6u);
}

std::string described(const std::string& name) {
  return std::string(DESCRIBED_FOLDER) + "/" + name + ".json";
}

TEST(TetgenProgram, MakesWhatTheLibraryMakes) {
  if (!baselines::find_on_path("tetgen")) GTEST_SKIP() << "the program tetgen is not installed";
  const baselines::Mesher& program = baselines::mesher(described("tetgen-program"));
  EXPECT_EQ(baselines::version_of(program), "1.5");
  const baselines::MesherRun made = program.run(shapes::cube_with_grid(5), unimproved(0.2), {});
  EXPECT_EQ(made.result.counts.steiner_vertices, 0u);
  EXPECT_GT(made.result.counts.interior_vertices, 20u);
  EXPECT_TRUE(made.settings.at(1).second.starts_with("tetgen -pYq1.414/10a0.001")) << made.settings.at(1).second;
  InputPlc plc = shapes::cube_with_hole();
  EXPECT_EQ(program.run(plc, bare, {}).settings.at(1).second, "tetgen -p input.poly");
  plc.inside = InputPlc::Inside::seeds;
  plc.regions = {{{0.5, 0.5, 0.5}, 3, 0}, {{1.5, 1.5, 1.5}, 4, 0}};
  const baselines::MesherRun regions = program.run(plc, bare, {});
  EXPECT_GT(std::ranges::count(regions.result.mesh.regions, 3), 0);
  EXPECT_GT(std::ranges::count(regions.result.mesh.regions, 4), 0);
}

TEST(GmshDelaunay, KeepsTheSurfaceOfACubeWithAHole) {
  if (!baselines::find_on_path("gmsh")) GTEST_SKIP() << "the program gmsh is not installed";
  const baselines::Mesher& program = baselines::mesher(described("gmsh-delaunay"));
  EXPECT_NE(baselines::version_of(program), baselines::unknown_version);
  InputPlc plc = shapes::cube_with_hole();
  for (Point3& p : plc.vertices) p = 0.1 * p + Point3{0.1, 0.7, 1.0 / 3};
  const baselines::MesherRun made = program.run(plc, bare, {});
  EXPECT_EQ(made.result.counts.steiner_vertices, 0u);
  EXPECT_EQ(made.result.counts.faces, 24u);
  double volume = 0;
  for (const auto& t : made.result.mesh.tetrahedra) {
    const auto& v = made.result.mesh.vertices;
    volume += dot(cross(v[t[1]] - v[t[0]], v[t[2]] - v[t[0]]), v[t[3]] - v[t[0]]) / 6;
  }
  EXPECT_NEAR(volume, 0.026, 1e-12);
}

TEST(GmshDelaunay, RefinesAndOptimizesAsAsked) {
  if (!baselines::find_on_path("gmsh")) GTEST_SKIP() << "the program gmsh is not installed";
  MeshOptions options = {.edge_length = 0.1};
  options.improve.improvement = Improvement::none;
  const auto count = [&] {
    const baselines::MesherRun made =
        baselines::mesher(described("gmsh-delaunay")).run(shapes::cube_with_grid(5), options, {});
    EXPECT_NE(made.settings.at(2).second.find("Mesh.Optimize = 0;"), std::string::npos);
    return made.result.counts.interior_vertices;
  };
  const std::size_t fine = count();
  options.edge_length = 0.2;
  const std::size_t coarse = count();
  EXPECT_GT(fine, 2 * coarse);
  options.lattice = Lattice::none;
  EXPECT_LT(count(), coarse);
}

// HXT keeps the number of a surface and loses its physical group. A stand-in does the same to one tetrahedron.
TEST(Hxt, KeepsFaceMarkers) {
  if (!baselines::find_on_path("gmsh")) GTEST_SKIP() << "the program gmsh is not installed";
  const baselines::TemporaryFolder folder;
  const auto program = folder.path() / "tetMesh_CLI";
  std::ofstream(program) << R"sh(#!/bin/sh
for file; do input=$output; output=$file; done
awk '
  /^[$]EndElements/ { print count + 1, 4, 2, 0, 1, 1, 2, 3, 4 }
  $2 == 2 && NF == 8 { $4 = 0 }
  expects_count { count = $1; $1 = count + 1 }
  { expects_count = /^[$]Elements/; print }
' "$input" > "$output"
)sh";
  std::filesystem::permissions(program, std::filesystem::perms::owner_all);
  baselines::MesherDescription description = baselines::read_mesher_description(described("hxt"));
  description.environment = {{"PATH", folder.path().string() + ":" + std::getenv("PATH")}};
  InputPlc plc;
  plc.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  plc.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  plc.triangle_markers = {7, 8, 9, 10};
  std::vector<int> markers =
      baselines::described_mesher(description).run(plc, unimproved(), {}).result.mesh.face_markers;
  std::ranges::sort(markers);
  EXPECT_EQ(markers, plc.triangle_markers);
}

}  // namespace
}  // namespace ccdt
