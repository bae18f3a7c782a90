#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "bench/run_record.h"

namespace ccdt {
namespace {

using Json = nlohmann::json;

bool has_type(const Json& value, const std::string& type) {
  if (type == "object") return value.is_object();
  if (type == "array") return value.is_array();
  if (type == "string") return value.is_string();
  if (type == "integer") return value.is_number_integer();
  if (type == "null") return value.is_null();
  return type == "number" && value.is_number();
}

/// Validates with the keywords of JSON Schema that our schemas use, except `pattern`. Appends the errors with their
/// paths.
void validate(const Json& schema, const Json& value, const std::string& path, std::vector<std::string>& wrong) {
  if (schema.contains("const") && value != schema["const"]) wrong.push_back(path + ": not " + schema["const"].dump());
  if (schema.contains("enum") && std::ranges::find(schema["enum"], value) == schema["enum"].end())
    wrong.push_back(path + ": not one of " + schema["enum"].dump());
  if (schema.contains("type")) {
    const Json types = schema["type"].is_array() ? schema["type"] : Json::array({schema["type"]});
    if (std::ranges::none_of(types, [&](const Json& type) { return has_type(value, type); }))
      wrong.push_back(path + ": no " + types.dump());
  }
  if (schema.contains("minimum") && value.is_number() && value < schema["minimum"])
    wrong.push_back(path + ": too small");
  for (const auto& name : schema.value("required", Json::array()))
    if (!value.contains(name.get<std::string>())) wrong.push_back(path + ": no " + name.get<std::string>());
  if (value.is_object())
    for (const auto& [name, member] : value.items()) {
      const Json none = Json::object();
      const Json& known = schema.contains("properties") ? schema["properties"] : none;
      if (known.contains(name)) validate(known[name], member, path + "/" + name, wrong);
      if (!known.contains(name) && schema.contains("additionalProperties"))
        validate(schema["additionalProperties"], member, path + "/" + name, wrong);
    }
  if (value.is_array() && schema.contains("items"))
    for (const Json& item : value) validate(schema["items"], item, path + "/-", wrong);
}

std::vector<std::string> faults_of(const Json& report) {
  std::ifstream file(RUN_SCHEMA);
  std::vector<std::string> wrong;
  validate(Json::parse(file), report, "", wrong);
  return wrong;
}

TEST(RunSchema, AcceptsTheRecordOfARun) {
  InputPlc input;
  input.name = "part.off";
  bench::RunRecord record = bench::start_record(baselines::mesher("ccdt"), input, {});
  record.quality = bench::measure_quality({});
  record.notes = {"a note"};
  record.samples = {{"mesh", {1, 2}}};
  record.counts.splits_by_level = {2, 1};
  record.counts.segments = {18, 7, 12, 2, 5, 4};
  EXPECT_EQ(faults_of(Json::parse(bench::to_json(record))), std::vector<std::string>());
}

TEST(RunSchema, RefusesARecordThatLacksAFixedNameOrHasAWrongType) {
  const Json good = Json::parse(bench::to_json(bench::RunRecord()));
  ASSERT_EQ(faults_of(good), std::vector<std::string>());
  Json lacking = good;
  lacking["counts"].erase("steiner_vertices");
  EXPECT_EQ(faults_of(lacking), std::vector<std::string>{"/counts: no steiner_vertices"});
  Json other = good;
  other["status"] = "fine";
  EXPECT_EQ(faults_of(other).size(), 1u);
  Json text = good;
  text["seconds"]["mesh"] = "fast";
  EXPECT_EQ(faults_of(text).size(), 1u);
  Json negative = good;
  negative["counts"]["splits_by_level"] = {1, -1};
  EXPECT_EQ(faults_of(negative).size(), 1u);
  Json partial = good;
  partial["counts"]["segments"] = {{"all", 18}, {"split", -2}};
  EXPECT_EQ(faults_of(partial).size(), 5u);  // four names are missing
}

}  // namespace
}  // namespace ccdt
