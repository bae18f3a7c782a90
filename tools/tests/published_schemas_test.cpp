#include "tools/tests/published_schemas.h"

#include <gtest/gtest.h>

#include <set>

#include "bench/run/run_record.h"
#include "engine/base/work.h"

// Tests what the published schemas allow, and that they name everything the program can write.

namespace ccdt {
namespace {

using Json = nlohmann::json;

const PublishedSchemas& published() {
  static const PublishedSchemas all(SCHEMA_FOLDER);
  return all;
}

std::vector<std::string> faults(const Json& record) {
  return published().faults("ccdt.run/1", record);
}

/// The schemas of objects, within this one, that allow members with any name and any value.
void find_open_objects(const Json& schema, const std::string& place, std::set<std::string>& open) {
  if (schema.is_object() && schema.value("type", Json()) == "object" && !schema.contains("additionalProperties"))
    open.insert(place);
  if (!schema.is_structured()) return;
  for (const auto& [name, part] : schema.items())
    if (name != "required" && name != "enum") find_open_objects(part, place + "/" + name, open);
}

TEST(PublishedSchemas, AllowNoOtherMembers) {
  std::set<std::string> open;
  for (const auto& [name, schema] : published().all()) find_open_objects(schema, name, open);
  EXPECT_EQ(open, std::set<std::string>{"ccdt.report/1/definitions/chart/properties/spec"}) << "Vega-Lite has its own";
}

TEST(PublishedSchemas, AreCalledAsTheFilesThatNameThem) {
  for (const auto& entry : std::filesystem::directory_iterator(SCHEMA_FOLDER)) {
    std::string name = entry.path().filename().string();
    const std::string ending = ".1.schema.json";
    ASSERT_TRUE(name.ends_with(ending)) << name;
    name.replace(name.size() - ending.size(), ending.size(), "/1");
    EXPECT_TRUE(published().all().contains(name)) << name;
  }
}

std::set<std::string> names_in(const Json& object) {
  std::set<std::string> names;
  for (const auto& [name, value] : object.items()) names.insert(name);
  return names;
}

TEST(RunSchema, NamesTheWorkOfEveryStage) {
  const Json& schema = published().all().at("ccdt.run/1");
  std::set<std::string> counts, stages;
  for (const WorkCount& count : work_counts) counts.insert(count.name);
  for (const NamedValue<Stage>& stage : names_of(Stage{})) stages.emplace(stage.name);
  EXPECT_EQ(names_in(schema["definitions"]["work"]["properties"]), counts);
  for (const char* figure : {"cpu_seconds", "threads", "work"})
    EXPECT_EQ(names_in(schema["properties"][figure]["properties"]), stages) << figure;
}

TEST(RunSchema, NamesTheLimits) {
  std::set<std::string> limits;
  for (const WorkCount& limit : limit_counts) limits.insert(limit.name);
  EXPECT_EQ(names_in(published().all().at("ccdt.run/1")["properties"]["limits_reached"]["properties"]), limits);
}

template <class Enum>
void expect_values(const char* option) {
  std::set<std::string> names;
  for (const NamedValue<Enum>& value : names_of(Enum{})) names.emplace(value.name);
  const Json& schema = published().all().at("ccdt.run/1")["properties"]["options"]["properties"];
  EXPECT_EQ(schema[option]["enum"].get<std::set<std::string>>(), names) << option;
}

TEST(RunSchema, NamesTheValuesOfOptions) {
  expect_values<Lattice>("lattice");
  expect_values<LocatorKind>("locator");
  expect_values<DelaunayMethod>("delaunay");
  expect_values<Visibility>("visibility");
  expect_values<Protection>("protection");
  expect_values<Improvement>("improve");
  expect_values<Objective>("objective");
  expect_values<BoundaryRule>("boundary");
  expect_values<SteinerRule>("steiner");
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
  EXPECT_EQ(faults(Json::parse(bench::to_json(record))), std::vector<std::string>());
}

TEST(RunSchema, RefusesARecordThatLacksANameOrHasAnotherOrAWrongType) {
  const Json good = Json::parse(bench::to_json(bench::RunRecord()));
  ASSERT_EQ(faults(good), std::vector<std::string>());
  const auto expect_refused = [&](const char* place, const Json& value) {
    Json bad = good;
    bad[Json::json_pointer(place)] = value;
    EXPECT_NE(faults(bad), std::vector<std::string>()) << place;
  };
  expect_refused("/status", "fine");
  expect_refused("/seconds/mesh", "fast");
  expect_refused("/counts/splits_by_level", {1, -1});
  expect_refused("/counts/segments", {{"all", 18}});
  for (const char* place : {"/more", "/mesher/more", "/counts/more", "/quality/r/more", "/work/more", "/options/more"})
    expect_refused(place, 1);
  Json lacking = good;
  lacking["counts"].erase("steiner_vertices");
  EXPECT_NE(faults(lacking), std::vector<std::string>());
}

}  // namespace
}  // namespace ccdt
