#include "baselines/mesher_description.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <regex>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validation_results.hpp>
#include <valijson/validator.hpp>

#include "baselines/mesher_schema.h"
#include "engine/io/files.h"

namespace ccdt::baselines {
namespace {

using Json = nlohmann::ordered_json;  // choices and files keep their order
using Pointer = Json::json_pointer;

constexpr const char* examples = "; baselines/described has examples";
constexpr std::string_view placeholder_letters = "abcdefghijklmnopqrstuvwxyz_";

[[noreturn]] void fail(const std::string& file, const Pointer& at, const std::string& what, const std::string& remedy) {
  throw InputError((at.empty() ? "" : at.to_string() + ": ") + what, io::place_in(file), remedy + examples);
}

template <class Names>
std::string list_of(const Names& names) {
  std::string list;
  for (const auto& name : names) list += (list.empty() ? "" : ", ") + name;
  return list;
}

/// What the schema says about a member, or else which members there are.
std::string description_of(const nlohmann::json& schema, const std::string& member) {
  const auto& known = schema.at("properties");
  if (known.contains(member)) return member + ": " + known.at(member).at("description").get<std::string>();
  std::vector<std::string> names;
  for (const auto& [name, rule] : known.items()) names.push_back(name);
  return "the members are " + list_of(names);
}

/// \throw InputError  the description does not follow the schema
void check_schema(const Json& description, const std::string& file) {
  using Adapter = valijson::adapters::NlohmannJsonAdapter;
  const auto rules = nlohmann::json::parse(mesher_schema);
  const nlohmann::json target = description;
  valijson::Schema schema;
  valijson::SchemaParser().populateSchema(Adapter(rules), schema);
  valijson::ValidationResults faults;
  if (valijson::Validator().validate(schema, Adapter(target), &faults)) return;
  // The first one of the deepest is the cause; the others follow from it.
  const auto cause = std::ranges::max_element(faults, {}, [](const auto& fault) { return fault.context.size(); });
  Pointer at;
  for (std::size_t i = 1; i < cause->context.size(); ++i)  // "<root>", "[command]", "[0]"
    at /= cause->context[i].substr(1, cause->context[i].size() - 2);
  const std::string member = cause->context.size() < 2 ? "" : cause->context[1].substr(1, cause->context[1].size() - 2);
  fail(file, at, cause->description, description_of(rules, member));
}

/// Checks all texts in a part of the description.
/// \throw InputError  a placeholder is not known
void check_placeholders(const Json& part, const Pointer& at, const std::vector<std::string>& known,
                        const std::string& file) {
  if (part.is_structured())
    for (const auto& [name, value] : part.items()) check_placeholders(value, at / name, known, file);
  if (!part.is_string()) return;
  for (const std::string& name : placeholders_in(part.get<std::string>()))
    if (std::ranges::find(known, name) == known.end())
      fail(file, at, "there is no placeholder {" + name + "}", "known are " + list_of(known));
}

void check_all_placeholders(const Json& json, const std::string& file) {
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

std::string pattern(const Json& json, const char* member, const std::string& file) {
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
std::string text_of(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  std::string text;
  for (const Json& line : value) text += line.get<std::string>() + "\n";
  return text;
}

std::vector<std::pair<std::string, std::string>> texts_by_name(const Json& object) {
  std::vector<std::pair<std::string, std::string>> all;
  for (const auto& [name, value] : object.items()) all.emplace_back(name, text_of(value));
  return all;
}

MesherDescription description_from(const Json& json, const std::string& file) {
  const Json none = Json::object(), choices = json.value("choices", none);
  MesherDescription d;
  d.file = file;
  d.name = json.at("name");
  d.what = json.at("what");
  d.license = json.at("licence");
  d.install = json.value("install", "");
  d.command = json.at("command").get<std::vector<std::string>>();
  d.input_format = json.at("input_format");
  d.output = json.at("output");
  d.files = texts_by_name(json.value("files", none));
  for (const auto& [name, choice] : choices.items())
    d.choices.push_back({name, value_of<ChoiceCondition>(choice.at("if").get<std::string>()).value(), choice.at("then"),
                         choice.value("else", "")});
  d.version_command = json.value("version_command", d.version_command);
  d.version_pattern = pattern(json, "version_pattern", file);
  d.environment = texts_by_name(json.value("environment", none));
  d.seconds_pattern = pattern(json, "seconds_pattern", file);
  d.success_codes = json.value("success_codes", d.success_codes);
  d.keeps_surface = json.value("keeps_surface", d.keeps_surface);
  return d;
}

/// The next placeholder from a position on, without its braces; empty, at the end of the text, if there is none.
std::string_view next_name(std::string_view text, std::size_t from) {
  for (std::size_t brace = text.find('{', from); brace != std::string_view::npos; brace = text.find('{', brace + 1)) {
    const std::size_t end = std::min(text.find_first_not_of(placeholder_letters, brace + 1), text.size());
    if (end > brace + 1 && end < text.size() && text[end] == '}') return text.substr(brace + 1, end - brace - 1);
  }
  return text.substr(text.size());
}

}  // namespace

MesherDescription read_mesher_description(const std::filesystem::path& file) {
  const std::string name = file.string();
  const io::FileBytes bytes = io::read_whole_file(file);
  Json json;
  try {
    json = Json::parse(bytes.bytes);
  } catch (const Json::parse_error& error) {
    io::fail_at_byte(bytes, error.byte, "the description of a mesher is JSON, and this is not",
                     "correct it there" + std::string(examples));
  }
  check_schema(json, name);
  check_all_placeholders(json, name);
  return description_from(json, name);
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
