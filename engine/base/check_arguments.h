#pragma once

#include <algorithm>
#include <cstddef>
#include <string>

#include "engine/base/digits.h"
#include "engine/base/errors.h"

/// What programs that call the library may get wrong. Readers and the command line check it by themselves.
namespace ccdt {

/// The largest number of an argument. Sums and products of these are finite.
inline constexpr double largest_argument = 1e100;

/// \throw InputError  it is not between the two
inline void check_number(const std::string& name, double value, double least = 0, double most = largest_argument) {
  if (value >= least && value <= most) return;  // NaN is not
  throw InputError("the " + name + " is " + digits(value), {},
                   "give a number from " + digits(least) + " to " + digits(most));
}

/// Does every element (a list of indices) only have indices below `count`?
template <class Elements>
bool are_below(std::size_t count, const Elements& elements) {
  return std::ranges::all_of(elements, [&](const auto& indices) {
    return std::ranges::all_of(indices, [&](std::size_t index) { return index < count; });
  });
}

/// Is a list that may be missing empty, or does it have one entry for each element?
template <class Entries, class Elements>
bool is_empty_or_complete(const Entries& entries, const Elements& elements) {
  return entries.empty() || entries.size() == elements.size();
}

}  // namespace ccdt
