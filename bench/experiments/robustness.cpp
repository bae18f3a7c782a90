#include "bench/experiments/robustness.h"

#include <algorithm>
#include <array>
#include <functional>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string_view>
#include <tuple>

#include "baselines/mesher.h"
#include "engine/base/box.h"
#include "engine/base/errors.h"
#include "engine/io/plc_files.h"

namespace ccdt::experiments {
namespace {

using baselines::FailureKind;

constexpr const char *valid = "valid", *not_valid = "not valid", *unreadable = "unreadable";

const std::vector<std::string> robustness_definitions = {
    "Each mesher makes one mesh of each part, with its defaults: the inside gets vertices.",
    "Valid: ccdt check finds no error. Not valid: it finds some. Unreadable: the file is broken.",
    "Right: there is a mesh, and the exact verifier finds it right. Wrong: it does not.",
    "Not verified: there is a mesh, but the verifier reached its limit of time.",
    "ccdt --repair: the input is repaired first, within the usual limits; the reference is the repaired input.",
    "Other kinds are those of ccdt.run/1: invalid_input, limit, refused, timeout, out_of_memory, crashed.",
    "All files are read by ccdt, so an unreadable one is refused for every mesher.",
    "Seconds: meshing alone. Worst: failures first, the most serious ones first; then the longest times.",
    "A refusal of a part that is not valid is no failure, unless the part was to be repaired.",
    "Displacement: an upper bound of how far the repair moved the surface, lids apart.",
};

// ---- Outcomes

constexpr const char *right = "right", *not_verified = "not_verified";

/// The most serious one last.
const std::array<std::string_view, 9> all_outcomes = {right,
                                                      name_of(FailureKind::limit),
                                                      name_of(FailureKind::invalid_input),
                                                      name_of(FailureKind::refused),
                                                      not_verified,
                                                      name_of(FailureKind::timeout),
                                                      name_of(FailureKind::out_of_memory),
                                                      name_of(FailureKind::crashed),
                                                      name_of(FailureKind::wrong)};

std::string_view outcome_of(const RobustnessRow& row) {
  const RunRecord& run = row.measured.first;
  if (run.kind) return name_of(*run.kind);
  return run.verification ? right : not_verified;
}

std::ptrdiff_t gravity_of(std::string_view outcome) {
  return std::ranges::find(all_outcomes, outcome) - all_outcomes.begin();
}

bool is_meant_to_succeed(const RobustnessRow& row) {
  return row.input == valid || (row.repairs && row.input == not_valid);
}

bool is_failure(const RobustnessRow& row) {
  const std::string_view outcome = outcome_of(row);
  return gravity_of(outcome) > gravity_of(not_verified) || (is_meant_to_succeed(row) && outcome != right);
}

/// What must never happen, however large a part is and however short the time.
bool is_error_of_ours(const RobustnessRow& row) {
  const auto kind = row.measured.first.kind;
  if (!is_ours(row) || !kind) return false;
  const bool is_refused = kind == FailureKind::refused || kind == FailureKind::invalid_input;
  return kind == FailureKind::wrong || kind == FailureKind::crashed || (row.input == valid && is_refused);
}

// ---- Tables

RowColumns<RobustnessRow> columns_of_part() {
  return {{label_column("mesher"), &RobustnessRow::mesher},
          {label_column("part"), &RobustnessRow::part},
          {label_column("input"), &RobustnessRow::input},
          {label_column("outcome"), outcome_of}};
}

RowColumns<RobustnessRow> columns_of_run() {
  return {seconds_column(),
          run_column(time_column("memory", "peak memory", "MB"),
                     [](const RunRecord& run) { return Cell(static_cast<double>(run.peak_rss_bytes) / 1e6); }),
          count_column("tetrahedra", &MeshCounts::tetrahedra), reason_column()};
}

ResultTable cases_table(std::span<const RobustnessRow> rows) {
  RowColumns<RobustnessRow> columns = columns_of_part();
  append(columns, columns_of_run());
  return table_of_rows("cases", "The parts", columns, rows);
}

/// A mesher's rows, in the order of the meshers in the first part.
std::vector<std::vector<RobustnessRow>> by_mesher(std::span<const RobustnessRow> rows) {
  std::vector<std::vector<RobustnessRow>> groups;
  for (const RobustnessRow& row : rows) {
    const auto group = std::ranges::find(groups, row.mesher, [](const auto& g) { return g.front().mesher; });
    group == groups.end() ? groups.push_back({row}) : group->push_back(row);
  }
  return groups;
}

ResultTable outcomes_table(std::span<const RobustnessRow> rows) {
  std::vector<Column> columns = {label_column("mesher"), label_column("input"), figure_column("parts")};
  for (const std::string_view outcome : all_outcomes) columns.push_back(figure_column(std::string(outcome)));
  ResultTable table = table_of("outcomes", "Outcomes", columns);
  for (const auto& of_mesher : by_mesher(rows))
    for (const char* input : {valid, not_valid, unreadable}) {
      std::vector<RobustnessRow> chosen;
      std::ranges::copy_if(of_mesher, std::back_inserter(chosen), [&](const auto& row) { return row.input == input; });
      if (chosen.empty()) continue;
      ResultRow row{cells(of_mesher.front().mesher, std::string(input), std::uint64_t{chosen.size()}), {}};
      for (const std::string_view outcome : all_outcomes)
        row.cells.push_back(as_cell(static_cast<std::uint64_t>(std::ranges::count(chosen, outcome, &outcome_of))));
      row.runs = all_runs_of(chosen);
      table.rows.push_back(std::move(row));
    }
  return table;
}

ResultTable worst_table(std::span<const RobustnessRow> rows) {
  constexpr std::size_t most = 10;
  std::vector<RobustnessRow> worst;
  const auto order = [](const RobustnessRow& row) {
    const auto gravity = is_failure(row) ? gravity_of(outcome_of(row)) : 0;
    return std::tuple(gravity, is_meant_to_succeed(row), row.measured.first.costs.mesh_seconds);
  };
  for (auto& of_mesher : by_mesher(rows)) {
    std::ranges::stable_sort(of_mesher, std::greater(), order);
    append(worst, std::span(of_mesher).first(std::min(most, of_mesher.size())));
  }
  RowColumns<RobustnessRow> columns = columns_of_part();
  append(columns, columns_of_run());
  columns.push_back({note_column("command", "command that repeats it, in the folder"),
                     [](const RobustnessRow& row) { return joined(row.measured.first.command, " "); }});
  return table_of_rows("worst", "The worst parts of each mesher", columns, worst);
}

ResultTable displacement_table(std::span<const RobustnessRow> rows) {
  const auto repaired = [](double bench::RepairedInput::*value) {
    return [value](const RobustnessRow& row) { return row.measured.first.repaired.value().*value; };
  };
  const RowColumns<RobustnessRow> columns = {
      {label_column("part"), &RobustnessRow::part},
      {label_column("outcome"), outcome_of},
      {figure_column("displacement", "", "units of the part"), repaired(&bench::RepairedInput::displacement)},
      {figure_column("share", "displacement over the largest extent"),
       [](const RobustnessRow& row) {
         return *row.extent > 0 ? Cell(row.measured.first.repaired->displacement / *row.extent) : Cell();
       }},
      {figure_column("area_of_lids", "area of lids"), repaired(&bench::RepairedInput::area_of_lids)},
      {figure_column("area_removed", "area removed"), repaired(&bench::RepairedInput::area_removed)}};
  std::vector<RobustnessRow> moved;
  std::ranges::copy_if(rows, std::back_inserter(moved), [](const auto& row) { return row.extent.has_value(); });
  return table_of_rows("displacement", "Repaired inputs", columns, moved);
}

std::string finding_of(const RowView& row) {
  return row.text("mesher") + ": of " + with_separators(row.count("parts")) + " parts that are " + row.text("input") +
         ", " + with_separators(row.count(right)) + " are meshed and verified right";
}

// ---- Cases

struct CorpusPart {
  std::string file, input;
};

std::vector<CorpusPart> parts_from(const bench::Json& manifest) {
  std::vector<CorpusPart> parts;
  for (const bench::Json& file : manifest.at("files")) {
    const auto faults = file.at("faults").get<std::vector<std::string>>();
    const bool is_broken = std::ranges::find(faults, unreadable) != faults.end();
    parts.push_back({file.at("file"), file.at("valid").get<bool>() ? valid : is_broken ? unreadable : not_valid});
  }
  return parts;
}

constexpr bench::DocumentKind corpus_document = {"ccdt.corpus/1", "not a manifest of schema ccdt.corpus/1",
                                                 "make the corpus with tools/corpus"};

void add_part(const ExperimentOptions& options, const CorpusPart& part, std::vector<RobustnessRow>& rows) {
  const auto add = [&](const std::string& mesher, bool repairs = false) {
    RobustnessRow& row = rows.emplace_back();
    row.part = part.file, row.input = part.input, row.repairs = repairs;
    row.mesher = baselines::mesher(mesher).name + (repairs ? " --repair" : "");
    row.measured.asked = single_case(options, part.file + ", " + row.mesher, mesher, options.corpus / part.file,
                                     repairs ? std::vector<std::string>{"--repair"} : std::vector<std::string>());
    row.measured.asked.group = part.file;
  };
  add("ccdt");
  add("ccdt", true);
  for (const char* mesher : {"tetgen", "cgal-mesh3", "gmsh-hxt"})
    if (is_measured(options, mesher)) add(mesher);
  for (const std::string& file : described_meshers(options)) add(file);
}

}  // namespace

ExperimentResult robustness_result(std::span<const RobustnessRow> rows) {
  const ResultTable outcomes = outcomes_table(rows);
  ExperimentResult result{.how = once(),
                          .definitions = robustness_definitions,
                          .tables = {outcomes, worst_table(rows), displacement_table(rows), cases_table(rows)}};
  for (const RowView& row : rows_with(outcomes))
    if (row.text("input") != unreadable) result.findings.push_back(finding_of(row));
  for (const RobustnessRow& row : rows)
    if (is_error_of_ours(row) || (is_ours(row) && row.input == valid && is_failure(row)))
      add_problem(result, row.measured.asked.name + ": " + failure(row.measured), is_error_of_ours(row));
  return result;
}

ExperimentResult measure_robustness(const ExperimentOptions& options, bench::Runner& runner) {
  if (options.corpus.empty())
    throw InputError("the experiment robustness needs a corpus", {},
                     "make one with tools/corpus, and name its folder with --corpus");
  const std::vector<CorpusPart> parts =
      bench::read_document(options.corpus / "corpus.json", corpus_document, parts_from);
  check_something_is_measured(parts.size(), "robustness");
  std::vector<RobustnessRow> rows;
  for (const CorpusPart& part : parts) add_part(options, part, rows);
  measure_rows(runner, rows);
  for (RobustnessRow& row : rows)
    if (row.measured.first.repaired) row.extent = largest_extent(io::read_plc(row.measured.asked.input).vertices);
  return robustness_result(rows);
}

}  // namespace ccdt::experiments
