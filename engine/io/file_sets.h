#pragma once

#include <filesystem>
#include <vector>

namespace ccdt::io {

/// The files that `read_plc` reads if it is given this one: itself and, if it is a .poly or .smesh without vertices,
/// the .node beside it. They need not exist.
std::vector<std::filesystem::path> files_of_plc(const std::filesystem::path& file);

/// The files that `read_sizes` reads if it is given this one: itself and its background, if there is one.
std::vector<std::filesystem::path> files_of_sizes(const std::filesystem::path& file);

}  // namespace ccdt::io
