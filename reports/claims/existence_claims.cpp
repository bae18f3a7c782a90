#include "bench/results/numbers.h"
#include "reports/claims/claim.h"

namespace ccdt {
namespace {

/// With the paper's rule that keeps points out of the smallest spheres of faces, and with all of its points.
void add_interior_points(const ResultTable& rules, PaperClaim& claim) {
  for (const ResultRow& row : rules.rows) {
    if (text_in(rules, row, "lattice") != "all" || number_in(rules, row, "cases") == 0) continue;
    ClaimMeasure measure =
        yes_or_no("protected edges that points would destroy, rule \"" + text_in(rules, row, "rule") + "\"",
                  number_in(rules, row, "dropped"), "0", number_in(rules, row, "dropped") == 0);
    measure.experiment = "interior-points";
    measure.table = "rules";
    claim.measured.push_back(measure);
  }
}

}  // namespace

void add_existence_claims(std::span<const ExperimentResult> results, std::vector<PaperClaim>& claims) {
  PaperClaim harmless{"interior-points-harmless",
                      "3",
                      "Interior points do not affect whether a CDT exists: where the model has one, it has one with "
                      "them, too.",
                      {"interior-points"}};
  if (const ResultTable* rules = find_table(results, "interior-points", "rules")) add_interior_points(*rules, harmless);
  claims.push_back(harmless);
}

}  // namespace ccdt
