#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace ccdt {

/// What a text depends on.
enum class ChoiceCondition {
  interior_points,  ///< is the inside to be refined? (no: `--lattice none`)
  improvement,      ///< is the mesh to be improved? (no: `--improve none`)
  edge_length,      ///< is an edge length asked for? (no: as the surface has it)
  regions           ///< does the input say regions?
};

/// A placeholder of a description's own.
struct Choice {
  std::string name;
  ChoiceCondition condition = ChoiceCondition::interior_points;
  std::string text_if, text_else;  ///< may have placeholders that are no choices
};

/// A mesher that anybody has: how it is called, and which formats it reads and writes. Texts may have placeholders
/// (baselines/placeholders.h).
struct MesherDescription {
  std::filesystem::path file;  ///< where it was read
  std::string name;            ///< in reports: small letters, digits and hyphens
  std::string what;            ///< one line for people
  std::string licence;
  std::string install;  ///< how to get the program; may be empty
  /// The program and its arguments. A program with a slash in its name is found from the folder of the description,
  /// any other on PATH.
  std::vector<std::string> command;
  std::string input_format;                                     ///< poly, smesh, stl, off, obj, ply or mesh
  std::string output;                                           ///< a file with an ending that `read_tet_mesh` knows
  std::vector<std::pair<std::string, std::string>> files = {};  ///< written beside the input: name, text
  std::vector<Choice> choices = {};                             ///< placeholders of its own
  std::vector<std::string> version_command = {};                ///< prints the version; may be empty
  std::string version_pattern = {};                             ///< first group, else all that matches in a line
  std::vector<std::pair<std::string, std::string>> environment = {};  ///< variables beside those of the caller
  std::string seconds_pattern = {};  ///< first group: seconds of meshing; of all lines of the log that match, the sum
  std::vector<int> success_codes = {0};  ///< exit codes
};

/// Reads a description: JSON of schema `ccdt.mesher/1`, reports/ccdt.mesher.1.schema.json.
/// \throw InputError  cannot be read or is wrong; names the file and the JSON pointer
MesherDescription read_mesher_description(const std::filesystem::path& file);

}  // namespace ccdt
