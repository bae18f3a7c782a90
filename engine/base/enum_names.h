#pragma once

#include <optional>
#include <string_view>

namespace ccdt {

/// A value of an enumeration with its name on the command line and in JSON, and what it means.
///
/// For each enumeration `E` with such names, the function `names_of(E)` returns an array of these, in the order of help
/// texts.
template <class Enum>
struct NamedValue {
  Enum value;
  std::string_view name;
  std::string_view what = {};
};

template <class Enum>
concept NamedEnum = requires {
  names_of(Enum{});
};

/// The name of a value; empty for a value without one.
template <NamedEnum Enum>
constexpr std::string_view name_of(Enum value) {
  for (const NamedValue<Enum>& n : names_of(Enum{}))
    if (n.value == value) return n.name;
  return {};
}

/// The value of this name, if there is one.
template <NamedEnum Enum>
constexpr std::optional<Enum> value_of(std::string_view name) {
  for (const NamedValue<Enum>& n : names_of(Enum{}))
    if (n.name == name) return n.value;
  return {};
}

}  // namespace ccdt
