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

/// What the growth of a claim is read from.
struct Grown {
  std::string strategy;
  std::vector<std::string> work;  ///< quantities of exact counts; none: time alone
  std::string time;               ///< quantity of seconds
};

const std::string linear_words = "within " + rounded(experiments::linear_within, 1) + " of 1";

using TestOfExponent = BoundTest (*)(const bench::Estimate&);

/// Adds the exponents of fits that may be judged; a missing measure if there is none.
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
  if (!is_judged) claim.measured.push_back(missing_measure(what, bound, "fig8", table));
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

}  // namespace

std::vector<PaperClaim> time_claims(Results results) {
  std::vector<PaperClaim> claims;
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
                                "Delaunay tetrahedralization face by face in a uniform grid is linear, too.",
                                {"paper, with check", of_delaunay, "delaunay"}));
  claims.push_back(others_claim(results));
  return claims;
}

}  // namespace ccdt::reports
