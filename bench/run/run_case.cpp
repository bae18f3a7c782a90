#include "bench/run/run_case.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "baselines/mesher.h"
#include "baselines/mesher_options.h"
#include "bench/run/environment.h"
#include "bench/run/file_names.h"
#include "bench/run/verify_run.h"
#include "engine/io/output_folder.h"
#include "engine/options/option_table.h"

namespace ccdt::bench {
namespace {

/// The folder of one run, which is removed at the end.
class Scratch {
 public:
  explicit Scratch(std::filesystem::path folder) : folder_(std::move(folder)) {
    std::filesystem::remove_all(folder_);  // left by a run that was killed
    std::filesystem::create_directories(folder_);
  }
  ~Scratch() { io::remove_if_possible(folder_); }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  std::filesystem::path file(const std::string& name) const { return folder_ / name; }
  const std::filesystem::path& folder() const { return folder_; }

 private:
  std::filesystem::path folder_;
};

std::string mesh_ending(const Case& asked) {
  return asked.mesh_ending.empty() ? ".vtu" : asked.mesh_ending;
}

baselines::ProcessResult call(const RunPlace& place, std::vector<std::string> command, const Scratch& scratch,
                              const baselines::Limits& limits) {
  command.insert(command.begin(), place.program.string());
  return baselines::run_program(command, {.folder = place.folder, .limits = limits, .scratch = scratch.folder()});
}

/// The record of a child process that ended before it wrote a report.
RunRecord record_without_report(const RunPlace& place, const Case& asked) {
  InputPlc unread;
  unread.name = name_in(place.folder, asked.input);
  baselines::NamedOptions options;
  for (std::size_t i = 0; i + 1 < asked.options.size(); i += 2)
    options[asked.options[i].substr(asked.options[i].find_first_not_of('-'))] = asked.options[i + 1];
  MeshOptions chosen;
  chosen.threads = 1;
  for (const auto& [name, value] : baselines::with_strategies(options))
    if (const options::MeshOption* const option = options::find_mesh_option(name)) set_value(*option, value, chosen);
  return start_record(baselines::mesher(asked.mesher), unread, chosen);
}

RunRecord record_of(const RunPlace& place, const Case& asked, const std::filesystem::path& report,
                    const baselines::ProcessResult& child) {
  RunRecord record;
  if (auto own = find_run_record(report)) {
    record = *std::move(own);
  } else {
    record = record_without_report(place, asked);
    record.set_failure(baselines::FailureKind::crashed, "the process ended without a report");
  }
  note_end(child, record);
  return record;
}

/// Does the run make a new surface, against which its mesh is then verified?
bool has_new_surface(const Case& asked) {
  const auto surface = std::ranges::find(asked.options, "--surface");
  const bool remesh =
      surface != asked.options.end() && surface + 1 != asked.options.end() && *(surface + 1) == "remesh";
  return asked.verify && (remesh || std::ranges::find(asked.options, "--repair") != asked.options.end());
}

RunFiles files_of(const Case& asked, const Scratch& scratch) {
  const auto input = has_new_surface(asked) ? scratch.file("surface.poly") : std::filesystem::absolute(asked.input);
  return {input, scratch.file("mesh" + mesh_ending(asked)), scratch.folder()};
}

/// The files of a mesh that consists of several files differ only after the first dot.
void keep_mesh(const RunPlace& place, const MeasuredCase& measured, const Scratch& scratch) {
  std::filesystem::create_directories(place.folder / "meshes");
  const std::string stem = "mesh";
  for (const auto& entry : std::filesystem::directory_iterator(scratch.folder()))
    if (const std::string name = entry.path().filename().string(); name.starts_with(stem + "."))
      std::filesystem::rename(entry.path(), place.folder / "meshes" / (measured.id + name.substr(stem.size())));
}

}  // namespace

std::vector<std::string> mesh_arguments(const std::filesystem::path& folder, const Case& asked, const std::string& mesh,
                                        const std::string& report) {
  const bool is_description = baselines::is_mesher_description(asked.mesher);
  std::vector<std::string> command = {"mesh", name_in(folder, asked.input), "-o", mesh, "--report", report};
  command.insert(command.end(), {"--mesher", is_description ? name_in(folder, asked.mesher) : asked.mesher});
  // Meshers are compared on one core unless a case asks for more.
  if (std::ranges::find(asked.options, "--threads") == asked.options.end())
    command.insert(command.end(), {"--threads", "1"});
  command.insert(command.end(), asked.options.begin(), asked.options.end());
  return command;
}

void run_next(const RunPlace& place, MeasuredCase& measured) {
  const Case& asked = measured.asked;
  const auto folder = std::filesystem::absolute(place.folder);
  const std::string file = run_file(measured.id, measured.runs);
  const Scratch scratch(folder / "scratch" / std::filesystem::path(file).stem());
  const RunFiles files = files_of(asked, scratch);
  const auto report = scratch.file("record.json");
  std::vector<std::string> command = mesh_arguments(place.folder, asked, files.mesh.string(), report.string());
  if (has_new_surface(asked)) command.insert(command.end(), {"--surface-output", files.input.string()});

  const baselines::ProcessResult child = call(place, std::move(command), scratch, asked.limits);
  RunRecord record = record_of(place, asked, report, child);
  record.case_id = measured.id;
  record.number = measured.runs;
  record.environment.jobs = place.jobs;
  record.command = mesh_arguments(place.folder, asked, "again" + mesh_ending(asked), "again.json");
  record.command.insert(record.command.begin(), "ccdt");
  if (asked.verify && record.status == baselines::RunStatus::ok) verify_run(place, measured, files, record);
  if (record.status == baselines::RunStatus::ok && !asked.mesh_ending.empty()) keep_mesh(place, measured, scratch);
  std::filesystem::create_directories(folder / "runs");
  // Written in the scratch folder, so that a killed process leaves nothing among the records.
  const auto written = scratch.file("run.json");
  write_run_record(record, written);
  std::filesystem::rename(written, folder / file);
  add_run(measured, std::move(record));
}

void make_mesh_again(const RunPlace& place, const MeasuredCase& measured) {
  const Case& asked = measured.asked;
  const Scratch scratch(std::filesystem::absolute(place.folder) / "scratch" / (measured.id + "-mesh"));
  const std::string mesh = scratch.file("mesh" + mesh_ending(asked)).string(),
                    report = scratch.file("record.json").string();
  call(place, mesh_arguments(place.folder, asked, mesh, report), scratch, asked.limits);
  keep_mesh(place, measured, scratch);
}

}  // namespace ccdt::bench
