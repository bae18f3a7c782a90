#include "baselines/program_log.h"

#include <cstdlib>
#include <deque>
#include <fstream>
#include <regex>

namespace ccdt {
namespace {

constexpr std::size_t most_last_lines = 5;
/// The library matches by recursion: a line of megabytes would overflow the stack.
constexpr std::size_t longest_line = 1000;

/// Calls `visit` with each line that is not empty, shortened, until it returns true.
template <class Visit>
void visit_lines(const std::filesystem::path& log, Visit visit) {
  std::ifstream lines(log);
  for (std::string line; std::getline(lines, line);) {
    line.resize(std::min(line.size(), longest_line));
    const auto last = line.find_last_not_of(" \t\r");
    if (last == std::string::npos) continue;
    line.resize(last + 1);
    if (visit(line)) return;
  }
}

/// The first group, or where there is none all of the match.
std::string matched(const std::smatch& match) {
  return match.size() > 1 ? match[1].str() : match[0].str();
}

}  // namespace

std::string last_words(const std::filesystem::path& log) {
  std::deque<std::string> last;
  visit_lines(log, [&](const std::string& line) {
    last.push_back(line);
    if (last.size() > most_last_lines) last.pop_front();
    return false;
  });
  std::string words;
  for (const std::string& line : last) words += (words.empty() ? "" : " | ") + line;
  return words;
}

std::optional<double> sum_in_log(const std::filesystem::path& log, const std::string& pattern) {
  const std::regex expression(pattern);
  std::optional<double> sum;
  visit_lines(log, [&](const std::string& line) {
    std::smatch match;
    if (std::regex_search(line, match, expression))
      sum = sum.value_or(0) + std::strtod(matched(match).c_str(), nullptr);
    return false;
  });
  return sum;
}

std::string version_of_program(const std::vector<std::string>& command, const std::string& pattern,
                               const ProgramSurroundings& surroundings) {
  const TemporaryFolder folder;
  const auto log = folder.path() / "log";
  run_program(command, log, surroundings);  // some end with an error although they have said it
  const std::regex expression(pattern.empty() ? "^.*$" : pattern);
  std::string version = unknown_version;
  visit_lines(log, [&](const std::string& line) {
    std::smatch match;
    if (!std::regex_search(line, match, expression)) return false;
    version = matched(match);
    return true;
  });
  return version;
}

}  // namespace ccdt
