#pragma once

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstddef>
#include <fstream>

#include "engine/tests/shared/sanitized.h"

namespace ccdt {

/// While it lives, this process cannot allocate much more memory than it has. Sanitizers reserve terabytes, so with
/// them there is no limit.
class LittleMemory {
 public:
  explicit LittleMemory(std::size_t bytes) {
    if (is_sanitized) return;
    std::size_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    getrlimit(RLIMIT_AS, &before_);
    const rlimit little{pages * static_cast<std::size_t>(::getpagesize()) + bytes, before_.rlim_max};
    EXPECT_EQ(setrlimit(RLIMIT_AS, &little), 0);
  }
  ~LittleMemory() {
    if (!is_sanitized) setrlimit(RLIMIT_AS, &before_);
  }
  LittleMemory(const LittleMemory&) = delete;
  LittleMemory& operator=(const LittleMemory&) = delete;

 private:
  rlimit before_{};
};

}  // namespace ccdt
