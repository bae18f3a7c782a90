#pragma once

#include <filesystem>

namespace ccdt {

/// Where the files are that come with the program, such as the page of a report: `share/ccdt` beside the program, as in
/// a build, or beside the folder that the program is in, as when it is installed.
std::filesystem::path share_folder();

/// The file of the running program.
std::filesystem::path own_program();

}  // namespace ccdt
