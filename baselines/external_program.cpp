#include "baselines/external_program.h"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <deque>
#include <fstream>
#include <regex>
#include <sstream>
#include <system_error>

#include "baselines/process.h"
#include "engine/io/output_folder.h"

namespace ccdt::baselines {
namespace {

constexpr std::size_t most_last_lines = 5;
constexpr double most_seconds_for_version = 10;
/// The regex library matches recursively, so a very long line would overflow the stack.
constexpr std::size_t longest_line = 1000;

bool can_be_executed(const std::filesystem::path& file) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(file, ignored) && access(file.c_str(), X_OK) == 0;
}

/// Calls `visit` with each line that is not empty, shortened, until it returns true.
template <class Visit>
void visit_lines(std::istream& lines, Visit visit) {
  for (std::string line; std::getline(lines, line);) {
    line.resize(std::min(line.size(), longest_line));
    const auto last = line.find_last_not_of(" \t\r");
    if (last == std::string::npos) continue;
    line.resize(last + 1);
    if (visit(line)) return;
  }
}

/// The first group, or the whole match if there is no group.
std::string matched(const std::smatch& match) {
  return match.size() > 1 ? match[1].str() : match[0].str();
}

}  // namespace

std::optional<std::filesystem::path> find_program(const std::string& name, const char* environment_variable) {
  const char* file = std::getenv(environment_variable);
  if (file != nullptr && *file != '\0')
    return can_be_executed(file) ? std::optional<std::filesystem::path>(file) : std::nullopt;
  return find_on_path(name);
}

std::optional<std::filesystem::path> find_on_path(const std::string& name) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "" : path);
  for (std::string folder; std::getline(folders, folder, ':');) {
    const auto file = std::filesystem::path(folder) / name;
    if (can_be_executed(file)) return file;
  }
  return std::nullopt;
}

std::string version_of_program(const std::vector<std::string>& command, const std::string& pattern) {
  const TemporaryFolder folder;
  const auto log = folder.path() / "log";
  // Some programs print their version and end with an error; others wait for input.
  run_program(command, {.log = log, .limits = Limits{.seconds = most_seconds_for_version}});
  return first_in_log(log, pattern.empty() ? "^.*$" : pattern).value_or(unknown_version);
}

std::string last_lines(std::istream& log) {
  std::deque<std::string> last;
  visit_lines(log, [&](const std::string& line) {
    last.push_back(line);
    if (last.size() > most_last_lines) last.pop_front();
    return false;
  });
  std::string joined;
  for (const std::string& line : last) joined += (joined.empty() ? "" : " | ") + line;
  return joined;
}

std::string last_lines(const std::filesystem::path& log) {
  std::ifstream lines(log);
  return last_lines(lines);
}

std::optional<std::string> first_in_log(const std::filesystem::path& log, const std::string& pattern) {
  const std::regex expression(pattern);
  std::optional<std::string> first;
  std::ifstream lines(log);
  visit_lines(lines, [&](const std::string& line) {
    std::smatch match;
    if (std::regex_search(line, match, expression)) first = matched(match);
    return first.has_value();
  });
  return first;
}

std::optional<double> sum_in_log(const std::filesystem::path& log, const std::string& pattern) {
  const std::regex expression(pattern);
  std::optional<double> sum;
  std::ifstream lines(log);
  visit_lines(lines, [&](const std::string& line) {
    std::smatch match;
    if (std::regex_search(line, match, expression))
      sum = sum.value_or(0) + std::strtod(matched(match).c_str(), nullptr);
    return false;
  });
  return sum;
}

TemporaryFolder::TemporaryFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "ccdt-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr)
    throw std::system_error(errno, std::generic_category(), "cannot make a temporary folder");
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  io::remove_if_possible(path_);
}

}  // namespace ccdt::baselines
