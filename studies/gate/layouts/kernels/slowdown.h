#pragma once

#include <string_view>

namespace kernels {

/// The benchmark that does more work, and how much more: a share that is a multiple of 0.05. `layouts.py` writes other
/// values into its copies.
inline constexpr std::string_view slow_kernel = "tokenizer";
inline constexpr double slowdown = 0;

}  // namespace kernels
