#include <map>

#include "bench/results/numbers.h"
#include "reports/claims/claim.h"

namespace ccdt {
namespace {

std::string count_of(const ResultTable& table, const ResultRow& row, const char* column) {
  return with_separators(static_cast<std::uint64_t>(number_in(table, row, column)));
}

/// A measure that has to be 0 in each row with cases; `whole` is what it is counted among.
void add_zeros(const ResultTable& table, const std::string& experiment, const char* label, const char* part,
               const char* whole, const std::string& words, PaperClaim& claim) {
  for (const ResultRow& row : table.rows) {
    if (!(number_in(table, row, whole) > 0)) continue;
    ClaimMeasure measure = yes_or_no(text_in(table, row, label) + ": " + words, number_in(table, row, part),
                                     "0 of " + count_of(table, row, whole), number_in(table, row, part) == 0);
    measure.experiment = experiment;
    measure.table = table.name;
    measure.runs = row.runs;
    claim.measured.push_back(measure);
  }
}

/// The families in general position: the theorem does not speak of others.
ResultTable general_families(ResultTable families) {
  std::erase_if(families.rows, [&](const ResultRow& row) { return text_in(families, row, "position") != "general"; });
  return families;
}

/// All lattices together.
ResultTable all_lattices(ResultTable rules) {
  std::erase_if(rules.rows, [&](const ResultRow& row) { return text_in(rules, row, "lattice") != "all"; });
  return rules;
}

void add_theorem(std::span<const ExperimentResult> results, std::vector<PaperClaim>& claims) {
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
  if (const ResultTable* table = find_table(results, "theorem1", "families")) {
    const ResultTable families = general_families(*table);
    add_zeros(families, "theorem1", "family", "against_if", "premise", "protected, but without", sufficient);
    add_zeros(families, "theorem1", "family", "against_only_if", "dt", "with one, but not protected", necessary);
    add_zeros(families, "theorem1", "family", "edge_protected_without_cdt", "edge_protected", "protected, but without",
              existence);
  }
  claims.insert(claims.end(), {existence, sufficient, necessary});
}

/// How many inputs of a kind there were, and how many of them ended.
struct Endings {
  double cases = 0, ended = 0;
  std::vector<std::string> runs;
};

void add_endings(const std::string& kind, const Endings& endings, const char* table, PaperClaim& claim) {
  if (endings.cases == 0) return;
  ClaimMeasure measure =
      yes_or_no(kind + ": inputs where it ended", endings.ended,
                "all " + with_separators(static_cast<std::uint64_t>(endings.cases)), endings.ended == endings.cases);
  measure.experiment = "termination";
  measure.table = table;
  measure.runs = endings.runs;
  claim.measured.push_back(measure);
}

Endings endings_of_solids(const ResultTable& solids) {
  Endings endings;
  for (const ResultRow& row : solids.rows) {
    const std::string ended = text_in(solids, row, "ended");
    if (text_in(solids, row, "protection") != "midpoint" || (ended != "yes" && ended != "no")) continue;
    ++endings.cases;
    endings.ended += ended == "yes";
    endings.runs.insert(endings.runs.end(), row.runs.begin(), row.runs.end());
  }
  return endings;
}

void add_termination(std::span<const ExperimentResult> results, std::vector<PaperClaim>& claims) {
  PaperClaim ends{"midpoints-end",
                  "2",
                  "Inserting the middle points of missing grazeable edges again and again ends, with all of them "
                  "represented.",
                  {"termination"}};
  if (const ResultTable* solids = find_table(results, "termination", "solids"))
    add_endings("solids and files", endings_of_solids(*solids), "solids", ends);
  std::map<std::string, Endings> by_star;
  if (const ResultTable* stars = find_table(results, "termination", "stars"))
    for (const ResultRow& row : stars->rows) {
      Endings& endings = by_star[text_in(*stars, row, "star")];
      endings.cases += number_in(*stars, row, "cases");
      endings.ended += number_in(*stars, row, "midpoint_ended");
    }
  for (const auto& [star, endings] : by_star) add_endings("star of segments, " + star, endings, "stars", ends);
  claims.push_back(ends);
}

}  // namespace

void add_existence_claims(std::span<const ExperimentResult> results, std::vector<PaperClaim>& claims) {
  add_theorem(results, claims);
  add_termination(results, claims);
  PaperClaim harmless{"interior-points-harmless",
                      "3",
                      "Interior points do not affect whether a CDT exists: where the model has one, it has one with "
                      "them, too.",
                      {"interior-points"}};
  if (const ResultTable* table = find_table(results, "interior-points", "existence"))
    add_zeros(*table, "interior-points", "family", "lost", "cases", "with a CDT that one interior point takes away",
              harmless);
  if (const ResultTable* table = find_table(results, "interior-points", "rules"))
    add_zeros(all_lattices(*table), "interior-points", "rule", "harmed", "cases",
              "with protected edges that points would destroy", harmless);
  claims.push_back(harmless);
}

}  // namespace ccdt
