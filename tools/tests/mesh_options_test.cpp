#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "baselines/mesher_options.h"
#include "tools/tests/program.h"

namespace ccdt {
namespace {

/// The options that --help of `ccdt mesh` lists: "--lattice" as "lattice".
std::set<std::string> options_in(const std::string& help) {
  std::set<std::string> names;
  std::istringstream words(help);
  for (std::string line; std::getline(words, line);) {
    const auto begin = line.find_first_not_of(' ');
    const auto dashes = line.find("--");
    if (begin > 4 || dashes == std::string::npos || line[begin] != '-') continue;
    names.insert(line.substr(dashes + 2, line.find_first_of(" ,", dashes) - dashes - 2));
  }
  return names;
}

TEST_F(Program, MeshHasTheOptionsWhoseEffectsAreKnown) {
  std::set<std::string> listed = options_in(run("mesh --help").out);
  for (const char* no_effect :
       {"help", "quiet", "output", "input-format", "format", "order", "partitions", "surface-output", "report", "json",
        "repair", "markers", "mesher", "require-dihedral", "require-r"})
    EXPECT_EQ(listed.erase(no_effect), 1u) << no_effect;
  EXPECT_EQ(listed.erase("strategies"), 1u) << "it stands for others";
  std::set<std::string> known;
  for (const auto& [name, usual] : baselines::usual_options()) known.insert(name);
  EXPECT_EQ(listed, known);
}

TEST_F(Program, MeshWritesElementsOfSecondOrderWhereTheFormatHoldsThem) {
  EXPECT_EQ(run("mesh missing.off -o out.vtu --order 3").exit_code, 2);
  ASSERT_EQ(run("model cube --edge-length 1 -o part.off").exit_code, 0);
  EXPECT_EQ(run("mesh part.off -o out.mesh --order 2").exit_code, 3);
  EXPECT_FALSE(std::filesystem::exists(work() / "out.mesh"));
  EXPECT_EQ(run("mesh part.off -o out.vtu --order 2").exit_code, 0);
  EXPECT_TRUE(std::filesystem::exists(work() / "out.boundary.vtu"));
}

TEST_F(Program, MeshKnowsThePapersStrategiesByOneName) {
  ASSERT_EQ(run("model bracket --edge-length 6 -o part.poly").exit_code, 0);
  const auto options_of = [&](const std::string& words) {
    const Outcome outcome = run("mesh part.poly -o out.mesh --threads 1 --report out.json " + words);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return nlohmann::json::parse(text_of(work() / "out.json"))["options"];
  };
  const nlohmann::json paper = options_of("--strategies paper");
  const std::string paper_mesh = text_of(work() / "out.mesh");
  EXPECT_EQ(
      paper,
      options_of("--delaunay wrap --locator grid --protection midpoint --visibility faces --improve swap-smooth"));
  EXPECT_EQ(paper_mesh, text_of(work() / "out.mesh"));
  EXPECT_EQ(paper["visibility"], "faces");
  EXPECT_EQ(paper["improve"], "swap-smooth");
  EXPECT_EQ(options_of("--strategies default"), options_of(""));
  EXPECT_EQ(options_of("--strategies paper --locator octree --improve none")["locator"], "octree")
      << "an option replaces that of the strategies";
  EXPECT_EQ(options_of("--strategies paper --lattice none")["improve"], "none");
}

TEST_F(Program, MeshMakesTheSameTetrahedraWithThePapersStrategiesBeforeImprovement) {
  ASSERT_EQ(run("model bracket --edge-length 6 -o part.poly").exit_code, 0);
  const auto mesh_of = [&](const std::string& words) {
    const Outcome outcome = run(
        "mesh part.poly -o out.mesh --protection midpoint --improve none --steiner keep --report out.json " + words);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return nlohmann::json::parse(text_of(work() / "out.json"))["mesh_fingerprint"];
  };
  const nlohmann::json usual = mesh_of("");
  for (const char* check : {"on", "off"})
    EXPECT_EQ(usual, mesh_of(std::string("--strategies paper --face-protection ") + check)) << check;
}

}  // namespace
}  // namespace ccdt
