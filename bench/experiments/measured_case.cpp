#include "bench/experiments/measured_case.h"

#include <algorithm>

#include "bench/results/kept_mesh.h"
#include "engine/base/errors.h"
#include "engine/io/tet_mesh_files.h"

namespace ccdt::experiments {
namespace {

/// A file as it is called in its folder; elsewhere by its whole path.
std::string name_in(const std::filesystem::path& folder, const std::filesystem::path& file) {
  const auto whole = std::filesystem::absolute(file).lexically_normal();
  const auto name = whole.lexically_relative(std::filesystem::absolute(folder).lexically_normal());
  return name.empty() || *name.begin() == ".." ? whole.string() : name.string();
}

std::vector<std::string> command_of(const ExperimentOptions& options, const MeshCall& call,
                                    const std::filesystem::path& report) {
  const auto name = [&](const std::filesystem::path& file) { return name_in(options.folder, file); };
  const std::string mesher = baselines::is_mesher_description(call.mesher) ? name(call.mesher) : call.mesher;
  std::vector<std::string> command = {options.program.string(), "mesh", name(call.input), "-o", name(call.output)};
  command.insert(command.end(), {"--report", name(report), "--mesher", mesher});
  append(command, call.options);
  return command;
}

/// The record of a child that ended before it wrote a report.
RunRecord record_without_report(const MeshCall& call, const std::vector<std::string>& command) {
  RunRecord record;
  record.environment = bench::capture_environment();
  const baselines::Mesher& asked = baselines::mesher(call.mesher);
  record.mesher = {asked.name, baselines::version_of(asked), asked.name == "ccdt" ? record.environment.revision : ""};
  record.command = command;
  record.command.front() = "ccdt";
  record.input.name = command[2];
  record.options = {{"command_line", joined(call.options, " ")}};
  return record;
}

std::string run_file(const MeasuredCase& measured, std::size_t number) {
  return "runs/" + measured.stem + "-" + std::to_string(number) + ".json";
}

}  // namespace

RunRecord run_call(const ExperimentOptions& options, const MeshCall& call, const std::filesystem::path& report) {
  std::filesystem::remove(report);  // or that of an earlier experiment would be taken for this one's
  const std::vector<std::string> command = command_of(options, call, report);
  const baselines::ProcessResult child =
      baselines::run_program(command, {.folder = options.folder, .limits = options.limits});
  const bool wrote_one = std::filesystem::exists(report);
  RunRecord record = wrote_one ? bench::read_run_record(report) : record_without_report(call, command);
  bench::note_end(child, record);
  bench::write_run_record(record, report);
  return record;
}

bool is_counted(const ExperimentOptions& options, const MeasuredCase& measured, int number) {
  constexpr int counted_long_runs = 3;
  const bool is_long = measured.first.seconds.mesh > options.tetrahedra / 10000;
  return number <= (is_long ? std::min(options.runs, counted_long_runs) : options.runs);
}

void run_once(const ExperimentOptions& options, MeasuredCase& measured, int number) {
  if (measured.failed() || !is_counted(options, measured, number)) return;
  const auto report = options.folder / run_file(measured, static_cast<std::size_t>(number));
  RunRecord record = run_call(options, measured.call, report);
  if (number > 0 && record.status == baselines::RunStatus::ok) {
    measured.counted.push_back(record);
  } else {
    // A failure counts even if it went well before: a row of fewer samples than the others would not be fair.
    measured.first = record;
    measured.first_run = static_cast<std::size_t>(number);
  }
}

void run_in_turn(const ExperimentOptions& options, std::vector<MeasuredCase>& cases, int first_number,
                 const RunCallback& before, const RunCallback& after) {
  for (int number = first_number; number <= options.runs; ++number)
    for (MeasuredCase& measured : cases) {
      if (before) before(measured, number);
      run_once(options, measured, number);
      if (after) after(measured, number);
    }
}

std::vector<std::string> run_files(const MeasuredCase& measured) {
  if (measured.failed() || measured.counted.empty()) return {run_file(measured, measured.first_run)};
  std::vector<std::string> files;
  for (std::size_t i = 1; i <= measured.counted.size(); ++i) files.push_back(run_file(measured, i));
  return files;
}

KeptMesh keep_mesh(const ExperimentOptions& options, const MeasuredCase& measured, const std::string& title) {
  const std::string file = "meshes/" + measured.stem + ".json";
  results::write_kept_mesh(io::read_tet_mesh(measured.call.output), title, options.folder / file);
  return {file, title, run_files(measured).front()};
}

std::vector<double> samples_of(const MeasuredCase& measured, const SecondsOf& seconds) {
  std::vector<double> samples;
  for (const RunRecord& run : measured.counted) samples.push_back(seconds(run.seconds));
  return samples;
}

std::string CaseOutcome::failure() const {
  return std::string(name_of(status)) + ": " + reason;
}

CaseOutcome outcome_of(const MeasuredCase& measured) {
  return {measured.first.status, measured.first.reason, run_files(measured), measured.first.counts};
}

CaseOutcome outcome_of(const MeasuredCase& measured, const SecondsOf& seconds) {
  CaseOutcome outcome = outcome_of(measured);
  if (measured.failed()) return outcome;
  outcome.samples = samples_of(measured, seconds);
  outcome.seconds = bench::median_estimate(outcome.samples);
  return outcome;
}

}  // namespace ccdt::experiments
