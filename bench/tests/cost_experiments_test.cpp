#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "bench/experiments/density.h"
#include "bench/experiments/min_sphere.h"
#include "bench/experiments/visibility_cost.h"
#include "bench/tests/grid_mesh.h"
#include "engine/base/errors.h"

namespace ccdt {
namespace {

const results::ResultTable& table_in(const results::ExperimentResult& result, std::string_view name) {
  const results::ResultTable* found = results::find_table(result, name);
  if (found == nullptr) throw std::out_of_range("no table " + std::string(name));
  return *found;
}

std::vector<std::string> texts_in(const results::ResultTable& table, std::string_view column) {
  std::vector<std::string> all;
  for (const results::ResultRow& row : table.rows) all.push_back(results::text_in(table, row, column));
  return all;
}

std::vector<double> numbers_in(const results::ResultTable& table, std::string_view column) {
  std::vector<double> all;
  for (const results::ResultRow& row : table.rows) all.push_back(results::number_in(table, row, column));
  return all;
}

/// A run whose front made these tetrahedra with these counts.
bench::MeasuredCase front_run(double tetrahedra, double candidates, double visibility_tests) {
  bench::MeasuredCase measured;
  measured.id = "0123456789abcdef";
  bench::RunRecord record;
  record.mesher.name = "ccdt";
  record.counts.front_tetrahedra = record.counts.tetrahedra = static_cast<std::uint64_t>(tetrahedra);
  record.costs[Stage::front].work.front_candidates = static_cast<std::uint64_t>(candidates);
  record.costs[Stage::front].work.visibility_tests = static_cast<std::uint64_t>(visibility_tests);
  record.costs[Stage::front].work.grid_cells = record.counts.tetrahedra;
  add_run(measured, record);
  return measured;
}

/// A profile of callgrind: Delaunay takes 20, the front 70 with 50 for visibility, labels 10.
constexpr const char* cdt_profile = R"(positions: line
events: Ir
fn=(1) main
0 1
cfn=(2) ccdt::mesh_plc(int)
calls=1 0
0 101
fn=(2)
0 1
cfn=(3) ccdt::delaunay::wrap_delaunay(int)
calls=1 0
0 20
cfn=(4) ccdt::front::advance_front(int)
calls=1 0
0 70
cfn=(5) ccdt::label::label_cells(int)
calls=1 0
0 10
fn=(4)
0 20
cfn=(6) ccdt::front::cross_each_other(int)
calls=3 0
0 40
cfn=(7) ccdt::front::hides(int)
calls=1 0
0 10
)";

TEST(VisibilityCost, CountsTheTestsWithWhatTheyCall) {
  const experiments::CdtInstructions counted = experiments::cdt_instructions(cdt_profile);
  EXPECT_EQ(counted.visibility_tests, 50u);
  EXPECT_EQ(counted.front, 70u);
  EXPECT_EQ(counted.delaunay, 20u);
  EXPECT_EQ(counted.others, 10u);
  EXPECT_EQ(counted.visibility_share(), (bench::Estimate{0.5, 0.5, 0.7}));
}

TEST(VisibilityCost, NeedsTheTestsInTheProfile) {
  std::string inlined = cdt_profile;
  for (const std::string test : {"cross_each_other", "hides"})
    inlined.replace(inlined.find(test), test.size(), "other");
  EXPECT_THROW(experiments::cdt_instructions(inlined), InputError);
}

TEST(VisibilityCost, SaysWhereItCouldNotBeCounted) {
  std::vector<experiments::VisibilityCostRow> rows(2);
  for (auto& row : rows) row.measured = front_run(100, 1000, 2000);
  rows[0].model = "piston", rows[0].instructions = experiments::cdt_instructions(cdt_profile);
  rows[1].model = "bracket", rows[1].why_missing = "there is no valgrind";
  const auto result = experiments::visibility_cost_result(rows);
  const results::ResultTable& table = table_in(result, "instructions");
  EXPECT_EQ(texts_in(table, "status"), (std::vector<std::string>{"ok", "missing"}));
  EXPECT_EQ(numbers_in(table, "rest_of_front")[0], 20);
  EXPECT_TRUE(std::isnan(numbers_in(table, "visibility")[1]));
  EXPECT_EQ(result.findings.size(), 1u);
  EXPECT_EQ(result.problems.size(), 1u);
  EXPECT_TRUE(result.is_good) << "a machine without valgrind is no failure of ours";
}

TEST(MinSphere, CountsTetrahedraAtTheSurfaceOnly) {
  MeshedInput made = make_grid_mesh(
      {6, 6, 6}, [](int, int, int) { return 1; }, false, unmoved);
  made.mesh.faces = made.input.triangles;
  const experiments::SurfaceSlivers even = experiments::slivers_at_surface(made.mesh);
  EXPECT_GT(even.tetrahedra, 0u);
  EXPECT_LT(even.tetrahedra, made.mesh.tetrahedra.size());
  EXPECT_EQ(even.below_10_degrees, 0u);
  EXPECT_NEAR(even.smallest_dihedral, 45, 1e-9);

  constexpr double flattened = 0.03;  // flattens the whole mesh: all angles but right ones are small or large
  for (Point3& p : made.mesh.vertices) p.z *= flattened;
  const experiments::SurfaceSlivers flat = experiments::slivers_at_surface(made.mesh);
  EXPECT_EQ(flat.tetrahedra, even.tetrahedra);
  EXPECT_GT(flat.below_5_degrees, 0u);
  EXPECT_GT(flat.with_interior_vertex, 0u);
  EXPECT_LT(flat.with_interior_vertex, flat.below_5_degrees) << "those of the corners have only surface vertices";
  EXPECT_GT(flat.with_large_r, 0u);
  EXPECT_LT(flat.smallest_dihedral, 5);
  EXPECT_GT(flat.worst_r, 5);
}

TEST(MinSphere, ComparesTheRuleAloneWithNone) {
  std::vector<experiments::MinSphereRow> rows;
  for (const bool clearance : {false, true})
    for (const bool sphere : {false, true}) {
      rows.push_back({{front_run(1000, 0, 0)}, "piston", sphere, clearance, experiments::SurfaceSlivers{}});
      rows.back().slivers->tetrahedra = 2000;
      rows.back().slivers->below_5_degrees = clearance ? 0 : sphere ? 14 : 86;
    }
  const auto result = experiments::min_sphere_result(rows);
  const results::ResultTable& table = table_in(result, "slivers");
  EXPECT_EQ(numbers_in(table, "slivers_per_1000"), (std::vector<double>{43, 7, 0, 0}));
  EXPECT_EQ(texts_in(table, "sphere_rule"), (std::vector<std::string>{"off", "on", "off", "on"}));
  ASSERT_EQ(result.findings.size(), 1u);
  EXPECT_NE(result.findings[0].find("43"), std::string::npos);
  rows[1].slivers.reset();
  EXPECT_TRUE(experiments::min_sphere_result(rows).findings.empty());
}

/// Sizes whose candidates grow with a power, and whose visibility tests grow linearly.
std::vector<experiments::DensityRow> growing(const std::string& density, double decades, int sizes, double power) {
  std::vector<experiments::DensityRow> rows;
  for (int i = 0; i < sizes; ++i) {
    const double tetrahedra = std::round(1000 * std::pow(10, decades * i / (sizes - 1)));
    rows.push_back({{front_run(tetrahedra, std::pow(tetrahedra, power), 10 * tetrahedra)}, density, "grid", 0.5});
  }
  return rows;
}

TEST(Density, JudgesLinearGrowthByThreeDecadesAndSteepGrowthByOne) {
  std::vector<experiments::DensityRow> rows = growing("uniform", 3.1, 10, 1);
  experiments::append(rows, growing("graded", 1.1, 5, 1.9));
  const results::ResultTable growth = table_in(experiments::density_result(rows), "growth");
  EXPECT_EQ(texts_in(growth, "judged"), (std::vector<std::string>{"yes", "yes", "no", "yes", "yes", "no"}));
  EXPECT_NEAR(numbers_in(growth, "exponent")[0], 1, 1e-3);
  EXPECT_NEAR(numbers_in(growth, "exponent")[3], 1.9, 1e-3);

  rows = growing("uniform", 1.1, 10, 1);
  experiments::append(rows, growing("graded", 0.9, 5, 1.9));
  const results::ResultTable short_growth = table_in(experiments::density_result(rows), "growth");
  EXPECT_EQ(texts_in(short_growth, "judged"), std::vector<std::string>(6, "no"));
}

TEST(Density, FitsNoFailedRun) {
  std::vector<experiments::DensityRow> rows = growing("graded", 1.1, 3, 1.9);
  bench::RunRecord failed = rows[0].measured.first;
  failed.set_failure(baselines::FailureKind::timeout, "limit of 600 s");
  add_run(rows[0].measured, failed);
  const auto result = experiments::density_result(rows);
  EXPECT_TRUE(table_in(result, "growth").rows.empty());
  EXPECT_EQ(texts_in(table_in(result, "work"), "status")[0], "timeout");
  EXPECT_FALSE(result.is_good);
}

}  // namespace
}  // namespace ccdt
