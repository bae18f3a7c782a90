#include <set>
#include <sstream>

#include "baselines/mesher_options.h"
#include "tools/tests/program.h"

namespace ccdt {
namespace {

/// The options that --help of `ccdt mesh` lists: "--lattice" as "lattice".
std::set<std::string> options_in(const std::string& help) {
  std::set<std::string> names;
  std::istringstream words(help);
  for (std::string line; std::getline(words, line);) {
    const auto begin = line.find_first_not_of(' ');
    const auto dashes = line.find("--");
    if (begin > 4 || dashes == std::string::npos || line[begin] != '-') continue;
    names.insert(line.substr(dashes + 2, line.find_first_of(" ,", dashes) - dashes - 2));
  }
  return names;
}

TEST_F(Program, MeshHasTheOptionsWhoseEffectsAreKnown) {
  std::set<std::string> listed = options_in(run("mesh --help").out);
  for (const char* no_effect : {"help", "output", "surface-output", "report", "mesher"})
    EXPECT_EQ(listed.erase(no_effect), 1u) << no_effect;
  std::set<std::string> known;
  for (const auto& [name, usual] : baselines::usual_options()) known.insert(name);
  EXPECT_EQ(listed, known);
}

}  // namespace
}  // namespace ccdt
