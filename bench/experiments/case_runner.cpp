#include "bench/experiments/case_runner.h"

#include "engine/base/errors.h"

namespace ccdt {
namespace {

std::vector<std::string> command_of(const std::filesystem::path& program, const Case& what,
                                    const std::filesystem::path& report) {
  std::vector<std::string> command = {program.string(),     "mesh",     what.input.string(), "-o",
                                      what.output.string(), "--report", report.string(),     "--mesher",
                                      what.mesher};
  command.insert(command.end(), what.options.begin(), what.options.end());
  return command;
}

/// The record of a child that could not write one itself.
RunRecord record_of_the_dead(const Case& what, const ChildResult& child) {
  RunRecord record;
  record.environment = capture_environment();
  const Mesher& asked = mesher(what.mesher);
  record.mesher = {asked.name, asked.version, asked.name == "ccdt" ? record.environment.revision : ""};
  record.input.name = what.input.string();
  std::string words;
  for (const std::string& option : what.options) words += (words.empty() ? "" : " ") + option;
  record.options = {{"command_line", words}};
  record.status = child.status;
  record.reason = child.reason;
  return record;
}

}  // namespace

RunRecord run_case(const std::filesystem::path& program, const Case& what, const std::filesystem::path& report,
                   const Limits& limits) {
  std::filesystem::remove(report);  // or that of an earlier experiment would be taken for this one's
  const ChildResult child = run_child(command_of(program, what, report), limits);
  // A child that has failed by itself says more in its own record than its last words do.
  const bool wrote_it = child.status == RunStatus::ok || child.status == RunStatus::failed;
  if (wrote_it && std::filesystem::exists(report)) return read_run_record(report);
  RunRecord record = record_of_the_dead(what, child);
  write_run_record(record, report);
  return record;
}

}  // namespace ccdt
