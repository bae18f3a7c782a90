#pragma once

#include <filesystem>
#include <string>

/// Names of files in documents that anyone may have written. What is made from a folder reads and writes only there.
namespace ccdt::bench {

/// \throw std::invalid_argument  the name has other characters than letters, digits, '.', '-' and '_', or begins with a
///                               dot
void check_file_name(const std::string& name);

/// \throw std::invalid_argument  the path has a part that is no such name: it is absolute, or leads upward
void check_file_path(const std::string& path);

/// A file by its name relative to the folder if it is inside, so that the folder can be moved; otherwise by its full
/// path.
std::string name_in(const std::filesystem::path& folder, const std::filesystem::path& file);

}  // namespace ccdt::bench
