#pragma once

#include <optional>

#include "bench/results/result_table.h"

namespace ccdt {

inline Cell cell_of(const std::optional<Estimate>& estimate) {
  return estimate ? Cell(*estimate) : Cell();
}

inline Cell cell_of(const std::optional<double>& number) {
  return number ? Cell(*number) : Cell();
}

inline Cell cell_of(std::uint64_t count) {
  return static_cast<double>(count);
}

inline Cell cell_of(bool holds) {
  return std::string(holds ? "yes" : "no");
}

inline Cell cell_of(std::string_view text) {
  return std::string(text);
}

}  // namespace ccdt
