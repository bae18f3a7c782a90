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

/// The record of a child that ended before it knew what it was to do.
RunRecord record_of_the_dead(const Case& what) {
  RunRecord record;
  record.environment = capture_environment();
  const Mesher& asked = mesher(what.mesher);
  record.mesher = {asked.name, version_of(asked), asked.name == "ccdt" ? record.environment.revision : ""};
  record.input.name = what.input.string();
  std::string words;
  for (const std::string& option : what.options) words += (words.empty() ? "" : " ") + option;
  record.options = {{"command_line", words}};
  return record;
}

}  // namespace

RunRecord run_case(const std::filesystem::path& program, const Case& what, const std::filesystem::path& report,
                   const Limits& limits) {
  std::filesystem::remove(report);  // or that of an earlier experiment would be taken for this one's
  const ChildResult child = run_child(command_of(program, what, report), limits);
  const bool wrote_one = std::filesystem::exists(report);
  RunRecord record = wrote_one ? read_run_record(report) : record_of_the_dead(what);
  // A child that has failed by itself says more in its own record than its last words do; but what it wrote before it
  // crashed says only what it was to do.
  const bool ended_by_itself = child.status == RunStatus::ok || child.status == RunStatus::failed;
  if (wrote_one && ended_by_itself && record.status != RunStatus::crashed) return record;
  record.status = child.status;
  record.reason = child.reason;
  write_run_record(record, report);
  return record;
}

}  // namespace ccdt
