#pragma once

#include <cstdint>
#include <string_view>

#include "studies/gate/layouts/kernels/slowdown.h"

namespace kernels {

/// How often a kernel does the same work in an iteration: more often in the one that is slowed down.
inline int passes_of(std::string_view kernel) {
  constexpr int usual = 20;
  return kernel == slow_kernel ? usual + static_cast<int>(usual * slowdown + 0.5) : usual;
}

/// Numbers that are the same on every machine (splitmix64; Steele, Lea and Flood 2014).
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  std::uint64_t operator()() {
    std::uint64_t z = state_ += 0x9e3779b97f4a7c15;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return z ^ (z >> 31);
  }

  /// A number in [0, count).
  int below(int count) { return static_cast<int>(((*this)() >> 32) * static_cast<std::uint64_t>(count) >> 32); }

 private:
  std::uint64_t state_;
};

}  // namespace kernels
