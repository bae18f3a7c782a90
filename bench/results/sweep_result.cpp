#include "bench/results/sweep_result.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "bench/results/sweep_tables.h"
#include "bench/run/numbers.h"
#include "bench/run/run_record.h"
#include "engine/base/errors.h"

namespace ccdt::results {
namespace {

using bench::with_separators;

std::string counted(std::size_t count, const std::string& noun) {
  return with_separators(count) + " " + noun + (count == 1 ? "" : "s");
}

std::string share(std::size_t part, std::size_t whole) {
  return with_separators(part) + " of " + with_separators(whole);
}

template <class Test>
std::size_t count_of(std::span<const CaseSummary> cases, Test test) {
  return static_cast<std::size_t>(std::ranges::count_if(cases, test));
}

/// The environment of the first readable run.
bench::Environment environment_of(const Sweep& sweep) {
  for (const CaseRuns& one : sweep.cases)
    for (const NumberedRun& run : one.runs) try {
        return bench::read_run_record(sweep.folder / run.file).environment;
      } catch (const InputError&) {  // from an older program; try the next one
      }
  return {};
}

void add_circumstances(const Sweep& sweep, ExperimentResult& result) {
  result.how.environment = environment_of(sweep);
  for (const CaseRuns& one : sweep.cases) {
    result.how.limits = one.asked.limits;
    result.how.runs = std::max(result.how.runs, looks_of(one.asked.repetitions).front());
  }
  result.how.command = "ccdt sweep sweep.json -o .";
}

void add_case_findings(std::span<const CaseSummary> cases, ExperimentResult& result) {
  const std::size_t run = count_of(cases, &CaseSummary::is_run), solved = count_of(cases, &CaseSummary::is_solved);
  result.findings.push_back(share(solved, cases.size()) + " cases are solved.");
  const std::size_t verified = count_of(cases, [](const auto& s) { return text_of(s, "verified") == "yes"; });
  if (verified > 0) result.findings.push_back(share(verified, solved) + " meshes were verified and are right.");
  const std::size_t wide = count_of(cases, [](const auto& s) { return !s.spread.empty(); });
  if (wide > 0)
    result.findings.push_back("The times of " + counted(wide, "case") + " spread more than requested, or more than " +
                              bench::rounded(100 * widest_spread, 2) + "%; their rows say so.");
  if (run < cases.size())
    result.problems.push_back(counted(cases.size() - run, "case") +
                              " of the sweep have no run yet; call `ccdt sweep` again to continue");
}

/// Up to this many fits are findings of their own; otherwise the range of each mesher is one.
constexpr std::size_t most_single_fits = 6;

void add_fit_findings(const ResultTable& fits, std::vector<std::string>& findings) {
  constexpr const char* says = ": the time grows with the number of tetrahedra to the power ";
  std::map<std::string, std::vector<double>> exponents;
  for (const auto& row : fits.rows) {
    const auto& slope = std::get<bench::Estimate>(cell(fits, row, "exponent"));
    exponents[text_in(fits, row, "mesher")].push_back(slope.value);
    if (fits.rows.size() > most_single_fits) continue;
    std::vector<std::string> of;
    for (const Column& column : fits.columns)
      if (std::string text = text_in(fits, row, column.name); !text.empty()) of.push_back(std::move(text));
    findings.push_back(bench::joined(of) + says + bench::with_interval(slope) + ".");
  }
  if (fits.rows.size() <= most_single_fits) return;
  for (const auto& [mesher, values] : exponents) {
    const auto [low, high] = std::ranges::minmax(values);
    findings.push_back(mesher + says + bench::rounded(low) + " to " + bench::rounded(high) + ", in " +
                       counted(values.size(), "fit") + ".");
  }
}

void add_pair_findings(const ResultTable& pairs, std::vector<std::string>& findings) {
  for (const auto& row : pairs.rows) {
    const auto* ratio = std::get_if<bench::Estimate>(&cell(pairs, row, "ratio"));
    if (ratio == nullptr) continue;
    findings.push_back(text_in(pairs, row, "first") + " takes " + bench::with_interval(*ratio) + " times as long as " +
                       text_in(pairs, row, "second") + " (median of " +
                       with_separators(static_cast<std::uint64_t>(number_in(pairs, row, "both"))) + " pairs).");
  }
}

/// Finds errors of ccdt itself.
void judge(const Sweep& sweep, std::span<const CaseSummary> cases, ExperimentResult& result) {
  std::size_t wrong = 0, crashed = 0;
  for (const CaseSummary& s : cases) {
    if (s.of->mesher != "ccdt") continue;
    wrong += s.kind == "wrong";
    crashed += s.kind == "crashed";
  }
  if (wrong > 0) result.problems.push_back(counted(wrong, "mesh") + " of ccdt failed the verification");
  if (crashed > 0) result.problems.push_back("ccdt crashed in " + counted(crashed, "case"));
  std::size_t different = 0;
  const ResultTable& same = *find_table(result, "same_mesh");
  for (const auto& row : same.rows) different += text_in(same, row, "same") == "no";
  if (different > 0)
    result.problems.push_back(share(different, same.rows.size()) + " groups of strategies give different meshes");
  else if (!same.rows.empty())
    result.findings.push_back("All strategies that must give the same mesh do, in " +
                              counted(same.rows.size(), "group") + ".");
  result.is_good = wrong + crashed + different == 0;
  if (sweep.broken_records > 0)
    result.problems.push_back(counted(sweep.broken_records, "file") +
                              " in runs are not records; they count as missing");
  std::set<std::string_view> machines;
  for (const CaseRuns& one : sweep.cases)
    for (const NumberedRun& run : one.runs) machines.insert(text_of(run.values, "cpu"));
  machines.erase("");
  if (machines.size() > 1) {
    const std::vector<std::string> names(machines.begin(), machines.end());
    result.problems.push_back("runs were made on " + counted(machines.size(), "processor") + " (" +
                              bench::joined(names) + "), so their times cannot be compared");
  }
}

}  // namespace

ExperimentResult sweep_result(const Sweep& sweep) {
  const std::vector<CaseSummary> cases = summarize_cases(sweep);
  ExperimentResult result{.name = sweep_name, .title = "Sweep " + sweep.name};
  add_circumstances(sweep, result);
  ScalingTables scaling = scaling_tables(sweep, cases);
  PairTables pairs = pair_tables(sweep, cases);
  result.tables = {cases_table(sweep, cases),  failures_table(cases),      std::move(scaling.fits),
                   std::move(pairs.summary),   pareto_table(sweep, cases), same_mesh_table(sweep, cases),
                   solved_table(sweep, cases), std::move(scaling.points),  std::move(scaling.lines),
                   std::move(pairs.pairs),     std::move(pairs.diagonals)};
  add_case_findings(cases, result);
  add_pair_findings(*find_table(result, "pairs_summary"), result.findings);
  add_fit_findings(*find_table(result, "scaling"), result.findings);
  judge(sweep, cases, result);
  result.definitions = {
      "A case is one mesher on one input with one set of options.",
      "Seconds: the median of the counted runs of a case, of meshing alone.",
      "Intervals are between order statistics, and cover the median in 95% of all cases.",
      "There is no interval for fewer than six runs.",
      "spread: the half-width of the interval is more than requested, or more than 10% of the median.",
      "r is 1 for the regular tetrahedron and larger for all others.",
      "If there are very many pairs of cases, the chart of two meshers shows a sample of 3,000; its table counts all.",
      "A failure's kind is one of invalid_input, limit, refused, crashed, timeout, out_of_memory, wrong.",
      "Quality against time: over the inputs that all meshers with these options solve.",
      "A mesher that solves less than half of them is left out there."};
  return result;
}

}  // namespace ccdt::results
