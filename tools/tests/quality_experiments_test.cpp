#include <filesystem>
#include <nlohmann/json.hpp>

#include "tools/tests/program.h"

namespace ccdt {
namespace {

using Json = nlohmann::json;

/// `ccdt reproduce` of an experiment on a sphere alone, at a small size.
class QualityExperiments : public Program {
 protected:
  Json reproduce(const std::string& experiment, const std::string& options) {
    EXPECT_EQ(run("model sphere --edge-length 0.5 -o sphere.off").exit_code, 0);
    outcome_ = run("reproduce " + experiment + " -o report --models none --input sphere.off " + options);
    EXPECT_EQ(outcome_.exit_code, 0) << outcome_.out << outcome_.err;
    EXPECT_FALSE(text_of(work() / "report" / (experiment + ".md")).empty());
    EXPECT_TRUE(std::filesystem::is_empty(work() / "report/meshes"));
    return Json::parse(text_of(work() / "report" / (experiment + ".json")));
  }

  Outcome outcome_;
};

TEST_F(QualityExperiments, CompareMeshersAtEqualNumbersOfTetrahedra) {
  const std::string help = run("mesh --help").out;
  std::string others;
  for (const std::string name : {"tetgen", "cgal-mesh3", "gmsh-hxt"})
    if (help.find("  " + name + " ") != std::string::npos) others += (others.empty() ? "" : ",") + name;
  const Json quality = reproduce("quality", "--scale 50" + (others.empty() ? "" : " --beside " + others));
  EXPECT_EQ(quality["schema"], "ccdt.quality/1");
  ASSERT_EQ(quality["cases"].size(), 2u);
  for (const Json& c : quality["cases"]) {
    const double wanted = c["wanted_tetrahedra"];
    const double ours = c["rows"][0]["counts"]["tetrahedra"];
    EXPECT_NEAR(ours, wanted, 0.3 * wanted) << c["rows"][0];
    for (const Json& row : c["rows"]) {
      EXPECT_EQ(row["status"], "ok") << row;
      EXPECT_EQ(row["comparable"], true) << row["variant"] << row["counts"];
      EXPECT_NEAR(row["counts"]["tetrahedra"].get<double>(), ours, 0.15 * ours) << row["variant"];
      EXPECT_EQ(row["samples"].size(), 5u);
    }
    EXPECT_EQ(c["verdicts"].size(), 8u);
    EXPECT_GT(c["surface"]["smallest_angle"]["degrees"], 20);
  }
  EXPECT_NE(outcome_.out.find("better than all others?"), std::string::npos) << outcome_.out;
}

TEST_F(QualityExperiments, CompareLatticesOnTheSameSurface) {
  const Json lattices = reproduce("lattices", "--scale 25");
  ASSERT_EQ(lattices["cases"].size(), 1u);
  const Json& rows = lattices["cases"][0]["rows"];
  ASSERT_EQ(rows.size(), 6u);
  for (std::size_t i = 0; i < 3; ++i)  // improvement never makes the worst worse
    EXPECT_LE(rows[i + 3]["quality"]["r"]["max"], rows[i]["quality"]["r"]["max"]) << rows[i]["variant"];
  EXPECT_NE(outcome_.out.find("That FCC is best is"), std::string::npos) << outcome_.out;
}

TEST_F(QualityExperiments, AblateTheImprovement) {
  const Json ablation = reproduce("ablation", "--scale 25");
  const Json& rows = ablation["cases"][0]["rows"];
  ASSERT_EQ(rows.size(), 4u);
  const auto worst = [&](std::size_t i) { return rows[i]["quality"]["r"]["max"].get<double>(); };
  EXPECT_LT(worst(1), worst(0));
  EXPECT_LT(worst(2), worst(0));
  EXPECT_LE(worst(3), std::min(worst(1), worst(2)));
  EXPECT_EQ(rows[0]["improve_seconds"], 0);
  EXPECT_GT(rows[3]["improve_seconds"], 0);
}

TEST_F(QualityExperiments, FitTheLatticeToTheSurface) {
  const Json fit = reproduce("lattice-fit", "--scale 50");
  const Json& summary = fit["summary"];
  ASSERT_GE(summary.size(), 20u);
  double ranks = 0;
  for (const Json& setting : summary) ranks += setting["rank"].get<double>();
  const double n = static_cast<double>(summary.size());
  EXPECT_NEAR(ranks, n * (n + 1) / 2, 1e-6);
  EXPECT_NE(outcome_.out.find("The best setting is"), std::string::npos) << outcome_.out;
}

TEST_F(QualityExperiments, ReportAFileThatIsNoSolidAndGoOn) {
  write("open.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  ASSERT_EQ(run("model sphere --edge-length 0.5 -o sphere.off").exit_code, 0);
  const Outcome outcome = run("reproduce lattices -o report --scale 50 --models none --input open.off sphere.off");
  EXPECT_EQ(outcome.exit_code, 1) << outcome.out << outcome.err;
  const Json lattices = Json::parse(text_of(work() / "report/lattices.json"));
  ASSERT_EQ(lattices["cases"].size(), 2u);
  EXPECT_NE(lattices["cases"][0]["reason"].get<std::string>().find("open"), std::string::npos) << lattices["cases"][0];
  EXPECT_EQ(lattices["cases"][1]["rows"].size(), 6u);
}

}  // namespace
}  // namespace ccdt
