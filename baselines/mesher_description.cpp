#include "baselines/mesher_description.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <regex>
#include <string_view>

#include "baselines/placeholders.h"
#include "engine/io/file_bytes.h"
#include "engine/io/tet_mesh_files.h"

namespace ccdt {
namespace {

using Json = nlohmann::ordered_json;
using Pointer = Json::json_pointer;

constexpr const char* schema_name = "ccdt.mesher/1";
constexpr const char* remedy =
    "reports/ccdt.mesher.1.schema.json says what may be there; baselines/described has examples";

constexpr std::array<const char*, 16> known_members = {
    "$schema",         "schema",       "name",  "what",    "licence",         "install",         "command",
    "input_format",    "output",       "files", "choices", "version_command", "version_pattern", "environment",
    "seconds_pattern", "success_codes"};
constexpr std::array<const char*, 7> known_formats = {"poly", "smesh", "stl", "off", "obj", "ply", "mesh"};
constexpr std::array<std::pair<const char*, ChoiceCondition>, 4> conditions = {
    {{"interior_points", ChoiceCondition::interior_points},
     {"improvement", ChoiceCondition::improvement},
     {"edge_length", ChoiceCondition::edge_length},
     {"regions", ChoiceCondition::regions}}};

/// Something of the description, and where it is.
struct Part {
  const Json& value;
  Pointer pointer;
  const std::string& file;

