#pragma once

#include <cstdio>
#include <cstdlib>
#include <string_view>

/// The switch of the mutations that `studies/mutation/run` writes into a copy of the source; only they use it.
namespace ccdt_mutations {

/// Leaves a file, to tell whether a surviving mutation was reached. One that was never reached needs a different test.
inline bool note_reached() {
  if (const char* name = std::getenv("CCDT_MUTATION_REACHED"))
    if (std::FILE* file = std::fopen(name, "w")) std::fclose(file);
  return true;
}

/// Does the environment variable CCDT_MUTATION name this mutation?
inline bool is_on(std::string_view mutation) {
  static const char* const variable = std::getenv("CCDT_MUTATION");
  static const std::string_view selected = variable != nullptr ? variable : "";
  if (mutation != selected) return false;
  static const bool reached = note_reached();
  return reached;
}

}  // namespace ccdt_mutations
