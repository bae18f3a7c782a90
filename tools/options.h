#pragma once

#include <CLI/CLI.hpp>
#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/base/enum_names.h"

namespace ccdt::tools {

/// A finite number greater than zero: for lengths and seconds.
CLI::Validator positive_number();
/// A finite number that is not negative.
CLI::Validator non_negative_number();

/// A mesher of this build, or a file that describes another.
CLI::Validator known_mesher();

/// Adds an option whose values are names, in whatever case; --help lists them with what they mean.
///
/// \param target  gets the value; its own is the default, or if that is not among the values, the first of these
/// \param what    the option's meaning
template <class Target, class Value, std::size_t count>
void add_choice(CLI::App& verb, const std::string& option, Target& target,
                const std::array<NamedValue<Value>, count>& values, std::string what) {
  std::vector<std::string> names;
  std::string standard(values.front().name);
  for (const NamedValue<Value>& v : values) {
    names.emplace_back(v.name);
    what += "\n  " + names.back() + ": " + std::string(v.what);
    if (target == v.value) standard = names.back();
  }
  verb.add_option_function<std::string>(
          option,
          [&target, values](const std::string& name) {
            for (const NamedValue<Value>& v : values)
              if (v.name == name) target = v.value;
          },
          what)
      ->transform(CLI::IsMember(names, CLI::ignore_case).description(""))
      ->default_str(standard);
}

template <NamedEnum Enum>
void add_choice(CLI::App& verb, const std::string& option, Enum& target, const std::string& what) {
  add_choice(verb, option, target, names_of(Enum{}), what);
}

/// A line of a list in --help: a name, padded, and what it means.
std::string list_line(std::string name, const std::string& what);

/// Checks, before hours of work, that a file can be written there.
/// \throw OutputError  its folder does not exist or cannot be written to, or the place is a folder
void check_can_be_written(const std::filesystem::path& file);

/// \throw OutputError  writing `output` would overwrite `input`
void check_are_different(const std::filesystem::path& input, const std::filesystem::path& output);

}  // namespace ccdt::tools
