#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/enum_names.h"
#include "engine/options/option_table.h"

namespace ccdt::tools {

/// A finite number greater than zero: for lengths and seconds.
CLI::Validator positive_number();
/// A finite number that is not negative.
CLI::Validator non_negative_number();
/// A number from `least` to `most`, inclusive; not NaN.
CLI::Validator number_between(double least, double most);
/// A whole number from `least` to `most`, inclusive.
CLI::Validator whole_number(int least, int most);

/// One of these names. Shells complete them.
CLI::Validator one_of(const std::vector<std::string>& names, bool ignore_case = false);

/// The names that the option accepts; empty if no `one_of` checks it.
std::vector<std::string> choices_of(CLI::Option& option);

/// A mesher of this build, or a file that describes another.
CLI::Validator known_mesher();

/// Adds an option whose values are names, in upper or lower case; --help lists them with their meanings.
///
/// \param set       gets the name that was chosen
/// \param standard  the default
/// \param what      the option's meaning
void add_choice(CLI::App& verb, const std::string& option, const std::vector<options::ChoiceKind::Name>& names,
                const std::function<void(const std::string&)>& set, std::string_view standard, std::string what);

/// The same for an enumeration; the default is its value.
template <NamedEnum Enum>
void add_choice(CLI::App& verb, const std::string& option, Enum& target, const std::string& what) {
  std::vector<options::ChoiceKind::Name> names;
  for (const NamedValue<Enum>& value : names_of(Enum{})) names.push_back({value.name, value.what});
  add_choice(
      verb, option, names, [&target](const std::string& name) { target = value_of<Enum>(name).value_or(target); },
      name_of(target), what);
}

/// Adds an option of the table. \param options  get the value, and have the default
void add_mesh_option(CLI::App& verb, const options::MeshOption& option, MeshOptions& options);

/// Adds --threads. \param threads  gets their number; 0, which stands for all cores, is the default
void add_threads(CLI::App& verb, unsigned& threads);

/// Adds --quiet, which is the same in all verbs that have it.
void add_quiet(CLI::App& verb);

/// A line of a list in --help: a padded name and its meaning.
std::string list_line(std::string name, const std::string& what);

/// Adds --report, and --json for a report on standard output.
///
/// \param what    the help of --report
/// \param report  `-`: standard output
void add_report(CLI::App& verb, const std::string& what, std::string& report);

/// What `read_plc` reads, for --help.
inline constexpr const char* read_plc_endings =
    ".stl .off .obj .ply .poly .smesh .node .mesh .meshb .msh .vtu .vtp, also with .gz; by Gmsh .step .stp .iges .igs "
    ".brep; - is standard input";

/// Checks, before hours of work, that the file can be written.
/// \throw OutputError  its folder does not exist or is not writable, or the path is a folder
void check_can_be_written(const std::filesystem::path& file);

/// The same for a name that may also be that of a folder.
/// \throw OutputError  the folder that it is in does not exist or is not writable
void check_folder_can_be_written(const std::filesystem::path& file);

/// \throw OutputError  writing `output` would overwrite `input`
void check_are_different(const std::filesystem::path& input, const std::filesystem::path& output);

}  // namespace ccdt::tools
