#include <algorithm>
#include <optional>
#include <utility>

#include "bench/experiments/growth.h"
#include "reports/claims/claim_groups.h"

namespace ccdt::reports {
namespace {

/// The bound of "little"; the paper's ratios are 1.02 to 1.04. The weaker form is the paper's "same order of
/// magnitude".
constexpr double little = 1.10, same_order = 2;

/// The paper saves a factor of 16 to 23. The strong form asks for half of the smaller one, the weaker form for any
/// saving.
constexpr double least_saving = 8, any_saving = 1;

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

/// The measurements that show the growth in a claim.
struct Grown {
  std::string strategy;
  std::vector<std::string> work;  ///< quantities of exact counts; none: time alone
  std::string time;               ///< quantity of seconds
};

const std::string linear_words = "within " + rounded(experiments::linear_within, 1) + " of 1";

using TestOfExponent = BoundTest (*)(const bench::Estimate&);

/// Why no fit of this quantity is judged: "piston: 2.1 decades; 3 are needed". Empty if there is no fit.
std::string why_not_judged(Results results, const char* table, const std::string& strategy,
                           const std::string& quantity) {
  std::vector<std::string> reasons;
  for (const ClaimRow& row : rows_of(results, "fig8", table, {{"strategy", strategy}, {"quantity", quantity}}))
    reasons.push_back(row.text("model") + ": " + row.text("why_not"));
  return reasons.empty() ? "" : " (" + joined(reasons) + ")";
}

/// Adds the exponents of the fits that may be judged. If there are none, adds a missing measure.
void add_exponents(Results results, const char* table, const std::string& strategy, const std::string& quantity,
                   const std::string& bound, TestOfExponent strong, TestOfExponent weak, PaperClaim& claim) {
  const std::string what = "exponent of " + quantity + ", " + strategy;
  bool is_judged = false;
  for (const ClaimRow& row :
       rows_of(results, "fig8", table, {{"strategy", strategy}, {"quantity", quantity}, {"judged", "yes"}})) {
    const bench::Estimate* exponent = row.estimate("exponent");
    if (exponent == nullptr) continue;
    is_judged = true;
    claim.measured.push_back(measure_of(row, row.text("model") + ": " + what + "; better: " + row.text("better"),
                                        *exponent, bound, strong(*exponent), weak(*exponent)));
  }
  if (!is_judged)
    claim.measured.push_back(
        missing_measure(what + why_not_judged(results, table, strategy, quantity), bound, "fig8", table));
}

BoundTest is_nearly_linear(const bench::Estimate& exponent) {
  return experiments::is_at_most(exponent, experiments::nearly_linear);
}

/// The claim that work and seconds grow linearly.
PaperClaim linear_claim(Results results, const std::string& id, const std::string& section, const std::string& sentence,
                        const Grown& grown) {
  PaperClaim claim{id, section, sentence, {"fig8"}};
  claim.weaker = "The exponents are at most " + rounded(experiments::nearly_linear, 2) + ".";
  if (!was_measured(results, "fig8")) return claim;
  for (const std::string& quantity : grown.work)
    add_exponents(results, "work", grown.strategy, quantity, linear_words, experiments::is_linear, is_nearly_linear,
                  claim);
  add_exponents(results, "fits", grown.strategy, grown.time, linear_words, experiments::is_linear, is_nearly_linear,
                claim);
  return claim;
}

/// The opposite claim: the paper says that the others are not linear.
PaperClaim others_claim(Results results) {
  PaperClaim claim{
      "refinement-is-not-linear",
      "6",
      "Delaunay refinement (Shewchuk's; here our own, and TetGen) does not have the linear time of the CDT.",
      {"fig8"}};
  if (!was_measured(results, "fig8")) return claim;
  const TestOfExponent is_steeper = [](const bench::Estimate& exponent) {
    return experiments::is_at_least(exponent, 1 + experiments::linear_within);
  };
  const std::string bound = "more than " + rounded(1 + experiments::linear_within, 2);
  add_exponents(results, "fits", "Delaunay refinement, ours", "mesh", bound, is_steeper, is_steeper, claim);
  const std::string tetgen = "TetGen, its own vertices";
  if (!rows_of(results, "fig8", "fits", {{"strategy", tetgen}}).empty())
    add_exponents(results, "fits", tetgen, "mesh", bound, is_steeper, is_steeper, claim);
  return claim;
}

/// Is visibility the largest part? Its cost is at least that of its tests and at most that of the whole front.
BoundTest is_largest_part(const ClaimRow& row) {
  const double tests = row.number("visibility"), rest_of_front = row.number("rest_of_front"),
               outside = std::max(row.number("delaunay"), row.number("others"));
  if (tests > std::max(rest_of_front, outside)) return BoundTest::holds;
  return tests + rest_of_front < outside ? BoundTest::fails : BoundTest::undecided;
}

PaperClaim visibility_claim(Results results) {
  constexpr double more_than_half = 0.5;
  PaperClaim claim{"visibility-is-most-expensive",
                   "5",
                   "The determination of visibility is the most time consuming procedure of the CDT.",
                   {"visibility-cost"}};
  claim.weaker = "It is the largest single part of the CDT's cost.";
  if (!was_measured(results, "visibility-cost")) return claim;
  for (const ClaimRow& row : rows_of(results, "visibility-cost", "instructions")) {
    const std::string what = row.text("model") + ": share of visibility in the CDT without the check",
                      bound = "more than half";
    const bench::Estimate* share = row.estimate("share");
    claim.measured.push_back(share == nullptr
                                 ? missing_measure(what, bound, "visibility-cost", "instructions")
                                 : measure_of(row, what, *share, bound,
                                              experiments::is_at_least(*share, more_than_half), is_largest_part(row)));
  }
  return claim;
}

/// The exponent of a count at one density that may be judged; null if there is none.
const bench::Estimate* exponent_at(Results results, const std::string& density, const std::string& quantity,
                                   std::optional<ClaimRow>& found) {
  const auto rows = rows_of(results, "density", "growth",
                            {{"density", density}, {"locator", "grid"}, {"quantity", quantity}, {"judged", "yes"}});
  if (rows.empty()) return nullptr;
  found = rows.front();
  return found->estimate("exponent");
}

/// The growth of a count at both densities.
void add_densities(Results results, const std::string& quantity, PaperClaim& claim) {
  const double bound = 1 + experiments::linear_within;
  std::optional<ClaimRow> even_row, graded_row;
  const bench::Estimate *even = exponent_at(results, "uniform", quantity, even_row),
                        *graded = exponent_at(results, "graded", quantity, graded_row);
  const std::string of_even = "exponent of " + quantity + " at uniform density", to_even = "at most " + rounded(bound),
                    of_graded = "exponent of " + quantity + " at graded density",
                    from_graded = "more than " + rounded(bound);
  claim.measured.push_back(even == nullptr ? missing_measure(of_even, to_even, "density", "growth")
                                           : measure_of(*even_row, of_even, *even, to_even,
                                                        experiments::is_at_most(*even, bound), BoundTest::holds));
  if (even == nullptr || graded == nullptr) {
    claim.measured.push_back(missing_measure(of_graded, from_graded, "density", "growth"));
    return;
  }
  const BoundTest is_faster = graded->low > even->high   ? BoundTest::holds
                              : graded->high < even->low ? BoundTest::fails
                                                         : BoundTest::undecided;
  claim.measured.push_back(
      measure_of(*graded_row, of_graded, *graded, from_graded, experiments::is_at_least(*graded, bound), is_faster));
}

PaperClaim density_claim(Results results) {
  PaperClaim claim{"linear-only-if-uniform",
                   "Abstract, 1, 4, 6",
                   "The front takes linear time at uniform density; at other densities, the paper's grid does not "
                   "promise it.",
                   {"density"}};
  claim.weaker = "Its work grows faster at graded density than at uniform density.";
  if (!was_measured(results, "density")) return claim;
  for (const std::string quantity : {"candidates", "visibility tests"}) add_densities(results, quantity, claim);
  return claim;
}

}  // namespace

std::vector<PaperClaim> time_claims(Results results) {
  std::vector<PaperClaim> claims;
  const auto add_ratios = [&](const std::string& ratio, const EstimateBound& bound, PaperClaim& claim) {
    add_estimates(rows_of(results, "table1", "ratios", {{"ratio", ratio}}), "value", ratio, bound, claim);
  };
  PaperClaim check{"check-costs-little",
                   "6, Table 1",
                   "With the face protection check, the CDT takes hardly more time than the Delaunay "
                   "tetrahedralization from which it starts.",
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

  const std::vector<std::string> of_delaunay = {"Delaunay: vertices examined", "Delaunay: grid cells"},
                                 of_front = {"front: candidates", "front: visibility tests", "front: grid cells"};
  claims.push_back(linear_claim(results, "linear-with-check", "6, Fig. 8",
                                "With the check, the time of the CDT grows linearly with the number of vertices.",
                                {"paper, with check", of_delaunay, "cdt"}));
  claims.push_back(linear_claim(results, "linear-without-check", "6, Fig. 8",
                                "Without the check, too, the time of the CDT grows linearly.",
                                {"paper, without check", of_front, "cdt"}));
  claims.push_back(linear_claim(results, "constant-time-front", "4",
                                "With the uniform grid, the front makes a tetrahedron in constant expected time.",
                                {"paper, without check", of_front, "front"}));
  claims.push_back(linear_claim(results, "linear-grid-delaunay", "5",
                                "Delaunay tetrahedralization face by face in a uniform grid also takes linear time.",
                                {"paper, with check", of_delaunay, "delaunay"}));
  claims.push_back(others_claim(results));
  claims.push_back(visibility_claim(results));
  claims.push_back(density_claim(results));
  return claims;
}

}  // namespace ccdt::reports
