#include "reports/claims.h"

#include <algorithm>
#include <map>
#include <utility>

namespace ccdt::reports {
namespace {

using Results = std::span<const ExperimentResult>;

/// A row of an experiment's table.
struct ClaimRow {
  std::string experiment;
  const ResultTable* table;
  const ResultRow* row;
  std::string text(std::string_view column) const { return results::text_in(*table, *row, column); }
  double number(std::string_view column) const { return results::number_in(*table, *row, column); }
  /// Null if the cell holds no estimate.
  const bench::Estimate* estimate(std::string_view column) const {
    return std::get_if<bench::Estimate>(&results::cell(*table, *row, column));
  }
};

/// The rows with these texts in these columns; none if the experiment or its table is missing.
std::vector<ClaimRow> rows_of(Results results, const std::string& experiment, std::string_view table,
                              const std::map<std::string, std::string>& texts = {}) {
  std::vector<ClaimRow> rows;
  const auto result = std::ranges::find(results, experiment, &ExperimentResult::name);
  const ResultTable* found = result == results.end() ? nullptr : results::find_table(*result, table);
  if (found == nullptr) return rows;
  for (const ResultRow& row : found->rows) {
    const ClaimRow candidate{experiment, found, &row};
    if (std::ranges::all_of(texts, [&](const auto& t) { return candidate.text(t.first) == t.second; }))
      rows.push_back(candidate);
  }
  return rows;
}

/// A measure from a row of a table.
ClaimMeasure measure_of(const ClaimRow& row, std::string what, Cell value, std::string bound, BoundTest strong,
                        BoundTest weak) {
  return {std::move(what), std::move(value), std::move(bound), strong, weak,
          row.experiment,  row.table->name,  row.row->runs};
}

BoundTest yes_or_no(bool holds) {
  return holds ? BoundTest::holds : BoundTest::fails;
}

/// The bound of "little"; the paper's ratios are 1.02 to 1.04. The weaker form is the paper's "same order of
/// magnitude".
constexpr double little = 1.10, same_order = 2;

/// The paper saves a factor of 16 to 23. The strong form asks for half of the smaller one, the weaker form for any
/// saving.
constexpr double least_saving = 8, any_saving = 1;

/// Growth is linear up to the first exponent, and nearly linear up to the second.
constexpr double linear = 1.10, nearly_linear = 1.30;

/// A test of one form of a bound.
using TestOfBound = BoundTest (*)(const bench::Estimate&, double);

/// The bound of a claim on an estimate, in its strong and its weaker form.
struct EstimateBound {
  TestOfBound test;
  double strong, weak;
  std::string words;
};

/// Adds a measure for each row that has an estimate in this column.
void add_estimates(const std::vector<ClaimRow>& rows, std::string_view column, const std::string& what,
                   const EstimateBound& bound, PaperClaim& claim) {
  for (const ClaimRow& row : rows)
    if (const bench::Estimate* value = row.estimate(column))
      claim.measured.push_back(measure_of(row, row.text("model") + ": " + what, *value, bound.words,
                                          bound.test(*value, bound.strong), bound.test(*value, bound.weak)));
}

/// The claim that these seconds grow with an exponent of about 1; one measure for each fit.
PaperClaim linear_claim(Results results, const std::string& id, const std::string& section, const std::string& sentence,
                        const std::string& strategy, const std::string& quantity) {
  PaperClaim claim{id, section, sentence, {"fig8"}};
  claim.weaker = "The exponents are at most " + rounded(nearly_linear) + ".";
  add_estimates(rows_of(results, "fig8", "fits", {{"strategy", strategy}, {"quantity", quantity}}), "exponent",
                "exponent, " + strategy, {experiments::is_at_most, linear, nearly_linear, "at most " + rounded(linear)},
                claim);
  return claim;
}

/// The opposite claim: the paper says that the others are not linear.
PaperClaim others_claim(Results results) {
  PaperClaim claim{"refinement-is-not-linear",
                   "6",
                   "Delaunay refinement (Shewchuk's; TetGen stands in) does not have the linear time of the CDT.",
                   {"fig8"}};
  add_estimates(rows_of(results, "fig8", "fits", {{"mesher", "tetgen"}}), "exponent", "exponent of TetGen",
                {experiments::is_at_least, linear, linear, "more than " + rounded(linear)}, claim);
  return claim;
}

void add_time_claims(Results results, std::vector<PaperClaim>& claims) {
  const auto add_ratios = [&](const std::string& ratio, const EstimateBound& bound, PaperClaim& claim) {
    add_estimates(rows_of(results, "table1", "ratios", {{"ratio", ratio}}), "value", ratio, bound, claim);
  };
  PaperClaim check{"check-costs-little",
                   "6, Table 1",
                   "With the face protection check, the CDT takes hardly longer than the Delaunay tetrahedralization "
                   "from which it starts.",
                   {"table1"}};
  check.weaker = "They are of the same order of magnitude: less than " + rounded(same_order, 1) + " times.";
  add_ratios("with check / Delaunay", {experiments::is_at_most, little, same_order, "at most " + rounded(little)},
             check);
  claims.push_back(check);

  PaperClaim saving{"check-saves-a-factor",
                    "6, Table 1",
                    "Without the check, when every face goes through the front, the CDT takes many times as long.",
                    {"table1"}};
  saving.weaker = "The check saves time.";
  add_ratios("without / with check",
             {experiments::is_at_least, least_saving, any_saving,
              "at least " + rounded(least_saving, 1) + "; in the paper 16 to 23"},
             saving);
  claims.push_back(saving);

  claims.push_back(linear_claim(results, "linear-with-check", "6, Fig. 8",
                                "With the check, the time of the CDT grows linearly with the number of vertices.",
                                "with check", "cdt"));
  claims.push_back(linear_claim(results, "linear-without-check", "6, Fig. 8",
                                "Without the check, too, the time of the CDT grows linearly.",
                                "without check, paper's grid", "cdt"));
  claims.push_back(linear_claim(results, "constant-time-front", "4",
                                "With the uniform grid, the front makes a tetrahedron in constant expected time.",
                                "without check, paper's grid", "front"));
  claims.push_back(linear_claim(results, "linear-grid-delaunay", "5",
                                "Delaunay tetrahedralization face by face in a uniform grid is linear, too.",
                                "with check, wrap", "delaunay"));
  claims.push_back(others_claim(results));
}

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

/// Compares our mesh with TetGen's by every measure; the weaker form uses only the mean.
void add_figure(Results results, const std::string& figure, PaperClaim& claim) {
  const auto rows = [&](const char* variant) {  // successful runs with a comparable number of tetrahedra
    return rows_of(results, figure, "quality", {{"variant", variant}, {"status", "ok"}, {"comparable", "yes"}});
  };
  const auto all_ours = rows("ccdt fcc"), all_theirs = rows("tetgen");
  if (all_ours.empty() || all_theirs.empty()) return;
  const ClaimRow &ours = all_ours.front(), &theirs = all_theirs.front();
  for (const QualityMeasure& m : measures) {
    const double our_value = ours.number(m.column), their_value = theirs.number(m.column);
    const BoundTest outcome = yes_or_no(m.larger_is_better ? our_value > their_value : our_value < their_value);
    claim.measured.push_back(
        measure_of(ours, ours.text("model") + ": " + m.words, our_value,
                   (m.larger_is_better ? "more than " : "less than ") + rounded(their_value, 4) + " (TetGen)", outcome,
                   &m == &measures.front() ? outcome : BoundTest::holds));
    claim.measured.back().runs = {ours.row->runs.front(), theirs.row->runs.front()};
  }
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

void add_quality_claims(Results results, std::vector<PaperClaim>& claims) {
  PaperClaim better{"better-than-refinement",
                    "6, Figs. 9 to 11",
                    "The tetrahedra are better than those of Delaunay refinement (Shewchuk's; TetGen stands in), by "
                    "the paper's measure r.",
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
}

/// Adds a measure that must be 0 for each row with cases; `whole` is the column of their number.
void add_zeros(const std::vector<ClaimRow>& rows, const char* label, const char* part, const char* whole,
               const std::string& words, PaperClaim& claim) {
  for (const ClaimRow& row : rows) {
    if (!(row.number(whole) > 0)) continue;
    const BoundTest outcome = yes_or_no(row.number(part) == 0);
    claim.measured.push_back(measure_of(row, row.text(label) + ": " + words, row.number(part),
                                        "0 of " + with_separators(static_cast<std::uint64_t>(row.number(whole))),
                                        outcome, outcome));
  }
}

void add_theorem(Results results, std::vector<PaperClaim>& claims) {
  PaperClaim sufficient{"theorem-1-if",
                        "5.2, Theorem 1",
                        "A model that is grazeable edge protected and face protected has a tetrahedralization whose "
                        "tetrahedra are all Delaunay.",
                        {"theorem1"}};
  PaperClaim necessary{"theorem-1-only-if",
                       "5.2, Theorem 1",
                       "Only a model that is grazeable edge protected and face protected has such a "
                       "tetrahedralization.",
                       {"theorem1"}};
  PaperClaim existence{"edge-protection-suffices",
                       "2",
                       "A model whose grazeable edges are protected has a constrained Delaunay tetrahedralization "
                       "(Shewchuk's condition).",
                       {"theorem1"}};
  // The theorem does not cover families that are not in general position.
  const auto families = rows_of(results, "theorem1", "families", {{"position", "general"}});
  add_zeros(families, "family", "against_if", "premise", "protected, but without", sufficient);
  add_zeros(families, "family", "against_only_if", "dt", "with one, but not protected", necessary);
  add_zeros(families, "family", "edge_protected_without_cdt", "edge_protected", "protected, but without", existence);
  claims.insert(claims.end(), {existence, sufficient, necessary});
}

/// The number of inputs of a kind, and of those for which the splitting terminated.
struct EndedCount {
  double cases = 0, ended = 0;
  std::vector<std::string> runs = {};
};

void add_ended(const std::string& kind, const EndedCount& count, const char* table, PaperClaim& claim) {
  if (count.cases == 0) return;
  const BoundTest outcome = yes_or_no(count.ended == count.cases);
  claim.measured.push_back({kind + ": inputs where it terminated", count.ended,
                            "all " + with_separators(static_cast<std::uint64_t>(count.cases)), outcome, outcome,
                            "termination", table, count.runs});
}

void add_termination(Results results, std::vector<PaperClaim>& claims) {
  PaperClaim ends{
      "midpoints-end",
      "2",
      "Repeatedly inserting midpoints of missing grazeable edges terminates, and all edges are then represented.",
      {"termination"}};
  EndedCount of_solids;
  for (const ClaimRow& row : rows_of(results, "termination", "solids", {{"protection", "midpoint"}})) {
    const std::string ended = row.text("ended");
    if (ended != "yes" && ended != "no") continue;
    ++of_solids.cases;
    of_solids.ended += ended == "yes";
    of_solids.runs.insert(of_solids.runs.end(), row.row->runs.begin(), row.row->runs.end());
  }
  add_ended("solids and files", of_solids, "solids", ends);
  std::map<std::string, EndedCount> by_star;
  for (const ClaimRow& row : rows_of(results, "termination", "stars")) {
    EndedCount& count = by_star[row.text("star")];
    count.cases += row.number("cases");
    count.ended += row.number("midpoint_ended");
  }
  for (const auto& [star, count] : by_star) add_ended("star of segments, " + star, count, "stars", ends);
  claims.push_back(ends);
}

void add_existence_claims(Results results, std::vector<PaperClaim>& claims) {
  add_theorem(results, claims);
  add_termination(results, claims);
  PaperClaim harmless{
      "interior-points-harmless",
      "3",
      "Interior points do not affect the existence of a CDT: if the model has one, it also has one with them.",
      {"interior-points"}};
  add_zeros(rows_of(results, "interior-points", "existence"), "family", "lost", "cases",
            "with a CDT that one interior point destroys", harmless);
  add_zeros(rows_of(results, "interior-points", "rules", {{"lattice", "all"}}), "rule", "harmed", "cases",
            "with protected edges that points could destroy", harmless);
  claims.push_back(harmless);
}

/// The names of the measures for which a form of the claim has this outcome.
std::string names_of_measures(const PaperClaim& claim, BoundTest ClaimMeasure::*form, BoundTest outcome) {
  std::vector<std::string> names;
  for (const ClaimMeasure& m : claim.measured)
    if (m.*form == outcome) names.push_back(m.what);
  constexpr std::size_t most = 4;
  const std::size_t more = names.size() - std::min(names.size(), most);
  names.resize(names.size() - more);
  return joined(names) + (more > 0 ? " and " + std::to_string(more) + " more" : "");
}

/// Does a form of the claim have this outcome for any measure?
bool any(const PaperClaim& claim, BoundTest ClaimMeasure::*form, BoundTest outcome) {
  return std::ranges::find(claim.measured, outcome, form) != claim.measured.end();
}

}  // namespace

std::string_view words_of(ClaimVerdict verdict) {
  for (const NamedValue<ClaimVerdict>& one : names_of(verdict))
    if (one.value == verdict) return one.what;
  return {};
}

void judge(PaperClaim& claim) {
  if (claim.measured.empty()) {
    claim.verdict = ClaimVerdict::not_testable;
    claim.reason = "Nothing was measured: this claim needs " + joined(claim.experiments) + ".";
  } else if (!any(claim, &ClaimMeasure::strong, BoundTest::fails) &&
             !any(claim, &ClaimMeasure::strong, BoundTest::undecided)) {
    claim.verdict = ClaimVerdict::confirmed;
    claim.reason = "All measurements agree with the paper.";
  } else if (any(claim, &ClaimMeasure::weak, BoundTest::fails)) {
    claim.verdict = ClaimVerdict::refuted;
    claim.reason = "Contradicted by: " + names_of_measures(claim, &ClaimMeasure::weak, BoundTest::fails) + ".";
  } else if (any(claim, &ClaimMeasure::weak, BoundTest::undecided)) {
    claim.verdict = ClaimVerdict::not_testable;
    if (any(claim, &ClaimMeasure::strong, BoundTest::fails))
      claim.reason =
          "Different from the paper: " + names_of_measures(claim, &ClaimMeasure::strong, BoundTest::fails) + ". ";
    claim.reason += (claim.weaker.empty() ? "The" : "For the weaker form (" + claim.weaker + ") the") +
                    std::string(" intervals are too wide: ") +
                    names_of_measures(claim, &ClaimMeasure::weak, BoundTest::undecided) +
                    ". More runs or larger models narrow them.";
  } else {
    claim.verdict = ClaimVerdict::reservation;
    const BoundTest found =
        any(claim, &ClaimMeasure::strong, BoundTest::fails) ? BoundTest::fails : BoundTest::undecided;
    claim.reason = claim.weaker + (found == BoundTest::fails ? " Different from the paper: " : " Not decided: ") +
                   names_of_measures(claim, &ClaimMeasure::strong, found) + ".";
  }
}

std::vector<PaperClaim> judge_claims(std::span<const ExperimentResult> results) {
  std::vector<PaperClaim> claims;
  add_time_claims(results, claims);
  add_quality_claims(results, claims);
  add_existence_claims(results, claims);
  std::ranges::for_each(claims, [](PaperClaim& claim) { judge(claim); });
  return claims;
}

}  // namespace ccdt::reports
