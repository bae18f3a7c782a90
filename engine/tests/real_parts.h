#pragma once

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <vector>

namespace ccdt {

/// Where real surfaces are, if there are any: the folder of the variable CCDT_PARTS, or one beside the checkout.
inline std::filesystem::path folder_of_parts() {
  const char* told = std::getenv("CCDT_PARTS");
  return told ? std::filesystem::path(told) : std::filesystem::path(CCDT_SOURCE_DIR) / ".." / "shared" / "parts";
}

inline bool there_are_parts() {
  return std::filesystem::is_directory(folder_of_parts());
}

/// All of them, by name.
inline std::vector<std::filesystem::path> real_parts() {
  std::vector<std::filesystem::path> files;
  if (!there_are_parts()) return files;
  for (const auto& entry : std::filesystem::directory_iterator(folder_of_parts()))
    if (entry.path().extension() == ".off") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace ccdt
