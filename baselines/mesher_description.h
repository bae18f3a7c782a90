#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/base/enum_names.h"

namespace ccdt::baselines {

/// The condition that the text of a choice depends on.
enum class ChoiceCondition { interior_points, improvement, edge_length, regions };

constexpr auto names_of(ChoiceCondition) {
  return std::to_array<NamedValue<ChoiceCondition>>(
      {{ChoiceCondition::interior_points, "interior_points", "are interior points wanted? (no: --lattice none)"},
       {ChoiceCondition::improvement, "improvement", "is improvement wanted? (no: --improve none)"},
       {ChoiceCondition::edge_length, "edge_length", "is an edge length given? (no: that of the surface)"},
       {ChoiceCondition::regions, "regions", "does the input name regions?"}});
}

/// A placeholder that a description defines itself.
struct Choice {
  std::string name;
  ChoiceCondition condition = ChoiceCondition::interior_points;
  std::string text_if, text_else;  ///< may have placeholders, except choices
};

/// How to call a user's mesher, and which formats it reads and writes. Texts may contain placeholders.
struct MesherDescription {
  std::filesystem::path file;  ///< where it was read
  std::string name;            ///< in reports: small letters, digits and hyphens
  std::string what;            ///< one line for people
  std::string license;
  std::string install;  ///< how to get the program; may be empty
  /// The program and its arguments. A program with a slash in its name is found from the folder of the description,
  /// any other on PATH.
  std::vector<std::string> command;
  std::string input_format;                                     ///< poly, smesh, stl, off, obj, ply or mesh
  std::string output;                                           ///< a file with an extension that `read_tet_mesh` knows
  std::vector<std::pair<std::string, std::string>> files = {};  ///< written beside the input: name, text
  std::vector<Choice> choices = {};                             ///< its own placeholders
  std::vector<std::string> version_command = {};                ///< prints the version; may be empty
  std::string version_pattern = {};                             ///< first group, or the whole match
  std::vector<std::pair<std::string, std::string>> environment = {};  ///< variables in addition to those of the caller
  std::string seconds_pattern = {};      ///< first group: seconds of meshing, summed over all matching lines of the log
  std::vector<int> success_codes = {0};  ///< exit codes
  bool keeps_surface = true;             ///< see `Mesher`
};

/// Reads a description: JSON of schema `ccdt.mesher/1`, ccdt.mesher.1.schema.json in this folder.
/// \throw InputError  it cannot be read or is wrong; names the file and the JSON pointer
MesherDescription read_mesher_description(const std::filesystem::path& file);

/// The folder of the description, which {here} stands for.
std::string folder_of(const MesherDescription& description);

/// All texts of a description that reach the program, with their placeholders; those of `choices` are not among them.
std::vector<std::string> texts_of(const MesherDescription& description);

/// The existing files that the texts and choices of a description name by full paths, which begin with {here} or a
/// slash; sorted by name. The program itself is included only if it is named in this way.
std::vector<std::filesystem::path> files_named_in(const MesherDescription& description);

/// The placeholders in the texts of a description, written in braces: "{input}". A name consists of small letters and
/// underscores. Anything else in braces stays as it is, so scripts may use braces.
///
/// | name          | stands for                                                                                 |
/// |---------------|--------------------------------------------------------------------------------------------|
/// | `input`       | the file with the input; the program runs in the folder where it is                        |
/// | `stem`        | its name without the extension                                                             |
/// | `folder`      | that folder, which nothing else uses                                                       |
/// | `here`        | the folder of the description                                                              |
/// | `edge_length` | the target edge length, in the units of the input                                          |
/// | `max_volume`  | the largest tetrahedron of a mesh of such edges: twice the volume of the regular one,      |
/// |               | which is about the average                                                                 |
///
/// and the `choices` of the description.
struct Placeholder {
  std::string name, value;
};

/// The names in a text, in order.
std::vector<std::string> placeholders_in(std::string_view text);

/// The text with placeholders replaced by values; unknown ones stay.
std::string fill_placeholders(std::string_view text, const std::vector<Placeholder>& values);

}  // namespace ccdt::baselines
