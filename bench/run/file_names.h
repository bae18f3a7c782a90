#pragma once

#include <filesystem>
#include <string>

/// File names in documents from untrusted sources. They must not lead to reads or writes outside the document's folder.
namespace ccdt::bench {

/// \throw std::invalid_argument  the name begins with a dot, or has characters other than letters, digits, '.', '-'
///                               and '_'
void check_file_name(const std::string& name);

/// \throw std::invalid_argument  a part of the path is not such a name; so the path may not be absolute or lead upward
void check_file_path(const std::string& path);

/// The path of a file: relative to the folder if the file is inside, so that the folder can be moved; otherwise the
/// full path.
std::string name_in(const std::filesystem::path& folder, const std::filesystem::path& file);

}  // namespace ccdt::bench
