#include "reports/experiment_parts.h"

#include "reports/numbers.h"

namespace ccdt {
namespace {

std::string machine(const Environment& e) {
  std::string text = e.cpu + ", " + std::to_string(e.cores) + " cores, load " + rounded(e.load_average, 2) + "; " +
                     e.system + "; " + e.compiler + " " + e.flags + "; revision " + e.revision;
  for (const auto& [name, version] : e.libraries) text.append("; ").append(name).append(" ").append(version);
  return text;
}

}  // namespace

std::string how_measured(const Circumstances& how) {
  return "Medians of " + std::to_string(how.runs) + " runs in turn after one that is not counted, with " +
         rounded(100 * Bootstrap{}.confidence, 2) + "% bootstrap intervals.";
}

std::string section(const std::string& title, const std::vector<std::string>& lines) {
  if (lines.empty()) return "";
  std::string text = "## " + title + "\n\n";
  for (const std::string& line : lines) text += "- " + line + "\n";
  return text + "\n";
}

std::string terminal_section(const std::string& title, const std::vector<std::string>& lines) {
  if (lines.empty()) return "";
  std::string text = title + "\n";
  for (const std::string& line : lines) text += "  " + line + "\n";
  return text + "\n";
}

std::string closing_sections(const std::vector<std::string>& definitions, const Circumstances& how) {
  return section("What the rows mean", definitions) + "## The machine\n\n" + machine(how.environment) + "\n";
}

std::string claim_words(Claim claim) {
  switch (claim) {
    case Claim::holds:
      return "holds";
    case Claim::undecided:
      return "undecided, the bound is within the interval";
    case Claim::fails:
      return "does not hold";
  }
  return "";
}

}  // namespace ccdt
