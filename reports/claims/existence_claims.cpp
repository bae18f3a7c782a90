#include <algorithm>
#include <map>
#include <utility>

#include "reports/claims/claim_groups.h"

namespace ccdt::reports {
namespace {

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

/// Splitting in either way must agree.
PaperClaim fewer_vertices(Results results) {
  PaperClaim claim{"fewer-vertices-than-conforming",
                   "1",
                   "A conforming constrained Delaunay tetrahedralization needs fewer additional vertices than a "
                   "conforming Delaunay tetrahedralization.",
                   {"conforming"}};
  claim.weaker = "It never needs more.";
  for (const ClaimRow& row : rows_of(results, "conforming", "comparison")) {
    const std::string split = "split as " + row.text("protection") + ": inputs where ours needs ";
    const double needed = row.number("needed"), fewer = row.number("fewer"), more = row.number("more");
    if (needed == 0) {
      claim.measured.push_back(missing_measure(split + "fewer", "all that need any", row.experiment, row.table->name));
      continue;
    }
    claim.measured.push_back(measure_of(
        row, split + "fewer", fewer,
        "all " + with_separators(static_cast<std::uint64_t>(needed)) + " for which a conforming one needs any",
        yes_or_no(fewer == needed), BoundTest::holds));
    claim.measured.push_back(measure_of(row, split + "more", more, "0", yes_or_no(more == 0), yes_or_no(more == 0)));
  }
  return claim;
}

PaperClaim weaker_condition(Results results) {
  PaperClaim claim{
      "weaker-condition-than-radovitzky",
      "5.2",
      "Few bodies fulfill the condition of Radovitzky and Ortiz, that the smallest spheres of all boundary "
      "triangles are empty; Theorem 1's condition asks for less.",
      {"conditions"}};
  claim.weaker = "Theorem 1's holds wherever the other one does.";
  for (const ClaimRow& row : rows_of(results, "conditions", "models", {{"lattice", "all"}})) {
    const double models = row.number("models"), theirs = row.number("theirs"), theorem = row.number("theorem");
    const BoundTest includes = yes_or_no(row.number("only_theirs") == 0);
    claim.measured.push_back(measure_of(row, "models that fulfill only Radovitzky and Ortiz' condition",
                                        row.number("only_theirs"), "0", includes, includes));
    claim.measured.push_back(measure_of(row, "models that fulfill Theorem 1's", theorem,
                                        "more than " + with_separators(static_cast<std::uint64_t>(theirs)),
                                        yes_or_no(theorem > theirs), BoundTest::holds));
    claim.measured.push_back(measure_of(row, "models that fulfill Radovitzky and Ortiz' condition", theirs,
                                        "few: at most half of " + with_separators(static_cast<std::uint64_t>(models)),
                                        yes_or_no(theirs <= models / 2), BoundTest::holds));
  }
  return claim;
}

}  // namespace

std::vector<PaperClaim> existence_claims(Results results) {
  std::vector<PaperClaim> claims;
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
  claims.insert(claims.end(), {harmless, fewer_vertices(results), weaker_condition(results)});
  return claims;
}

}  // namespace ccdt::reports
