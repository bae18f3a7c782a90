#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <vector>

namespace ccdt::baselines {

/// The children of a process, their children, and so on.
std::vector<pid_t> descendants_of(pid_t process);

/// Does the memory of all descendants of a process exceed so many bytes? A page that several of them share counts once.
bool tree_exceeds(pid_t process, std::uint64_t bytes);

/// What the files in a folder and its folders occupy on the disk.
std::uint64_t bytes_in_folder(const std::filesystem::path& folder);

}  // namespace ccdt::baselines
