#pragma once

#include <string>

/// Names of files in documents that anyone may have written. What is made from a folder reads and writes only there.
namespace ccdt::bench {

/// \throw std::invalid_argument  the name has other characters than letters, digits, '.', '-' and '_', or begins with a
///                               dot
void check_file_name(const std::string& name);

/// \throw std::invalid_argument  the path has a part that is no such name: it is absolute, or leads upward
void check_file_path(const std::string& path);

}  // namespace ccdt::bench
