#include <array>

#include "bench/results/numbers.h"
#include "reports/claims/claim.h"

namespace ccdt {
namespace {

/// How a measure of quality is compared.
struct Measure {
  const char* column;
  const char* words;
  bool larger_is_better;
};
constexpr std::array<Measure, 4> measures = {{{"mean_r", "mean r", false},
                                              {"p99_r", "99% of r below", false},
                                              {"worst_r", "worst r", false},
                                              {"smallest_dihedral", "smallest dihedral angle", true}}};

/// The row of a variant that went well and has a comparable number of tetrahedra.
const ResultRow* row_of(const ResultTable& table, const std::string& variant) {
  for (const ResultRow& row : table.rows)
    if (text_in(table, row, "variant") == variant && text_in(table, row, "status") == "ok" &&
        text_in(table, row, "comparable") == "yes")
      return &row;
  return nullptr;
}

/// Ours beside TetGen's, by every measure; the weaker form asks for the mean only.
void add_figure(const ResultTable& table, const std::string& experiment, PaperClaim& claim) {
  const ResultRow *ours = row_of(table, "ccdt fcc"), *theirs = row_of(table, "tetgen");
  if (ours == nullptr || theirs == nullptr) return;
  for (const Measure& m : measures) {
    const double our_value = number_in(table, *ours, m.column), their_value = number_in(table, *theirs, m.column);
    const bool is_better = m.larger_is_better ? our_value > their_value : our_value < their_value;
    ClaimMeasure measure = yes_or_no(
        text_in(table, *ours, "model") + ": " + m.words, our_value,
        (m.larger_is_better ? "more than " : "less than ") + rounded(their_value, 4) + " (TetGen)", is_better);
    if (&m != &measures.front()) measure.weak = Claim::holds;
    measure.experiment = experiment;
    measure.table = "quality";
    measure.runs = {ours->runs.front(), theirs->runs.front()};
    claim.measured.push_back(measure);
  }
}

/// By one criterion, before improvement. The weaker form: FCC is the best more often than each other lattice.
void add_lattices(const ResultTable& table, PaperClaim& claim) {
  for (const ResultRow& row : table.rows) {
    if (text_in(table, row, "improved") != "no" || number_in(table, row, "cases") == 0) continue;
    const double fcc = number_in(table, row, "fcc");
    const bool is_ahead = fcc > number_in(table, row, "bcc") && fcc > number_in(table, row, "sc");
    ClaimMeasure measure =
        yes_or_no("best lattice by " + text_in(table, row, "criterion"),
                  "FCC in " + rounded(fcc, 1) + ", BCC in " + rounded(number_in(table, row, "bcc"), 1) + ", SC in " +
                      rounded(number_in(table, row, "sc"), 1),
                  "FCC in all " + rounded(number_in(table, row, "cases"), 1) + " cases, alone",
                  text_in(table, row, "confirmed") == "yes");
    measure.weak = is_ahead ? Claim::holds : Claim::fails;
    measure.experiment = "lattices";
    measure.table = "best";
    claim.measured.push_back(measure);
  }
}

}  // namespace

void add_quality_claims(std::span<const ExperimentResult> results, std::vector<PaperClaim>& claims) {
  PaperClaim better{"better-than-refinement",
                    "6, Figs. 9 to 11",
                    "The tetrahedra are better than those of Delaunay refinement (Shewchuk's; TetGen stands in), by "
                    "the paper's measure r.",
                    {"fig9", "fig10", "fig11"}};
  better.weaker = "The mean of r is better.";
  for (const std::string& figure : better.experiments)
    if (const ResultTable* table = find_table(results, figure, "quality")) add_figure(*table, figure, better);
  claims.push_back(better);

  PaperClaim fcc{"fcc-is-best",
                 "3",
                 "Of all Bravais lattices, the face-centred cubic one makes the best tetrahedra (here: of FCC, BCC and "
                 "SC, in meshes as the lattice makes them).",
                 {"lattices"}};
  fcc.weaker = "FCC is the best in more cases than each of the others.";
  if (const ResultTable* table = find_table(results, "lattices", "best")) add_lattices(*table, fcc);
  claims.push_back(fcc);
}

}  // namespace ccdt
