#pragma once

#include <filesystem>

#include "engine/sizes/local_sizes.h"

namespace ccdt::baselines {

/// Reads a size field (JSON, schema `ccdt.sizefield/1`).
///
/// \throw InputError  the file cannot be read or is not one; names the place, and says what to write there
sizes::LocalSizes read_size_field(const std::filesystem::path& file);

}  // namespace ccdt::baselines
