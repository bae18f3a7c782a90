#include "baselines/mesher_description.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>

#include "baselines/json_schema.h"
#include "baselines/mesher_schema.h"
#include "engine/base/errors.h"

namespace ccdt::baselines {
namespace {

using OrderedJson = nlohmann::ordered_json;  // choices and files keep their order
using Pointer = OrderedJson::json_pointer;

constexpr UserFile description_file = {"the description of a mesher", mesher_schema,
                                       "; baselines/described has examples"};
constexpr std::string_view placeholder_letters = "abcdefghijklmnopqrstuvwxyz_";

[[noreturn]] void fail(const std::string& file, const Pointer& at, const std::string& what, const std::string& remedy) {
  fail_at_pointer(file, at.to_string(), what, remedy + description_file.examples);
}

/// Checks all texts in a part of the description.
/// \throw InputError  a placeholder is not known
void check_placeholders(const OrderedJson& part, const Pointer& at, const std::vector<std::string>& known,
                        const std::string& file) {
  if (part.is_structured())
    for (const auto& [name, value] : part.items()) check_placeholders(value, at / name, known, file);
  if (!part.is_string()) return;
  for (const std::string& name : placeholders_in(part.get<std::string>()))
    if (std::ranges::find(known, name) == known.end())
      fail(file, at, "there is no placeholder {" + name + "}", "use one of " + listed(known));
}

void check_all_placeholders(const OrderedJson& json, const std::string& file) {
  std::vector<std::string> known = {"input", "stem", "folder", "here", "edge_length", "max_volume"};
  const auto check = [&](const char* member, const std::vector<std::string>& names) {
    if (json.contains(member)) check_placeholders(json.at(member), Pointer() / member, names, file);
  };
  check("choices", known);
  check("version_command", {"here"});
  if (json.contains("choices"))
    for (const auto& [name, choice] : json.at("choices").items()) known.push_back(name);
  for (const char* member : {"command", "output", "files", "environment"}) check(member, known);
}

std::string pattern(const OrderedJson& json, const char* member, const std::string& file) {
  std::string value = json.value(member, "");
  try {
    const std::regex ignored(value);
  } catch (const std::regex_error& error) {
    fail(file, Pointer() / member, std::string("this is not a regular expression: ") + error.what(),
         "use the syntax of ECMAScript");
  }
  return value;
}

/// A text, or the lines of one.
std::string text_of(const OrderedJson& value) {
  if (value.is_string()) return value.get<std::string>();
  std::string text;
  for (const OrderedJson& line : value) text += line.get<std::string>() + "\n";
  return text;
}

std::vector<std::pair<std::string, std::string>> texts_by_name(const OrderedJson& object) {
  std::vector<std::pair<std::string, std::string>> all;
  for (const auto& [name, value] : object.items()) all.emplace_back(name, text_of(value));
  return all;
}

MesherDescription description_from(const OrderedJson& json, const std::string& file) {
  const OrderedJson empty = OrderedJson::object(), choices = json.value("choices", empty);
  MesherDescription d;
  d.file = file;
  d.name = json.at("name");
  d.what = json.at("what");
  d.license = json.at("licence");
  d.install = json.value("install", "");
  d.command = json.at("command").get<std::vector<std::string>>();
  d.input_format = json.at("input_format");
  d.output = json.at("output");
  d.files = texts_by_name(json.value("files", empty));
  for (const auto& [name, choice] : choices.items())
    d.choices.push_back({name, value_of<ChoiceCondition>(choice.at("if").get<std::string>()).value(), choice.at("then"),
                         choice.value("else", "")});
  d.version_command = json.value("version_command", d.version_command);
  d.version_pattern = pattern(json, "version_pattern", file);
  d.environment = texts_by_name(json.value("environment", empty));
  d.seconds_pattern = pattern(json, "seconds_pattern", file);
  d.success_codes = json.value("success_codes", d.success_codes);
  d.keeps_surface = json.value("keeps_surface", d.keeps_surface);
  return d;
}

/// The next placeholder at or after a position, without its braces. If there is none: empty, at the end of the text.
std::string_view next_name(std::string_view text, std::size_t from) {
  for (std::size_t brace = text.find('{', from); brace != std::string_view::npos; brace = text.find('{', brace + 1)) {
    const std::size_t end = std::min(text.find_first_not_of(placeholder_letters, brace + 1), text.size());
    if (end > brace + 1 && end < text.size() && text[end] == '}') return text.substr(brace + 1, end - brace - 1);
  }
  return text.substr(text.size());
}

/// Adds those words of a text that are paths of existing files.
void add_files_in(std::string_view text, std::set<std::filesystem::path>& files) {
  constexpr std::string_view between_words = " \t\n\r\"'`;:=,|&<>()";
  const auto add = [&](std::string_view word) {
    std::error_code error;
    const std::filesystem::path path(word);
    if (path.is_absolute() && std::filesystem::is_regular_file(path, error)) files.insert(path.lexically_normal());
  };
  add(text);  // a whole argument may contain blanks
  while (!text.empty()) {
    const std::size_t end = std::min(text.find_first_of(between_words), text.size());
    add(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
}

}  // namespace

MesherDescription read_mesher_description(const std::filesystem::path& file) {
  const std::string name = file.string();
  const OrderedJson json = read_user_file(file, description_file);
  check_all_placeholders(json, name);
  return description_from(json, name);
}

std::string folder_of(const MesherDescription& description) {
  return std::filesystem::absolute(description.file).parent_path().lexically_normal().string();
}

std::vector<std::string> texts_of(const MesherDescription& description) {
  std::vector<std::string> texts = description.command;
  texts.push_back(description.output);
  for (const auto& [name, text] : description.files) texts.push_back(text);
  for (const auto& [name, value] : description.environment) texts.push_back(value);
  return texts;
}

std::vector<std::filesystem::path> files_named_in(const MesherDescription& description) {
  std::vector<std::string> texts = texts_of(description);
  for (const Choice& choice : description.choices) texts.insert(texts.end(), {choice.text_if, choice.text_else});
  std::set<std::filesystem::path> files;
  for (const std::string& text : texts)
    add_files_in(fill_placeholders(text, {{"here", folder_of(description)}}), files);
  return {files.begin(), files.end()};
}

std::vector<std::string> placeholders_in(std::string_view text) {
  std::vector<std::string> names;
  for (std::string_view name = next_name(text, 0); !name.empty();
       name = next_name(text, static_cast<std::size_t>(name.data() - text.data()) + name.size()))
    names.emplace_back(name);
  return names;
}

std::string fill_placeholders(std::string_view text, const std::vector<Placeholder>& values) {
  std::string result;
  std::size_t done = 0;
  for (std::string_view name = next_name(text, 0); !name.empty(); name = next_name(text, done)) {
    const auto begin = static_cast<std::size_t>(name.data() - text.data());
    const auto known = std::ranges::find(values, name, &Placeholder::name);
    const std::size_t end = begin + name.size() + 1;
    result += text.substr(done, begin - 1 - done);
    result += known == values.end() ? std::string(text.substr(begin - 1, end - begin + 1)) : known->value;
    done = end;
  }
  return result.append(text.substr(done));
}

}  // namespace ccdt::baselines