  Part operator[](const std::string& name) const { return {value.at(name), pointer / name, file}; }
  Part operator[](std::size_t index) const { return {value.at(index), pointer / index, file}; }
  bool has(const std::string& name) const { return value.contains(name); }
};

[[noreturn]] void fail(const Part& part, const std::string& what) {
  const std::string pointer = part.pointer.to_string();
  throw InputError((pointer.empty() ? "" : pointer + ": ") + what, io::place_in(part.file), remedy);
}

template <class Names>
std::string list_of(const Names& names) {
  std::string list;
  for (const auto& name : names) list += (list.empty() ? "" : ", ") + std::string(name);
  return list;
}

void check_is_object(const Part& part) {
  if (!part.value.is_object()) fail(part, "this is no object");
}

template <class Names>
void check_members(const Part& part, const Names& known) {
  check_is_object(part);
  for (const auto& [name, value] : part.value.items())
    if (std::ranges::find(known, std::string_view(name)) == known.end())
      fail(part[name], "there is no such member; known are " + list_of(known));
}

Part member(const Part& part, const std::string& name) {
  if (!part.has(name)) fail(part, "'" + name + "' is missing");
  return part[name];
}

std::string text(const Part& part) {
  if (!part.value.is_string()) fail(part, "this is no text");
  return part.value.get<std::string>();
}

std::string text_or_nothing(const Part& part, const std::string& name) {
  return part.has(name) ? text(part[name]) : "";
}

/// \param known  the placeholders that it may have
std::string filled_text(const Part& part, const std::vector<std::string>& known) {
  std::string value = text(part);
  for (const std::string& name : placeholders_in(value))
    if (std::ranges::find(known, name) == known.end())
      fail(part, "there is no placeholder {" + name + "}; known are " + list_of(known));
  return value;
}

std::vector<std::string> words(const Part& part, const std::vector<std::string>& known) {
  if (!part.value.is_array() || part.value.empty()) fail(part, "this is no list of a program and its arguments");
  std::vector<std::string> all;
  for (std::size_t i = 0; i < part.value.size(); ++i) all.push_back(filled_text(part[i], known));
  if (all[0].empty() || !placeholders_in(all[0]).empty()) fail(part[0], "this is no name of a program");
  return all;
}

/// A text, or the lines of one.
std::string lines(const Part& part, const std::vector<std::string>& known) {
  if (!part.value.is_array()) return filled_text(part, known);
  std::string all;
  for (std::size_t i = 0; i < part.value.size(); ++i) all += filled_text(part[i], known) + "\n";
  return all;
}

using TextOf = std::string (*)(const Part&, const std::vector<std::string>& known);

std::vector<std::pair<std::string, std::string>> texts_by_name(const Part& part, const std::vector<std::string>& known,
                                                               TextOf text_of) {
  check_is_object(part);
  std::vector<std::pair<std::string, std::string>> all;
  for (const auto& [name, value] : part.value.items()) {
    if (name.empty()) fail(part[name], "this has no name");
    all.emplace_back(name, text_of(part[name], known));
  }
  return all;
}

std::string pattern(const Part& part) {
  std::string value = text(part);
  try {
    const std::regex ignored(value);
  } catch (const std::regex_error& error) {
    fail(part, std::string("this is no regular expression: ") + error.what());
  }
  return value;
}

std::string mesher_name(const Part& part) {
  std::string name = text(part);
  constexpr std::string_view allowed = "abcdefghijklmnopqrstuvwxyz0123456789-";
  if (name.empty() || name.find_first_not_of(allowed) != std::string::npos)
    fail(part, "a mesher's name is of small letters, digits and hyphens");
  return name;
}

std::string input_format(const Part& part) {
  std::string format = text(part);
  if (std::ranges::find(known_formats, format) == known_formats.end())
    fail(part, "an input cannot be written in the format '" + format + "'; known are " + list_of(known_formats));
  return format;
}

std::string output_file(const Part& part, const std::vector<std::string>& known) {
  std::string file = filled_text(part, known);
  if (!is_tet_mesh_file(file))
    fail(part, "a mesh cannot be read from this; known endings are .mesh .vtu .msh .node .ele .face");
  return file;
}

ChoiceCondition condition(const Part& part) {
  const std::string name = text(part);
  std::vector<std::string> known;
  for (const auto& [known_name, value] : conditions) {
    if (name == known_name) return value;
    known.emplace_back(known_name);
  }
  fail(part, "there is no such condition; known are " + list_of(known));
}

std::vector<Choice> choices(const Part& part) {
  check_is_object(part);
  constexpr std::array<const char*, 3> choice_members = {"if", "then", "else"};
  std::vector<Choice> all;
  for (const auto& [name, value] : part.value.items()) {
    const Part choice = part[name];
    check_members(choice, choice_members);
    if (placeholders_in("{" + name + "}").empty()) fail(choice, "such a name is of small letters and underscores");
    if (std::ranges::find(placeholder_names(), name) != placeholder_names().end())
      fail(choice, "there is a placeholder of this name already");
    all.push_back({name, condition(member(choice, "if")), filled_text(member(choice, "then"), placeholder_names()),
                   choice.has("else") ? filled_text(choice["else"], placeholder_names()) : ""});
  }
  return all;
}

void check_are_plain_names(const Part& part, const std::vector<std::pair<std::string, std::string>>& files) {
  for (const auto& [name, value] : files)
    if (name == "." || name == ".." || name.find('/') != std::string::npos)
      fail(part[name], "files are written beside the input: give a name without folders");
}

std::vector<int> success_codes(const Part& part) {
  if (!part.value.is_array() || part.value.empty()) fail(part, "this is no list of exit codes");
  std::vector<int> codes;
  for (std::size_t i = 0; i < part.value.size(); ++i) {
    const Json& code = part.value[i];
    if (!code.is_number_integer() || code < 0 || code > 255) fail(part[i], "an exit code is from 0 to 255");
    codes.push_back(code.get<int>());
  }
  return codes;
}

void read_optional_members(const Part& root, const std::vector<std::string>& known, MesherDescription& d) {
  d.install = text_or_nothing(root, "install");
  if (root.has("files")) {
    d.files = texts_by_name(root["files"], known, lines);
    check_are_plain_names(root["files"], d.files);
  }
  if (root.has("version_command")) d.version_command = words(root["version_command"], {"here"});
  if (root.has("version_pattern")) d.version_pattern = pattern(root["version_pattern"]);
  if (root.has("environment")) d.environment = texts_by_name(root["environment"], known, filled_text);
  if (root.has("seconds_pattern")) d.seconds_pattern = pattern(root["seconds_pattern"]);
  if (root.has("success_codes")) d.success_codes = success_codes(root["success_codes"]);
}

MesherDescription description_from(const Part& root) {
  check_members(root, known_members);
  if (text(member(root, "schema")) != schema_name)
    fail(root["schema"], std::string("a description of a mesher is of schema ") + schema_name);
  MesherDescription d;
  d.file = root.file;
  d.name = mesher_name(member(root, "name"));
  d.what = text(member(root, "what"));
  d.licence = text(member(root, "licence"));
  if (root.has("choices")) d.choices = choices(root["choices"]);
  std::vector<std::string> known = placeholder_names();
  for (const Choice& choice : d.choices) known.push_back(choice.name);
  d.command = words(member(root, "command"), known);
  d.input_format = input_format(member(root, "input_format"));
  d.output = output_file(member(root, "output"), known);
  read_optional_members(root, known, d);
  return d;
}

}  // namespace

MesherDescription read_mesher_description(const std::filesystem::path& file) {
  const std::string name = file.string();
  const io::FileBytes bytes = io::read_whole_file(file);
  Json json;
  try {
    json = Json::parse(bytes.bytes);
  } catch (const Json::parse_error& error) {
    io::fail_at_byte(bytes, error.byte, "a mesher's description is JSON, and this is none", remedy);
  }
  return description_from({json, Pointer(), name});
}

}  // namespace ccdt
