#include "bench/experiments/case_runner.h"

#include "engine/base/errors.h"

namespace ccdt {
namespace {

/// A file as it is called in its folder; elsewhere by its whole path.
std::string name_in(const std::filesystem::path& folder, const std::filesystem::path& file) {
  const auto whole = std::filesystem::absolute(file).lexically_normal();
  const auto name = whole.lexically_relative(std::filesystem::absolute(folder).lexically_normal());
  return name.empty() || *name.begin() == ".." ? whole.string() : name.string();
}

/// Without the program.
std::vector<std::string> arguments_of(const std::filesystem::path& folder, const Case& what,
                                      const std::filesystem::path& report) {
  const std::string mesher = is_mesher_description(what.mesher) ? name_in(folder, what.mesher) : what.mesher;
  std::vector<std::string> arguments = {
      "mesh",     name_in(folder, what.input), "-o",       name_in(folder, what.output),
      "--report", name_in(folder, report),     "--mesher", mesher};
  arguments.insert(arguments.end(), what.options.begin(), what.options.end());
  return arguments;
}

/// The record of a child that ended before it knew what it was to do.
RunRecord record_of_the_dead(const Case& what, const std::vector<std::string>& command) {
  RunRecord record;
  record.environment = capture_environment();
  const Mesher& asked = mesher(what.mesher);
  record.mesher = {asked.name, version_of(asked), asked.name == "ccdt" ? record.environment.revision : ""};
  record.command = command;
  record.command.front() = "ccdt";
  record.input.name = command[2];
  std::string words;
  for (const std::string& option : what.options) words += (words.empty() ? "" : " ") + option;
  record.options = {{"command_line", words}};
  return record;
}

}  // namespace

RunRecord run_case(const std::filesystem::path& program, const std::filesystem::path& folder, const Case& what,
                   const std::filesystem::path& report, const Limits& limits) {
  std::filesystem::remove(report);  // or that of an earlier experiment would be taken for this one's
  std::vector<std::string> command = arguments_of(folder, what, report);
  command.insert(command.begin(), program.string());
  const ProcessResult child = run_program(command, {.folder = folder, .limits = limits});
  const bool wrote_one = std::filesystem::exists(report);
  RunRecord record = wrote_one ? read_run_record(report) : record_of_the_dead(what, command);
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
