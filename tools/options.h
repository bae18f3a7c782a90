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
/// A number from the least to the most, both included; not NaN.
CLI::Validator number_between(double least, double most);
/// A whole number from the least to the most, both included.
CLI::Validator whole_number(int least, int most);

/// One of these names. Shells complete them.
CLI::Validator one_of(const std::vector<std::string>& names, bool ignore_case = false);

/// The names that the option accepts; empty if no `one_of` checks it.
std::vector<std::string> choices_of(CLI::Option& option);

/// A mesher of this build, or a file that describes another.
CLI::Validator known_mesher();

/// Adds an option whose values are names, in upper or lower case; --help lists them with their meanings.
///
/// \param target  gets the value; the default is its own value, or the first one if that is not among the values
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
      ->transform(one_of(names, true))
      ->default_str(standard);
}

template <NamedEnum Enum>
void add_choice(CLI::App& verb, const std::string& option, Enum& target, const std::string& what) {
  add_choice(verb, option, target, names_of(Enum{}), what);
}

/// Adds --threads. \param threads  gets their number; 0, which stands for all cores, is the default
void add_threads(CLI::App& verb, unsigned& threads);

/// A line of a list in --help: a padded name and its meaning.
std::string list_line(std::string name, const std::string& what);

/// Checks, before hours of work, that the file can be written.
/// \throw OutputError  its folder does not exist or is not writable, or the path is a folder
void check_can_be_written(const std::filesystem::path& file);

/// \throw OutputError  writing `output` would overwrite `input`
void check_are_different(const std::filesystem::path& input, const std::filesystem::path& output);

}  // namespace ccdt::tools
