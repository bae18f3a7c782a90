#include "bench/verify/print.h"

#include <algorithm>
#include <cstdio>

namespace ccdt {

namespace {

std::string line_of(const Check& check, std::size_t width) {
  const char* verdict = check.failed == 0 ? "ok" : check.required ? "FAILED" : "note";
  char counts[96];
  std::snprintf(counts, sizeof counts, "%12llu checked %10llu failed", static_cast<unsigned long long>(check.checked),
                static_cast<unsigned long long>(check.failed));
  std::string line(verdict);
  line.resize(8, ' ');
  line += check.name;
  line.resize(8 + width, ' ');
  return line + counts;
}

}  // namespace

std::vector<std::string> describe(const Verification& verification) {
  std::size_t width = 0;
  for (const Check& check : verification.checks) width = std::max(width, check.name.size());
  std::vector<std::string> lines;
  for (const Check& check : verification.checks) {
    lines.push_back(line_of(check, width));
    for (const std::string& example : check.examples) lines.push_back("          " + example);
    if (check.failed > check.examples.size() && !check.examples.empty())
      lines.push_back("          and " + std::to_string(check.failed - check.examples.size()) + " more");
  }
  char volumes[128];
  std::snprintf(volumes, sizeof volumes, "volume of the mesh %.15g, of the input %.15g", verification.mesh_volume,
                verification.input_volume);
  lines.push_back(volumes);
  lines.push_back(verification.ok() ? "the mesh is right" : "the mesh is WRONG");
  return lines;
}

}  // namespace ccdt
