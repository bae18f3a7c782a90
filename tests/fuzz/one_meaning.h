#pragma once

#include <string>

#include "engine/plc/input.h"

namespace ccdt::fuzz {

/// What check, mesh, verify and repair make of an input.
struct Meaning {
  bool is_valid = false;          ///< for the check
  bool is_copy_valid = false;     ///< of the repaired copy, for the check
  bool is_refused = false;        ///< the repair wrote no copy, because of its limits
  std::string disagreement = {};  ///< about the input; empty if they agree
  std::string about_copy = {};    ///< about the repaired copy of an input that is not valid
};

/// Do all four mean the same? An input that the check calls valid is meshed, the mesh is right, and the repair leaves
/// its volume. One that it calls invalid is refused by the mesher. A valid copy is meshed, its mesh is right, and
/// another repair changes nothing.
Meaning find_meaning(const plc::InputPlc& input);

}  // namespace ccdt::fuzz
