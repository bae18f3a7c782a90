#pragma once

#include <cstdint>
#include <functional>
#include <string_view>

namespace ccdt {

/// Called now and then with the progress of a stage: its name, what is done, and the total (0 if it is not known).
/// May be empty. It may be called often: a function that draws should limit its rate. It may throw, which cancels the
/// work: the exception ends the stage and reaches the caller, and nothing is leaked.
using Progress = std::function<void(std::string_view stage, std::uint64_t done, std::uint64_t total)>;

inline void report(const Progress& progress, std::string_view stage, std::uint64_t done, std::uint64_t total) {
  if (progress) progress(stage, done, total);
}

}  // namespace ccdt
