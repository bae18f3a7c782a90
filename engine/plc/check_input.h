#pragma once

#include "engine/plc/input.h"

namespace ccdt::plc {

/// Checks the invariants of an input. Readers ensure them, but other callers of the library may not.
///
/// \throw InputError  an index is out of range; a list of markers or numbers is neither empty nor complete; a seed has
///                    a coordinate that is not finite
void check_input(const InputPlc& input);

}  // namespace ccdt::plc
