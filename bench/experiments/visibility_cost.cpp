#include "bench/experiments/visibility_cost.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <vector>

#include "baselines/external_program.h"
#include "bench/experiments/surfaces.h"
#include "bench/gate/callgrind_profile.h"
#include "bench/gate/instructions.h"
#include "bench/run/in_parallel.h"
#include "engine/base/errors.h"
#include "engine/io/files.h"

namespace ccdt::experiments {
namespace {

const std::vector<std::string> visibility_cost_definitions = {
    "The paper's strategies (--strategies paper), and every face goes through the front (--face-protection off).",
    "Instructions: machine instructions of one run, counted by callgrind. They have no noise.",
    "Visibility tests: instructions of the exact tests of whether a face hides a vertex, and of what they call.",
    "Share: a range, from the tests alone to the whole front. With the search for the faces to test, it is in between.",
    "CDT: Delaunay, face check, front and labels.",
    "Callgrind is 50 times as slow, so the models have an eighth of the wanted tetrahedra, if they can be so coarse."};

/// The wanted size of a mesh under callgrind, as a share of the wanted number of tetrahedra.
constexpr double share_of_size = 0.125;

RowColumn<VisibilityCostRow> count_of(const char* name, const char* title,
                                      std::uint64_t (*count)(const CdtInstructions&)) {
  return {figure_column(name, title), [count](const VisibilityCostRow& row) {
            return row.instructions ? as_cell(count(*row.instructions)) : Cell();
          }};
}

/// "ok", the failure of the run, or "missing" if it could not be counted.
std::string counted_status(const VisibilityCostRow& row) {
  if (!row.ok()) return failure(row.measured);
  return row.instructions ? "ok" : "missing";
}

const RowColumns<VisibilityCostRow> visibility_cost_columns = {
    {label_column("model"), &VisibilityCostRow::model},
    {label_column("status"), counted_status},
    count_column("front_tetrahedra", &MeshCounts::front_tetrahedra, "tetrahedra of the front"),
    run_column(figure_column("tests", "visibility tests"),
               [](const RunRecord& run) { return as_cell(run.costs[Stage::front].work.visibility_tests); }),
    count_of("visibility", "instructions: visibility tests", [](const auto& i) { return i.visibility_tests; }),
    count_of("rest_of_front", "rest of the front", [](const auto& i) { return i.front - i.visibility_tests; }),
    count_of("delaunay", "Delaunay", [](const auto& i) { return i.delaunay; }),
    count_of("others", "face check and labels", [](const auto& i) { return i.others; }),
    {figure_column("share", "share of visibility in the CDT"),
     [](const VisibilityCostRow& row) {
       return row.instructions ? Cell(row.instructions->visibility_share()) : Cell();
     }},
    {note_column("reason", "why it is missing"), &VisibilityCostRow::why_missing}};

/// The profile of the run of a case; made unless an earlier call has made it.
std::string profile_of(const ExperimentOptions& options, const bench::MeasuredCase& measured) {
  const auto valgrind = baselines::find_on_path("valgrind");
  if (!valgrind) throw InputError("there is no valgrind on this machine", {}, "install it");
  const auto folder = options.folder / "instructions";
  std::filesystem::create_directories(folder);
  const auto file = folder / (measured.id + ".callgrind");
  if (!std::filesystem::exists(file)) {
    const baselines::TemporaryFolder scratch;
    const auto made = scratch.path() / "profile";
    std::vector<std::string> command = {"/usr/bin/env",
                                        gate::same_on_all_processors,
                                        valgrind->string(),
                                        "-q",
                                        "--tool=callgrind",
                                        "--callgrind-out-file=" + made.string(),
                                        std::filesystem::absolute(options.program).string(),
                                        "mesh",
                                        std::filesystem::absolute(measured.asked.input).string(),
                                        "-o",
                                        "mesh.vtu",
                                        "--threads",
                                        "1"};
    append(command, measured.asked.options);
    const baselines::ProcessResult run =
        baselines::run_program(command, {.folder = scratch.path(), .limits = options.limits});
    if (run.status != baselines::RunStatus::ok) throw MeshError("it failed under callgrind: " + run.reason, {}, "");
    std::filesystem::copy_file(made, file);
  }
  return io::read_whole_file(file).bytes;
}

void count_instructions(const ExperimentOptions& options, VisibilityCostRow& row) {
  if (!row.ok()) return;
  try {
    row.instructions = cdt_instructions(profile_of(options, row.measured));
  } catch (const Error& error) {
    row.why_missing = error.what();
  }
}

/// The largest of the other parts of the CDT.
std::uint64_t largest_other(const CdtInstructions& i) {
  return std::max({i.front - i.visibility_tests, i.delaunay, i.others});
}

}  // namespace

Estimate CdtInstructions::visibility_share() const {
  const auto whole = static_cast<double>(cdt());
  const double tests = static_cast<double>(visibility_tests) / whole;
  return {tests, tests, static_cast<double>(front) / whole};
}

CdtInstructions cdt_instructions(std::string_view profile) {
  const gate::StageInstructions stages = gate::stage_instructions(profile);
  const gate::CallGraph graph = gate::read_callgrind(profile);
  CdtInstructions counted{.delaunay = stages.at("delaunay"),
                          .front = stages.at("front"),
                          .others = stages.at("face_check") + stages.at("label")};
  for (const auto* const test : {"ccdt::front::cross_each_other", "ccdt::front::hides"})
    counted.visibility_tests += gate::inclusive_instructions(graph, test);
  if (counted.visibility_tests == 0 || counted.visibility_tests > counted.front)
    throw InputError("the tests of visibility are not in the profile", {}, "build the program without -flto");
  return counted;
}

ExperimentResult visibility_cost_result(std::span<const VisibilityCostRow> rows) {
  ExperimentResult result{.how = once(), .definitions = visibility_cost_definitions};
  for (const VisibilityCostRow& row : rows) {
    add_problem_of(row, result);
    if (row.ok() && !row.instructions) add_problem(result, row.model + ": " + row.why_missing, false);
    if (!row.instructions) continue;
    const Estimate share = row.instructions->visibility_share();
    const auto times =
        static_cast<double>(row.instructions->visibility_tests) / static_cast<double>(largest_other(*row.instructions));
    result.findings.push_back(row.model + ": the tests of visibility take " + rounded(100 * share.value) +
                              "% of the instructions of the CDT, and " + rounded(times) +
                              " times those of the largest other part; the whole front takes " +
                              rounded(100 * share.high) + "%");
  }
  result.tables = {
      table_of_rows("instructions", "Where the instructions of the CDT go", visibility_cost_columns, rows)};
  return result;
}

ExperimentResult measure_visibility_cost(const ExperimentOptions& options, bench::Runner& runner) {
  std::vector<VisibilityCostRow> rows;
  ExperimentOptions smaller = options;
  smaller.tetrahedra *= share_of_size;
  for (const PaperModel& model : paper_models) {
    if (!is_chosen(options, model.name)) continue;
    const SurfaceFile surface = write_solid(smaller, "visibility-cost", model.name, model.edge_length);
    VisibilityCostRow& row = rows.emplace_back();
    row.model = model.name;
    row.measured.asked =
        single_case(options, row.model + ", without the check", "ccdt", surface.file,
                    words_of("--strategies paper --face-protection off --improve none --steiner keep --grading 0"));
  }
  check_something_is_measured(rows.size(), "visibility-cost");
  measure_rows(runner, rows);
  bench::in_parallel(rows.size(), [&](std::size_t i) { count_instructions(options, rows[i]); });
  return visibility_cost_result(rows);
}

}  // namespace ccdt::experiments
