#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "reports/claims.h"

namespace ccdt {
namespace {

using reports::ClaimVerdict;
using results::Cell;
using results::ColumnKind;

ClaimVerdict verdict_by(const results::ExperimentResult& result, const std::string& id) {
  const auto claims = reports::judge_claims(std::span(&result, 1));
  const auto found = std::ranges::find(claims, id, &reports::PaperClaim::id);
  if (found == claims.end()) throw std::out_of_range(id);
  return found->verdict;
}

/// Million instructions of the parts of a CDT.
struct Parts {
  double visibility, rest_of_front, delaunay;
};

results::ExperimentResult visibility_cost(const std::vector<Parts>& models, bool has_valgrind = true) {
  results::ExperimentResult result{.name = "visibility-cost"};
  results::ResultTable table{"instructions",
                             "Instructions",
                             {{"model", "model", ColumnKind::label},
                              {"visibility", "visibility"},
                              {"rest_of_front", "rest of the front"},
                              {"delaunay", "Delaunay"},
                              {"others", "others"},
                              {"share", "share"}}};
  for (const auto& [visibility, rest, delaunay] : models) {
    const double whole = visibility + rest + delaunay;
    const Cell share = bench::Estimate{visibility / whole, visibility / whole, (visibility + rest) / whole};
    if (has_valgrind) table.rows.push_back({{std::string("piston"), visibility, rest, delaunay, 0.0, share}, {}});
    if (!has_valgrind) table.rows.push_back({{std::string("piston"), Cell(), Cell(), Cell(), Cell(), Cell()}, {}});
  }
  result.tables = {table};
  return result;
}

TEST(VisibilityClaim, IsJudgedByTheTestsAloneAndByTheWholeFront) {
  const std::string id = "visibility-is-most-expensive";
  EXPECT_EQ(verdict_by(visibility_cost({{80, 10, 10}, {51, 0, 49}}), id), ClaimVerdict::confirmed);
  EXPECT_EQ(verdict_by(visibility_cost({{80, 10, 10}, {40, 25, 35}}), id), ClaimVerdict::reservation);
  EXPECT_EQ(verdict_by(visibility_cost({{40, 5, 55}}), id), ClaimVerdict::refuted);
  EXPECT_EQ(verdict_by(visibility_cost({{30, 30, 40}}), id), ClaimVerdict::not_testable);
  EXPECT_EQ(verdict_by(visibility_cost({{80, 10, 10}}, false), id), ClaimVerdict::not_testable);
}

/// The growth of both judged counts at both densities.
results::ExperimentResult density(const bench::Estimate& uniform, const bench::Estimate& graded,
                                  const std::string& judged = "yes") {
  results::ExperimentResult result{.name = "density"};
  results::ResultTable table{"growth",
                             "Growth",
                             {{"density", "density", ColumnKind::label},
                              {"locator", "locator", ColumnKind::label},
                              {"quantity", "of", ColumnKind::label},
                              {"exponent", "exponent"},
                              {"judged", "judged", ColumnKind::label}}};
  for (const std::string quantity : {"candidates", "visibility tests"}) {
    table.rows.push_back({{std::string("uniform"), std::string("grid"), quantity, uniform, judged}, {}});
    table.rows.push_back({{std::string("graded"), std::string("grid"), quantity, graded, judged}, {}});
    table.rows.push_back(
        {{std::string("graded"), std::string("octree"), quantity, bench::Estimate{1, 1, 1}, judged}, {}});
  }
  result.tables = {table};
  return result;
}

TEST(DensityClaim, WantsLinearWorkAtUniformDensityOnly) {
  const std::string id = "linear-only-if-uniform";
  const bench::Estimate linear{1, 0.95, 1.05}, nearly{1.15, 1.12, 1.18}, steep{1.9, 1.7, 2.1}, wide{1.5, 0.9, 2.1};
  EXPECT_EQ(verdict_by(density(linear, steep), id), ClaimVerdict::confirmed);
  EXPECT_EQ(verdict_by(density(nearly, steep), id), ClaimVerdict::reservation);
  EXPECT_EQ(verdict_by(density(nearly, linear), id), ClaimVerdict::refuted);
  EXPECT_EQ(verdict_by(density(linear, wide), id), ClaimVerdict::not_testable);
  EXPECT_EQ(verdict_by(density(linear, steep, "no"), id), ClaimVerdict::not_testable);
}

/// Slivers per 1,000 tetrahedra of a model, with the rule of smallest spheres alone and without any rule.
struct SliverShares {
  double with, without;
};

results::ExperimentResult min_sphere(const std::vector<SliverShares>& models) {
  results::ExperimentResult result{.name = "min-sphere"};
  results::ResultTable table{"slivers",
                             "Slivers",
                             {{"model", "model", ColumnKind::label},
                              {"sphere_rule", "sphere rule", ColumnKind::label},
                              {"clearance_rule", "clearance rule", ColumnKind::label},
                              {"status", "status", ColumnKind::label},
                              {"slivers_per_1000", "slivers"}}};
  const auto add = [&](const std::string& model, const std::string& sphere, const std::string& clearance,
                       double slivers) {
    table.rows.push_back({{model, sphere, clearance, std::string("ok"), slivers}, {}});
  };
  for (std::size_t i = 0; i < models.size(); ++i) {
    const std::string model = "model " + std::to_string(i);
    add(model, "off", "off", models[i].without);
    add(model, "on", "off", models[i].with);
    add(model, "off", "on", 1000);  // with our rule: not what the claim is about
    add(model, "on", "on", 1000);
  }
  result.tables = {table};
  return result;
}

TEST(SphereRuleClaim, WantsFewerSliversOnEveryModel) {
  const std::string id = "min-sphere-avoids-slivers";
  EXPECT_EQ(verdict_by(min_sphere({{1, 5}, {0, 3}, {2, 4}}), id), ClaimVerdict::confirmed);
  EXPECT_EQ(verdict_by(min_sphere({{1, 5}, {3, 3}, {2, 4}}), id), ClaimVerdict::reservation);
  EXPECT_EQ(verdict_by(min_sphere({{1, 5}, {0, 0}, {2, 4}}), id), ClaimVerdict::reservation);
  EXPECT_EQ(verdict_by(min_sphere({{1, 5}, {4, 3}}), id), ClaimVerdict::refuted);
  EXPECT_EQ(verdict_by(min_sphere({}), id), ClaimVerdict::not_testable);
}

}  // namespace
}  // namespace ccdt
