#pragma once

#include <cstdint>
#include <functional>
#include <string_view>

namespace ccdt {

/// Told now and then how far a stage is: its name, what is done, and the total (0 when it cannot be known).
/// An empty function is silence. It may be called often; whoever draws limits the rate.
using Progress = std::function<void(std::string_view stage, std::uint64_t done, std::uint64_t total)>;

inline void report(const Progress& progress, std::string_view stage, std::uint64_t done, std::uint64_t total) {
  if (progress) progress(stage, done, total);
}

}  // namespace ccdt
