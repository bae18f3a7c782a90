#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <vector>

namespace ccdt::baselines {

/// The children of a process, their children, and so on.
std::vector<pid_t> descendants_of(pid_t process);

/// Does the memory of all descendants of a process exceed this many bytes? A shared page counts once.
bool tree_exceeds(pid_t process, std::uint64_t bytes);

/// The bytes that the files in a folder and its subfolders occupy on the disk.
std::uint64_t bytes_in_folder(const std::filesystem::path& folder);

}  // namespace ccdt::baselines
