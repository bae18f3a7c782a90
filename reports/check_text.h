#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "engine/repair/faults.h"
#include "engine/repair/repair_input.h"

namespace ccdt::reports {

/// What `ccdt check` found in a file, and what it did about it.
struct CheckReport {
  std::string input;
  repair::Diagnosis diagnosis = {};
  /// A repaired copy.
  struct Copy {
    std::string output;  ///< empty: nothing was written, because a limit forbade it
    std::vector<repair::RepairStep> steps = {};
    repair::Certificate certificate = {};
    std::vector<std::string> refused = {};
    bool is_out_of_time = false;
    repair::Diagnosis diagnosis = {};  ///< of the file as it was written
  };
  std::optional<Copy> copy = {};
};

/// A line for each kind of fault, with the first places below it. Coordinates and numbers of facets are those of the
/// file.
///
/// \param most_places  of each kind of fault
std::string to_terminal(const repair::Diagnosis& diagnosis, std::size_t most_places);

/// A line for each step, and what they did to the surface.
std::string to_terminal(const CheckReport::Copy& copy);

/// How a repaired surface differs from the given one, in a line.
std::string in_few_words(const repair::Certificate& certificate);

/// A verdict in a few words: what a valid input encloses, or how many kinds of errors there are.
std::string in_few_words(const repair::Diagnosis& diagnosis);

/// As JSON of schema `ccdt.check/1`.
std::string to_json(const CheckReport& report);

}  // namespace ccdt::reports
