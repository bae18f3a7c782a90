#pragma once

#include <array>

#include "engine/base/enum_names.h"

namespace ccdt::protection {

/// Where to split a missing segment.
enum class Protection { shell, midpoint };

constexpr auto names_of(Protection) {
  return std::to_array<NamedValue<Protection>>(
      {{Protection::shell, "shell", "on spheres around small angles, so that splitting ends"},
       {Protection::midpoint, "midpoint", "at the midpoint, as in the paper"}});
}

}  // namespace ccdt::protection
