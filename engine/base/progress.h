#pragma once

#include <cstdint>
#include <functional>
#include <string_view>

namespace ccdt {

/// Called repeatedly with the progress of a stage: its name, the amount done, and the total (0 if unknown). The stage
/// "estimate" does nothing; its amount is about how many tetrahedra there will be. May be empty. It may be called
/// often, so a function that draws should limit its rate. It may throw to cancel the work: the exception ends the stage
/// and reaches the caller, and nothing is leaked.
using Progress = std::function<void(std::string_view stage, std::uint64_t done, std::uint64_t total)>;

inline void report(const Progress& progress, std::string_view stage, std::uint64_t done, std::uint64_t total) {
  if (progress) progress(stage, done, total);
}

}  // namespace ccdt
