#pragma once

#include "engine/options/mesh_options.h"

namespace ccdt::options {

/// \throw InputError  a number is not finite or out of its range, a strategy has no name, or the background is not one
void check_options(const MeshOptions& options);

}  // namespace ccdt::options
