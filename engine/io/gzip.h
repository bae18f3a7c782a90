#pragma once

#include <filesystem>

#include "engine/io/files.h"

namespace ccdt::io {

/// Is this the name of a file compressed by gzip, such as part.stl.gz?
bool is_gzip_name(const std::filesystem::path& file);

/// The name without .gz, if it has that.
std::filesystem::path without_gzip(const std::filesystem::path& file);

/// Reads a whole file, which is inflated if its name ends in .gz.
///
/// \throw InputError  as `read_whole_file`; or damaged, or more than `largest_inflation` times as large when inflated
FileBytes read_inflated_file(const std::filesystem::path& file);

/// Text of coordinates becomes 3 to 50 times smaller. More is in files that were made to fill the memory.
inline constexpr std::size_t largest_inflation = 100;

}  // namespace ccdt::io
