#include "bench/results/numbers.h"
#include "reports/claims/claim.h"

namespace ccdt {
namespace {

/// "Little" is up to this; the paper's own ratios are 1.02 to 1.04. The weaker form is its "same order of magnitude".
constexpr double little = 1.10, same_order = 2;

/// The paper saves a factor of 16 to 23; we ask for half of the least of them, or else for anything at all.
constexpr double least_saving = 8, any_saving = 1;

/// Growth with an exponent up to this is linear, up to the second nearly so.
constexpr double linear = 1.10, nearly_linear = 1.30;

/// Of one form of a bound.
using Bound = Claim (*)(const Estimate&, double);

/// A measure for each row of `ratios` that has this name.
void add_ratios(std::span<const ExperimentResult> results, const std::string& ratio, Bound bound, double strong,
                double weak, const std::string& bound_words, PaperClaim& claim) {
  const ResultTable* table = find_table(results, "table1", "ratios");
  if (table == nullptr) return;
  for (const ResultRow& row : table->rows) {
    const auto* value = std::get_if<Estimate>(&cell(*table, row, "value"));
    if (text_in(*table, row, "ratio") != ratio || value == nullptr) continue;
    claim.measured.push_back({text_in(*table, row, "model") + ": " + ratio, *value, bound_words, bound(*value, strong),
                              bound(*value, weak), "table1", "ratios", row.runs});
  }
}

/// A measure for each fit of the exponent of these seconds.
void add_exponents(std::span<const ExperimentResult> results, const std::string& strategy, const std::string& quantity,
                   PaperClaim& claim) {
  const ResultTable* table = find_table(results, "fig8", "fits");
  if (table == nullptr) return;
  for (const ResultRow& row : table->rows) {
    if (text_in(*table, row, "strategy") != strategy || text_in(*table, row, "quantity") != quantity) continue;
    const auto exponent = std::get<Estimate>(cell(*table, row, "exponent"));
    claim.measured.push_back({text_in(*table, row, "model") + ": exponent, " + strategy, exponent,
                              "at most " + rounded(linear), is_at_most(exponent, linear),
                              is_at_most(exponent, nearly_linear), "fig8", "fits", row.runs});
  }
}

PaperClaim linear_claim(std::span<const ExperimentResult> results, std::string id, std::string section,
                        std::string sentence, const std::string& strategy, const std::string& quantity) {
  PaperClaim claim{std::move(id), std::move(section), std::move(sentence), {"fig8"}};
  claim.weaker = "The exponents are at most " + rounded(nearly_linear) + ".";
  add_exponents(results, strategy, quantity, claim);
  return claim;
}

/// The other way round: the paper says that the others are not linear.
PaperClaim others_claim(std::span<const ExperimentResult> results) {
  PaperClaim claim{"refinement-is-not-linear",
                   "6",
                   "Delaunay refinement (Shewchuk's; TetGen stands in) does not have the linear time of the CDT.",
                   {"fig8"}};
  const ResultTable* table = find_table(results, "fig8", "fits");
  if (table == nullptr) return claim;
  for (const ResultRow& row : table->rows) {
    if (text_in(*table, row, "mesher") != "tetgen") continue;
    const auto exponent = std::get<Estimate>(cell(*table, row, "exponent"));
    const Claim outcome = is_at_least(exponent, linear);
    claim.measured.push_back({text_in(*table, row, "model") + ": exponent of TetGen", exponent,
                              "more than " + rounded(linear), outcome, outcome, "fig8", "fits", row.runs});
  }
  return claim;
}

}  // namespace

void add_time_claims(std::span<const ExperimentResult> results, std::vector<PaperClaim>& claims) {
  PaperClaim check{"check-costs-little",
                   "6, Table 1",
                   "With the face protection check, the CDT takes hardly longer than the Delaunay tetrahedralization "
                   "that it starts from.",
                   {"table1"}};
  check.weaker = "They are of the same order: less than " + rounded(same_order, 1) + " times.";
  add_ratios(results, "with check / Delaunay", is_at_most, little, same_order, "at most " + rounded(little), check);
  claims.push_back(check);

  PaperClaim saving{"check-saves-a-factor",
                    "6, Table 1",
                    "Without the check, when every face goes through the front, the CDT takes many times as long.",
                    {"table1"}};
  saving.weaker = "The check saves time.";
  add_ratios(results, "without / with check", is_at_least, least_saving, any_saving,
             "at least " + rounded(least_saving, 1) + "; in the paper 16 to 23", saving);
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

}  // namespace ccdt
