#include <algorithm>
#include <array>
#include <utility>

#include "reports/claims/claim_groups.h"

namespace ccdt::reports {
namespace {

/// A measure of quality, and how it is compared.
struct QualityMeasure {
  const char* column;
  const char* words;
  bool larger_is_better;
};
constexpr std::array<QualityMeasure, 4> measures = {{{"mean_r", "mean r", false},
                                                     {"p99_r", "99% of r below", false},
                                                     {"worst_r", "worst r", false},
                                                     {"smallest_dihedral", "smallest dihedral angle", true}}};

/// Compares the paper's mesh with a rival's mesh of equal size by every measure; the weaker form uses only the mean.
void add_rival(Results results, const std::string& figure, const std::string& variant, PaperClaim& claim) {
  const auto rows = [&](const std::string& name) {  // successful runs with a comparable number of tetrahedra
    return rows_of(results, figure, "quality", {{"variant", name}, {"status", "ok"}, {"comparable", "yes"}});
  };
  const auto all_ours = rows("paper fcc"), all_theirs = rows(variant);
  if (all_ours.empty() || all_theirs.empty()) {
    claim.measured.push_back(missing_measure(figure + ": a mesh of " + variant + " with as many tetrahedra",
                                             "equal numbers of tetrahedra", figure, "quality"));
    return;
  }
  const ClaimRow &ours = all_ours.front(), &theirs = all_theirs.front();
  for (const QualityMeasure& m : measures) {
    const double our_value = ours.number(m.column), their_value = theirs.number(m.column);
    const BoundTest outcome = yes_or_no(m.larger_is_better ? our_value > their_value : our_value < their_value);
    claim.measured.push_back(
        measure_of(ours, ours.text("model") + ": " + m.words, our_value,
                   (m.larger_is_better ? "more than " : "less than ") + rounded(their_value, 4) + " (" + variant + ")",
                   outcome, &m == &measures.front() ? outcome : BoundTest::holds));
    claim.measured.back().runs = {ours.row->runs.front(), theirs.row->runs.front()};
  }
}

/// The rivals in a figure that was measured. The first differs from the paper's mesh only in the places of its interior
/// vertices. TetGen is an independent program.
void add_figure(Results results, const std::string& figure, PaperClaim& claim) {
  if (!was_measured(results, figure)) return;
  add_rival(results, figure, "refinement", claim);
  if (!rows_of(results, figure, "quality", {{"variant", "tetgen"}}).empty())
    add_rival(results, figure, "tetgen", claim);
}

/// One measure for each criterion of the unit cells. The weaker form asks only for the mean or the worst r.
void add_lattices(Results results, PaperClaim& claim) {
  const auto rows = rows_of(results, "lattices", "unit_cell_criteria");
  const auto is_weak = [](const ClaimRow& row) {
    return row.text("criterion") == "mean r" || row.text("criterion") == "worst r";
  };
  const auto is_best = [](const ClaimRow& row) { return row.text("confirmed") == "yes"; };
  const bool weaker_holds =
      std::ranges::any_of(rows, [&](const ClaimRow& row) { return is_weak(row) && is_best(row); });
  for (const ClaimRow& row : rows)
    claim.measured.push_back(
        measure_of(row, "FCC's unit cell by " + row.text("criterion"), row.number("fcc"),
                   "better than " + rounded(row.number("best_other"), 4) + " (" + row.text("best_other_lattices") + ")",
                   yes_or_no(is_best(row)), yes_or_no(weaker_holds || !is_weak(row))));
}

/// Slivers with the rule of smallest spheres alone and without any rule, on one model.
struct SphereRule {
  ClaimRow with;
  double slivers = 0, slivers_without = 0;  ///< per 1,000 tetrahedra at the surface

  BoundTest avoids() const {
    if (slivers == 0 && slivers_without == 0) return BoundTest::undecided;
    return yes_or_no(slivers < slivers_without);
  }
};

/// One measure for each model. The weaker form asks for most of them.
void add_sphere_rule(Results results, PaperClaim& claim) {
  std::vector<SphereRule> models;
  for (const ClaimRow& with : rows_of(results, "min-sphere", "slivers",
                                      {{"sphere_rule", "on"}, {"clearance_rule", "off"}, {"status", "ok"}})) {
    const auto without =
        rows_of(results, "min-sphere", "slivers",
                {{"model", with.text("model")}, {"sphere_rule", "off"}, {"clearance_rule", "off"}, {"status", "ok"}});
    if (!without.empty())
      models.push_back({with, with.number("slivers_per_1000"), without.front().number("slivers_per_1000")});
  }
  const auto holding =
      std::ranges::count_if(models, [](const SphereRule& rule) { return rule.avoids() == BoundTest::holds; });
  const BoundTest on_most = yes_or_no(2 * holding > std::ssize(models));
  for (const SphereRule& rule : models)
    claim.measured.push_back(
        measure_of(rule.with, rule.with.text("model") + ": slivers per 1,000 tetrahedra at the surface", rule.slivers,
                   "less than " + rounded(rule.slivers_without) + ", without it", rule.avoids(), on_most));
}

}  // namespace

std::vector<PaperClaim> quality_claims(Results results) {
  std::vector<PaperClaim> claims;
  PaperClaim better{"better-than-refinement",
                    "6, Figs. 9 to 11",
                    "The tetrahedra are better than those of Delaunay refinement (Shewchuk's; here our own on the same "
                    "surface, and TetGen), by the paper's measure r.",
                    {"fig9", "fig10", "fig11"}};
  better.weaker = "The mean of r is better.";
  for (const std::string& figure : better.experiments) add_figure(results, figure, better);
  claims.push_back(better);

  PaperClaim fcc{
      "fcc-is-best",
      "3",
      "In a unit cell, the tetrahedra of the face-centered cubic lattice are better than those of the 13 other Bravais "
      "lattices.",
      {"lattices"}};
  fcc.weaker = "FCC alone is the best by the mean or by the worst r.";
  add_lattices(results, fcc);
  claims.push_back(fcc);

  PaperClaim spheres{
      "min-sphere-avoids-slivers",
      "3",
      "Slivers are avoided if no interior point is in the smallest sphere of a face of the surface (after "
      "Cavendish, Field and Frey).",
      {"min-sphere"}};
  spheres.weaker = "There are fewer slivers at the surface of most models.";
  add_sphere_rule(results, spheres);
  claims.push_back(spheres);
  return claims;
}

}  // namespace ccdt::reports
