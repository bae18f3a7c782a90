#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "tools/tests/experiment_json.h"
#include "tools/tests/program.h"

namespace ccdt {
namespace {

/// `ccdt reproduce` of an experiment on a sphere alone, at a small size.
class QualityExperiments : public Program {
 protected:
  Json reproduce(const std::string& experiment, const std::string& options) {
    EXPECT_EQ(run("model sphere --edge-length 0.5 -o sphere.off").exit_code, 0);
    outcome_ = run("reproduce " + experiment + " -o report --models none --input sphere.off " + options);
    EXPECT_EQ(outcome_.exit_code, 0) << outcome_.out << outcome_.err;
    EXPECT_FALSE(text_of(work() / "report" / (experiment + ".md")).empty());
    return Json::parse(text_of(work() / "report" / (experiment + ".json")));
  }

  Outcome outcome_;
};

TEST_F(QualityExperiments, CompareMeshersAtEqualNumbersOfTetrahedra) {
  const std::string help = run("mesh --help").out;
  std::string others;
  for (const std::string name : {"tetgen", "cgal-mesh3", "gmsh-hxt"})
    if (help.find("  " + name + " ") != std::string::npos) others += (others.empty() ? "" : ",") + name;
  const Json quality = reproduce("quality", "--scale 3000" + (others.empty() ? "" : " --beside " + others));
  EXPECT_EQ(quality["schema"], "ccdt.experiment/1");
  const Json rows = rows_of(quality, "quality");
  const double ours = rows[0]["values"]["tetrahedra"];
  EXPECT_NEAR(ours, 3000, 900) << rows[0];
  for (const Json& row : rows) {
    const Json& values = row["values"];
    EXPECT_EQ(values["status"], "ok") << row;
    EXPECT_EQ(values["comparable"], "yes") << row;
    EXPECT_NEAR(values["tetrahedra"].get<double>(), ours, 0.03 * ours) << row;
    EXPECT_GE(row["runs"].size(), 3u);
  }
  EXPECT_EQ(rows_of(quality, "verdicts").size(), 6 * 4u);
  EXPECT_GT(rows_of(quality, "surfaces")[0]["values"]["smallest_angle"], 20);
  EXPECT_EQ(quality["meshes"].size(), rows.size());
  for (const Json& mesh : quality["meshes"])
    EXPECT_EQ(Json::parse(text_of(work() / "report" / mesh["file"].get<std::string>()))["schema"], "ccdt.mesh/1");
  EXPECT_FALSE(outcome_.out.empty());
}

TEST_F(QualityExperiments, CompareLatticesOnTheSameSurface) {
  const Json lattices = reproduce("lattices", "--scale 4000");
  const Json rows = rows_of(lattices, "quality"), inside = rows_of(lattices, "inside");
  ASSERT_EQ(rows.size(), 6u);
  ASSERT_EQ(inside.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {  // improvement never makes the worst worse
    EXPECT_LE(rows[i + 3]["values"]["worst_r"], rows[i]["values"]["worst_r"]) << rows[i];
    EXPECT_GT(inside[i]["values"]["tetrahedra"], 100) << inside[i];
  }
  // Inside, the meshes have the tetrahedra of the unit cells.
  EXPECT_NEAR(inside[0]["values"]["worst_r"].get<double>(), 1.26014, 1e-4);
  EXPECT_NEAR(inside[1]["values"]["worst_r"].get<double>(), 1.07583, 1e-4);
  EXPECT_EQ(rows_of(lattices, "unit_cells").size(), 14u);
}

TEST_F(QualityExperiments, TakeTheImprovementApart) {
  const Json rows = rows_of(reproduce("improvement", "--scale 2000"), "quality");
  ASSERT_EQ(rows.size(), 5u);
  const auto worst = [&](std::size_t i) { return rows[i]["values"]["worst_r"].get<double>(); };
  EXPECT_LT(worst(1), worst(0));
  EXPECT_LT(worst(2), worst(0));
  EXPECT_LE(worst(3), std::min(worst(1), worst(2)));
  EXPECT_LE(worst(4), worst(3));
  EXPECT_EQ(rows[0]["values"]["improve_seconds"], 0);
  EXPECT_GT(rows[4]["values"]["improve_seconds"], 0);
}

TEST_F(QualityExperiments, FitTheLatticeToTheSurface) {
  const Json settings = rows_of(reproduce("lattice-fit", "--scale 1000"), "settings");
  ASSERT_GE(settings.size(), 20u);
  double ranks = 0;
  for (const Json& setting : settings) ranks += setting["values"]["rank"].get<double>();
  const double n = static_cast<double>(settings.size());
  EXPECT_NEAR(ranks, n * (n + 1) / 2, 1e-6);
}

TEST_F(QualityExperiments, ReportAFileThatIsNoSolidAndGoOn) {
  write("open.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  ASSERT_EQ(run("model sphere --edge-length 0.5 -o sphere.off").exit_code, 0);
  const Outcome outcome = run("reproduce lattices -o report --scale 1000 --models none --input open.off sphere.off");
  EXPECT_EQ(outcome.exit_code, 1) << outcome.out << outcome.err;
  const Json lattices = Json::parse(text_of(work() / "report/lattices.json"));
  EXPECT_FALSE(lattices["good"]);
  EXPECT_NE(lattices["problems"][0].get<std::string>().find("open.off"), std::string::npos) << lattices["problems"];
  EXPECT_EQ(rows_of(lattices, "quality").size(), 6u);
}

}  // namespace
}  // namespace ccdt
