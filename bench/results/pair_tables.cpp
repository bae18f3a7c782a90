#include <algorithm>
#include <limits>
#include <map>
#include <random>
#include <set>
#include <unordered_map>

#include "bench/results/sweep_tables.h"
#include "bench/run/median_interval.h"
#include "bench/run/numbers.h"

namespace ccdt::results {
namespace {

/// Our mesher if it takes part, otherwise the first one.
std::string reference_of(const Sweep& sweep) {
  const bool has_ours = std::ranges::any_of(sweep.cases, [](const CaseRuns& c) { return c.mesher == "ccdt"; });
  return has_ours || sweep.cases.empty() ? "ccdt" : sweep.cases.front().mesher;
}

/// Do the two agree in all options that both meshers have?
bool have_same_options(const CaseRuns& a, const CaseRuns& b) {
  for (std::size_t i = 0; i < a.values.size(); ++i)
    if (!a.values[i].empty() && !b.values[i].empty() && a.values[i] != b.values[i]) return false;
  return true;
}

/// All pairs with one other mesher.
struct PairCounts {
  std::vector<double> ratios = {};
  std::uint64_t only_first = 0, only_second = 0, neither = 0;
  double low = std::numeric_limits<double>::infinity(), high = 0;  ///< of the seconds of both
};

void count(const CaseSummary& first, const CaseSummary& second, PairCounts& counts) {
  if (!first.seconds || !second.seconds) {
    ++(first.seconds ? counts.only_first : second.seconds ? counts.only_second : counts.neither);
    return;
  }
  const double a = first.seconds->value, b = second.seconds->value;
  counts.ratios.push_back(a / b);
  counts.low = std::min({counts.low, a, b});
  counts.high = std::max({counts.high, a, b});
}

/// A picture of more points takes long and shows nothing new.
constexpr std::size_t most_pairs = 3000;

/// Draws this many pairs, the same each time.
void thin_out(ResultTable& pairs) {
  if (pairs.rows.size() <= most_pairs) return;
  const double share = static_cast<double>(most_pairs) / static_cast<double>(pairs.rows.size());
  pairs.title += ", a sample of " + bench::with_separators(pairs.rows.size());
  std::mt19937_64 random(1);
  std::erase_if(pairs.rows, [&](const ResultRow&) { return static_cast<double>(random() >> 11) * 0x1p-53 > share; });
}

void add_pair(const RowColumns<CaseSummary>& labels, const CaseSummary& first, const CaseSummary& second,
              ResultTable& pairs) {
  std::vector<std::string> runs = first.runs;
  runs.insert(runs.end(), second.runs.begin(), second.runs.end());
  add_labeled_row(pairs, std::move(runs), cells_of(labels, first),
                  cells(first.of->mesher + " / " + second.of->mesher, first.legend, *first.seconds, *second.seconds,
                        first.seconds->value / second.seconds->value));
}

}  // namespace

PairTables pair_tables(const Sweep& sweep, std::span<const CaseSummary> cases) {
  PairTables tables{reference_of(sweep),
                    {"pairs_summary",
                     "Two meshers on the same inputs",
                     {{"first", "first", ColumnKind::label},
                      {"second", "second", ColumnKind::label},
                      {"both", "solved by both", ColumnKind::time},
                      {"only_first", "by the first only", ColumnKind::time},
                      {"only_second", "by the second only", ColumnKind::time},
                      {"neither", "by neither", ColumnKind::time},
                      {"faster", "first is faster", ColumnKind::time},
                      {"ratio", "seconds of the first / second, median", ColumnKind::time}}},
                    labeled_table(sweep, "pairs", "Pairs of cases",
                                  {{"meshers", "meshers", ColumnKind::note},
                                   {"legend", "legend", ColumnKind::note},
                                   {"first_seconds", "seconds of the first", ColumnKind::time, "s"},
                                   {"second_seconds", "seconds of the second", ColumnKind::time, "s"},
                                   {"ratio", "ratio", ColumnKind::time}},
                                  true),
                    {"diagonals",
                     "Diagonals",
                     {{"meshers", "meshers", ColumnKind::note}, {"seconds", "seconds", ColumnKind::time, "s"}},
                     {},
                     true}};
  const RowColumns<CaseSummary> labels = label_columns(sweep);
  std::unordered_map<std::string, std::vector<const CaseSummary*>> others;
  for (const CaseSummary& s : cases)
    if (s.of->mesher != tables.reference && s.is_run()) others[s.of->input.name].push_back(&s);
  std::map<std::string, PairCounts> counts;
  for (const CaseSummary& first : cases) {
    if (first.of->mesher != tables.reference || !first.is_run()) continue;
    for (const CaseSummary* second : others[first.of->input.name]) {
      if (!have_same_options(*first.of, *second->of)) continue;
      count(first, *second, counts[second->of->mesher]);
      if (first.seconds && second->seconds) add_pair(labels, first, *second, tables.pairs);
    }
  }
  thin_out(tables.pairs);
  for (const auto& [other, c] : counts) {
    const auto faster = static_cast<std::uint64_t>(std::ranges::count_if(c.ratios, [](double r) { return r < 1; }));
    tables.summary.rows.push_back({{tables.reference, other, cell_of(std::uint64_t{c.ratios.size()}),
                                    cell_of(c.only_first), cell_of(c.only_second), cell_of(c.neither), cell_of(faster),
                                    c.ratios.empty() ? Cell() : Cell(bench::median_estimate(c.ratios))}});
    if (c.high > 0)
      for (const double end : {c.low, c.high})
        tables.diagonals.rows.push_back({{tables.reference + " / " + other, end}});
  }
  return tables;
}

}  // namespace ccdt::results
