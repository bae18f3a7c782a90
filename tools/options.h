#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>

namespace ccdt {

/// A finite number greater than zero: for lengths and seconds.
CLI::Validator positive_number();
/// A finite number that is not negative.
CLI::Validator non_negative_number();

/// A mesher of this build, or a file that describes another.
CLI::Validator known_mesher();

/// Checks, before hours of work, that a file can be written there.
/// \throw OutputError  its folder does not exist or cannot be written to, or the place is a folder
void check_can_be_written(const std::filesystem::path& file);

/// \throw OutputError  writing `output` would overwrite `input`
void check_are_different(const std::filesystem::path& input, const std::filesystem::path& output);

}  // namespace ccdt
