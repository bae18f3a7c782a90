#include "baselines/json_schema.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validation_results.hpp>
#include <valijson/validator.hpp>

#include "baselines/guess.h"
#include "baselines/parse_json.h"
#include "engine/io/files.h"

namespace ccdt::baselines {
namespace {

using Json = nlohmann::json;
using Pointer = Json::json_pointer;

bool has_type(const Json& rule, const Json& value) {
  const std::string type = rule.value("type", "");
  return (type == "object" && value.is_object()) || (type == "array" && value.is_array()) ||
         (type == "string" && value.is_string()) || (type == "boolean" && value.is_boolean()) ||
         ((type == "number" || type == "integer") && value.is_number());
}

/// The rule that a reference points to.
const Json& referred(const Json& schema, const Json& rule) {
  if (!rule.contains("$ref")) return rule;
  return referred(schema, schema.at(Pointer(rule["$ref"].get<std::string>().substr(1))));
}

/// The rule for a value: resolves references, and chooses the alternative of the value's type.
const Json& rule_for(const Json& schema, const Json& reference, const Json& value) {
  const Json& rule = referred(schema, reference);
  if (rule.contains("oneOf"))
    for (const Json& alternative : rule["oneOf"]) {
      const Json& one = rule_for(schema, alternative, value);
      if (has_type(one, value)) return one;
    }
  return rule;
}

/// The rule for a member of a value; null if the schema has none.
const Json* rule_for_member(const Json& rule, const std::string& member) {
  if (rule.contains("properties") && rule["properties"].contains(member)) return &rule["properties"][member];
  if (rule.contains("patternProperties")) return &rule["patternProperties"].begin().value();
  for (const char* all : {"items", "additionalProperties"})
    if (rule.contains(all) && rule[all].is_object()) return &rule[all];
  return nullptr;
}

std::vector<std::string> members_of(const Json& rule) {
  std::vector<std::string> names;
  for (const auto& [name, ignored] : rule.at("properties").items())
    if (!name.starts_with('$')) names.push_back(name);
  return names;
}

/// What to write at a place, from the description nearest to it.
std::string description_at(const Json& schema, const Json& root, const Pointer& at) {
  std::string text;
  const Json* rule = &schema;
  const Json* value = &root;
  std::vector<std::string> tokens;
  for (Pointer rest = at; !rest.empty(); rest.pop_back()) tokens.insert(tokens.begin(), rest.back());
  for (const std::string& token : tokens) {
    rule = rule_for_member(rule_for(schema, *rule, *value), token);
    if (rule == nullptr) break;
    const std::string name = value->is_array() ? "" : token + ": ";
    value = value->is_array() ? &value->at(std::stoul(token)) : &value->at(token);
    for (const Json* said : {rule, &referred(schema, *rule), &rule_for(schema, *rule, *value)})
      if (said->contains("description")) text = name + (*said)["description"].get<std::string>();
  }
  return text.empty() ? "the members are " + listed(members_of(schema)) : text;
}

/// The rule for a value with all alternatives resolved by type, so that messages are about what the user meant.
Json rule_as_meant(const Json& schema, const Json& rule_of_value, const Json& value) {
  Json rule = rule_for(schema, rule_of_value, value);
  if (rule.contains("patternProperties")) return rule;
  if (value.is_array() && rule.contains("items") && rule["items"].is_object()) {
    const Json of_all = rule["items"];
    rule["items"] = Json::array();
    for (const Json& item : value) rule["items"].push_back(rule_as_meant(schema, of_all, item));
  }
  if (value.is_object())
    for (const auto& [name, member] : value.items()) {
      const Json* of_member = rule_for_member(rule, name);
      if (of_member == nullptr) continue;
      Json meant = rule_as_meant(schema, *of_member, member);
      rule["properties"][name] = std::move(meant);
    }
  return rule;
}

/// \throw InputError  a member that the schema does not know
void check_members(const Json& schema, const Json& rule_of_value, const Json& value, const Pointer& at,
                   const std::string& file, const UserFile& kind) {
  if (!value.is_structured()) return;
  const Json& rule = rule_for(schema, rule_of_value, value);
  const bool is_closed = rule.value("additionalProperties", Json()) == false && !rule.contains("patternProperties");
  for (const auto& [name, member] : value.items()) {
    const Json* its_rule = rule_for_member(rule, name);
    if (its_rule != nullptr)
      check_members(schema, *its_rule, member, at / name, file, kind);
    else if (value.is_object() && is_closed)
      fail_at_pointer(file, (at / name).to_string(), "there is no such member",
                      suggestion(name, members_of(rule), "the members are ") + kind.examples);
  }
}

void check_schema(const Json& value, const std::string& file, const UserFile& kind) {
  using Adapter = valijson::adapters::NlohmannJsonAdapter;
  const Json rules = Json::parse(kind.schema);
  check_members(rules, rules, value, Pointer(), file, kind);
  valijson::Schema schema;
  const Json meant = rule_as_meant(rules, rules, value);
  valijson::SchemaParser().populateSchema(Adapter(meant), schema);
  valijson::ValidationResults faults;
  if (valijson::Validator().validate(schema, Adapter(value), &faults)) return;
  // The first of the deepest errors is the cause; the others follow from it.
  const auto cause = std::ranges::max_element(faults, {}, [](const auto& fault) { return fault.context.size(); });
  Pointer at;
  for (std::size_t i = 1; i < cause->context.size(); ++i)  // "<root>", "[command]", "[0]"
    at /= cause->context[i].substr(1, cause->context[i].size() - 2);
  fail_at_pointer(file, at.to_string(), cause->description, description_at(rules, value, at) + kind.examples);
}

}  // namespace

nlohmann::ordered_json read_user_file(const std::filesystem::path& file, const UserFile& kind) {
  const io::FileBytes bytes = io::read_whole_file(file);
  nlohmann::ordered_json json;
  try {
    json = parse_json(bytes.bytes);
  } catch (const nlohmann::ordered_json::parse_error& error) {
    io::fail_at_byte(bytes, error.byte, std::string(kind.what) + " must be JSON, but this is not",
                     std::string("correct the file there") + kind.examples);
  } catch (const nlohmann::ordered_json::exception& error) {
    throw InputError(std::string(kind.what) + " cannot be read: " + error.what(), io::place_in(file.string()),
                     std::string("correct the file there") + kind.examples);
  }
  check_schema(json, file.string(), kind);
  return json;
}

void fail_at_pointer(const std::string& file, const std::string& pointer, const std::string& what,
                     const std::string& remedy) {
  throw InputError((pointer.empty() ? "" : pointer + ": ") + what, io::place_in(file), remedy);
}

std::string listed(const std::vector<std::string>& names) {
  std::string list;
  for (const auto& name : names) list += (list.empty() ? "" : ", ") + name;
  return list;
}

std::string suggestion(std::string_view unknown, const std::vector<std::string>& known,
                       const std::string& before_list) {
  return guess(unknown, known) + before_list + listed(known);
}

}  // namespace ccdt::baselines
