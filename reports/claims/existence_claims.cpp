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

/// Each input is a measure: all of them have to end.
void add_termination(std::span<const ExperimentResult> results, std::vector<PaperClaim>& claims) {
  PaperClaim ends{"midpoints-end",
                  "2",
                  "Inserting the middle points of missing grazeable edges again and again ends, with all of them "
                  "represented.",
                  {"termination"}};
  for (const char* name : {"solids", "star_runs"}) {
    const ResultTable* table = find_table(results, "termination", name);
    if (table == nullptr) continue;
    for (const ResultRow& row : table->rows) {
      const std::string ended = text_in(*table, row, "ended");
      if (text_in(*table, row, "protection") != "midpoint" || (ended != "yes" && ended != "no")) continue;
      ClaimMeasure measure =
          yes_or_no(text_in(*table, row, "group") + " " + text_in(*table, row, "case"),
                    ended == "yes" ? "ended after " + count_of(*table, row, "steiner_vertices") + " points"
                                   : std::string("stopped at the limit of 20 levels"),
                    "ends", ended == "yes");
      measure.experiment = "termination";
      measure.table = name;
      measure.runs = row.runs;
      ends.measured.push_back(measure);
    }
  }
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
