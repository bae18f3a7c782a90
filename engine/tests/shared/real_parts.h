#pragma once

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <vector>

#include "engine/io/plc_files.h"

namespace ccdt {

/// The folder that an environment variable names, or one beside the checkout.
inline std::filesystem::path shared_folder(const char* variable, const char* name) {
  const char* told = std::getenv(variable);
  return told ? std::filesystem::path(told) : std::filesystem::path(CCDT_SOURCE_DIR) / ".." / "shared" / name;
}

/// Real surfaces, if there are any: the folder of the variable CCDT_PARTS, or one beside the checkout.
inline std::filesystem::path folder_of_parts() {
  return shared_folder("CCDT_PARTS", "parts");
}

/// Surfaces that once made the engine fail: the folder of the variable CCDT_HARD_PARTS, or one beside the checkout.
inline std::filesystem::path folder_of_hard_parts() {
  return shared_folder("CCDT_HARD_PARTS", "hard");
}

inline bool there_are_parts() {
  return std::filesystem::is_directory(folder_of_parts());
}

/// The surfaces in a folder, sorted by name; none if there is no such folder.
inline std::vector<std::filesystem::path> surfaces_in(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  if (!std::filesystem::is_directory(folder)) return files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (io::is_plc_file(entry.path())) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

/// All surfaces of `folder_of_parts`, sorted by name.
inline std::vector<std::filesystem::path> real_parts() {
  return surfaces_in(folder_of_parts());
}

}  // namespace ccdt
