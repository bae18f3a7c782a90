#pragma once

#include <cstdint>

namespace ccdt {

/// An undirected edge as one number, for tables.
constexpr std::uint64_t edge_key(std::uint32_t a, std::uint32_t b) {
  return a < b ? std::uint64_t{a} << 32 | b : std::uint64_t{b} << 32 | a;
}

}  // namespace ccdt
