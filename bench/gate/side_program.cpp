#include "bench/gate/side_program.h"

#include <wordexp.h>

#include <algorithm>
#include <array>
#include <sstream>

#include "baselines/external_program.h"
#include "bench/run/numbers.h"

namespace ccdt::gate {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_lines = 2;  ///< of the output of a program that failed

/// None: it has syntax that only a shell understands.
std::optional<Command> words_of(const std::string& text) {
  wordexp_t expanded{};
  const int fault = wordexp(text.c_str(), &expanded, WRDE_NOCMD);
  if (fault != 0) return std::nullopt;
  Command words(expanded.we_wordv, expanded.we_wordv + expanded.we_wordc);
  wordfree(&expanded);
  return words;
}

/// A line that Google Benchmark prints before it runs anything.
bool is_banner(const std::string& line) {
  static constexpr std::array begins = {"Running ", "Run on (", "CPU Caches:",   "  L1 ",
                                        "  L2 ",    "  L3 ",    "Load Average:", "***WARNING***"};
  const bool is_date = line.size() >= 19 && line[4] == '-' && line[7] == '-' && line[10] == 'T' && line[13] == ':';
  return is_date || std::ranges::any_of(begins, [&](const char* begin) { return line.starts_with(begin); });
}

std::string last_words(const std::string& printed) {
  std::istringstream text(printed);
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);)
    if (!is_banner(line) && line.find_first_not_of(" \t\r") != std::string::npos) lines.push_back(line);
  if (lines.size() > most_lines) lines.erase(lines.begin(), lines.end() - most_lines);
  return bench::joined(lines, " | ");
}

}  // namespace

Command command_from(const std::string& text, const std::string& option) {
  if (fs::exists(text)) return {fs::absolute(text).lexically_normal().string()};
  std::optional<Command> words = words_of(text);
  if (!words) return {"/bin/sh", "-c", text};
  if (words->empty()) throw InputError(option + ": the command is empty", {}, "name a program");
  std::string& program = words->front();
  if (program.find('/') == std::string::npos) {
    const auto found = baselines::find_on_path(program);
    if (found) program = found->string();
  }
  if (!fs::is_regular_file(program))
    throw InputError(option + ": there is no program '" + program + "'", {},
                     "check the path and the spelling, or build it first");
  program = fs::absolute(program).lexically_normal().string();
  return *std::move(words);
}

std::string short_name(const Command& command) {
  if (command.size() == 3 && command.front() == "/bin/sh" && command[1] == "-c") return command.back();
  Command named = command;
  if (!named.empty()) named.front() = fs::path(named.front()).filename().string();
  return baselines::command_line(named);
}

Command command_of(const Programs& programs, const RunRequest& request, const Command& arguments) {
  Command command = request.side == Side::base ? programs.base : programs.head;
  if (programs.rebuilt) command.front() = programs.rebuilt(request.side, request.layout).string();
  command.insert(command.end(), arguments.begin(), arguments.end());
  return command;
}

baselines::ProcessResult try_run(const RunRequest& request, const Command& command, baselines::Limits limits,
                                 const fs::path& folder) {
  if (request.most_seconds > 0) limits.seconds = request.most_seconds;
  return baselines::run_program(
      command,
      {.folder = folder, .environment = {{"CCDT_GATE_PADDING", std::string(request.padding, 'x')}}, .limits = limits});
}

std::string reason_of(const baselines::ProcessResult& ended) {
  // The reason of a process ends with all that it printed.
  std::string reason = ended.reason;
  if (!ended.printed.empty() && reason.ends_with(ended.printed)) reason.resize(reason.size() - ended.printed.size());
  while (reason.ends_with(' ') || reason.ends_with(':')) reason.pop_back();
  if (reason.empty()) reason = "exit code " + std::to_string(ended.exit_code);
  const std::string words = last_words(ended.printed);
  return words.empty() ? reason : reason + ": " + words;
}

void fail(Side side, const Command& command, const std::string& why) {
  throw ProgramFailed(side, why, {.file = command.front()}, baselines::command_line(command));
}

baselines::ProcessResult run(const RunRequest& request, const Command& command, const baselines::Limits& limits,
                             const fs::path& folder) {
  baselines::ProcessResult result = try_run(request, command, limits, folder);
  if (result.status != baselines::RunStatus::ok) fail(request.side, command, reason_of(result));
  return result;
}

}  // namespace ccdt::gate
