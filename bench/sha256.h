#pragma once

#include <filesystem>
#include <string>

namespace ccdt {

/// SHA-256 of a file's bytes, 64 lowercase hexadecimal digits; empty if the file cannot be read.
std::string sha256_of_file(const std::filesystem::path& file);

}  // namespace ccdt
