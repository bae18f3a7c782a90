#include "bench/run/run_record.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "engine/base/errors.h"

namespace ccdt {
namespace {

using Json = nlohmann::json;

bench::RunRecord example_record() {
  bench::RunRecord record;
  record.mesher = {"ccdt", "0.1.0", "abc"};
  record.input = {"cube.off", std::string(64, '0'), 8, 12, 0};
  record.options = {{"face_protection", true}, {"lattice", std::string("fcc")}, {"edge_length", 0.25}};
  record.mesher_settings = {{"switches", "pQ"}};
  record.environment.cpu = "a cpu";
  record.environment.cores = 4;
  record.environment.libraries = {{"tetgen", "1.5.0"}};
  record.counts = {10, 3, 1, 30, 12, 2, 3, {2, 1}, 4};
  record.counts.segments = {18, 7, 12, 2, 5, 4};
  record.costs[Stage::delaunay].seconds = 0.5;
  record.costs.mesh_seconds = 0.75;
  record.costs[Stage::delaunay].work.cells_created = 17;
  record.costs[Stage::delaunay].work.largest_cavity = 9;
  record.costs[Stage::remesh].work.exact_evaluations = 3;
  record.read_seconds = 0.125;
  record.peak_rss_bytes = 1 << 20;
  record.quality.r = {1, 1.5, 1.25, 3, std::numeric_limits<double>::infinity(), {{1, 2, 3}, {29, 1}}};
  record.quality.dihedral_degrees = {10, 170, {{0, 90, 180}, {100, 80}}};
  record.quality.aspect_ratio = {1, 1.75, 1.5, 4, std::numeric_limits<double>::infinity(), {{1, 2}, {30}}};
  record.quality.radius_edge_ratio = {0.625, 0.75, 0.7, 1.25, 2, {{0.5, 2}, {30}}};
  record.quality.volume = 1.0 / 3;
  record.largest_rounding = 1e-10;
  record.notes = {"a note"};
  record.samples = {{"mesh", {0.75, 0.7}}};
  return record;
}

TEST(RunRecord, SumsUpTheLimitsOfAllStages) {
  StageCosts costs;
  costs[Stage::remesh].work.feature_triangles = 2, costs[Stage::refine].work.feature_triangles = 3;
  costs[Stage::improve].work.cell_tries = 7;
  bench::RunRecord record = example_record();
  EXPECT_FALSE(Json::parse(bench::to_json(record)).contains("limits_reached"));
  record.set_costs(costs);
  const std::map<std::string, std::uint64_t> limits = {{"cell_tries", 7}, {"feature_triangles", 5}};
  EXPECT_EQ(bench::run_record_from_json(bench::to_json(record)).limits_reached, limits);
}

TEST(RunRecord, HasTheFixedNamesOfTheSchema) {
  const Json json = Json::parse(bench::to_json(example_record()));
  EXPECT_EQ(json["schema"], "ccdt.run/1");
  for (const char* pointer : {"/mesher/name",
                              "/mesher/version",
                              "/mesher/revision",
                              "/input/name",
                              "/input/sha256",
                              "/input/vertices",
                              "/input/facets",
                              "/input/segments",
                              "/options/face_protection",
                              "/options/lattice",
                              "/environment/cpu",
                              "/environment/cores",
                              "/environment/compiler",
                              "/environment/flags",
                              "/environment/libraries/tetgen",
                              "/counts/vertices",
                              "/counts/steiner_vertices",
                              "/counts/interior_vertices",
                              "/counts/tetrahedra",
                              "/counts/faces",
                              "/counts/undelaunay_faces",
                              "/counts/front_tetrahedra",
                              "/counts/splits_by_level",
                              "/counts/dropped_interior_vertices",
                              "/counts/segments/all",
                              "/counts/segments/grazeable",
                              "/counts/segments/delaunay",
                              "/counts/segments/split",
                              "/counts/segments/pieces",
                              "/counts/segments/front",
                              "/seconds/read",
                              "/seconds/protect",
                              "/seconds/lattice",
                              "/seconds/delaunay",
                              "/seconds/face_check",
                              "/seconds/front",
                              "/seconds/label",
                              "/seconds/improve",
                              "/seconds/write",
                              "/seconds/mesh",
                              "/peak_rss_bytes",
                              "/quality/r/min",
                              "/quality/r/mean",
                              "/quality/r/median",
                              "/quality/r/p99",
                              "/quality/r/max",
                              "/quality/r/histogram/edges",
                              "/quality/r/histogram/counts",
                              "/quality/dihedral_degrees/min",
                              "/quality/dihedral_degrees/max",
                              "/quality/dihedral_degrees/histogram/edges",
                              "/quality/dihedral_degrees/histogram/counts",
                              "/quality/aspect_ratio/p99",
                              "/quality/aspect_ratio/histogram/edges",
                              "/quality/radius_edge_ratio/max",
                              "/quality/radius_edge_ratio/histogram/counts",
                              "/volume",
                              "/status"})
    EXPECT_TRUE(json.contains(Json::json_pointer(pointer))) << pointer;
}

TEST(RunRecord, ReadsBackBitForBit) {
  const std::string text = bench::to_json(example_record());
  const bench::RunRecord back = bench::run_record_from_json(text);
  EXPECT_EQ(bench::to_json(back), text);
  EXPECT_EQ(back.quality.volume, 1.0 / 3);
  EXPECT_TRUE(std::isinf(back.quality.r.max));
  EXPECT_EQ(back.samples.at("mesh").size(), 2u);
}

TEST(RunRecord, KeepsTheSplitsOfEachLevelAndTheDroppedPoints) {
  const bench::RunRecord back = bench::run_record_from_json(bench::to_json(example_record()));
  EXPECT_EQ(back.counts.splits_by_level, (std::vector<std::uint64_t>{2, 1}));
  EXPECT_EQ(back.counts.dropped_interior_vertices, 4u);
}

TEST(RunRecord, OfOlderProgramsMayLackTheCountsOfSplits) {
  Json json = Json::parse(bench::to_json(example_record()));
  json["counts"].erase("splits_by_level");
  json["counts"].erase("dropped_interior_vertices");
  EXPECT_TRUE(bench::run_record_from_json(json.dump()).counts.splits_by_level.empty());
}

TEST(RunRecord, OfAnotherMesherHasNoCountsOfSegments) {
  bench::RunRecord record = example_record();
  record.counts.segments.reset();
  const Json json = Json::parse(bench::to_json(record));
  EXPECT_FALSE(json["counts"].contains("segments"));
  EXPECT_FALSE(bench::run_record_from_json(json.dump()).counts.segments.has_value());
}

TEST(RunRecord, HasTheWorkOfEachStageThatIsNotZero) {
  const bench::RunRecord record = example_record();
  const Json json = Json::parse(bench::to_json(record));
  EXPECT_EQ(json["work"], Json::parse(R"({"delaunay": {"cells_created": 17, "largest_cavity": 9},
                                          "remesh": {"exact_evaluations": 3}})"));
  const bench::RunRecord back = bench::run_record_from_json(json.dump());
  EXPECT_EQ(back.costs[Stage::delaunay].work, record.costs[Stage::delaunay].work);
  EXPECT_EQ(back.costs[Stage::front].work, Work());
  EXPECT_EQ(back.costs[Stage::remesh].work, record.costs[Stage::remesh].work);
}

TEST(RunRecord, OfOtherMeshersHasNoWork) {
  bench::RunRecord record = example_record();
  record.costs = {};
  const Json json = Json::parse(bench::to_json(record));
  EXPECT_FALSE(json.contains("work"));
  EXPECT_EQ(bench::run_record_from_json(json.dump()).costs[Stage::delaunay].work, Work());
}

TEST(RunRecord, OfOlderProgramsMayLackTheRatiosOfOtherTools) {
  Json json = Json::parse(bench::to_json(example_record()));
  json["quality"].erase("aspect_ratio");
  json["quality"].erase("radius_edge_ratio");
  EXPECT_EQ(bench::run_record_from_json(json.dump()).quality.aspect_ratio.max, 0);
}

TEST(RunRecord, OfAFailureKeepsStatusAndReason) {
  bench::RunRecord record = example_record();
  record.status = baselines::RunStatus::timeout;
  record.reason = "stopped at the limit of 5 s";
  const bench::RunRecord back = bench::run_record_from_json(bench::to_json(record));
  EXPECT_EQ(back.status, baselines::RunStatus::timeout);
  EXPECT_EQ(back.reason, record.reason);
}

TEST(RunRecord, OfAFailureHasItsKindAndOthersHaveNone) {
  bench::RunRecord record = example_record();
  EXPECT_FALSE(Json::parse(bench::to_json(record)).contains("kind"));
  record.set_failure(baselines::FailureKind::out_of_memory, "too much");
  EXPECT_EQ(record.status, baselines::RunStatus::out_of_memory);
  EXPECT_EQ(bench::run_record_from_json(bench::to_json(record)).kind, baselines::FailureKind::out_of_memory);
}

TEST(RunRecord, OfAProcessThatWasKilledSaysSoAndThatOfOneThatFailedKeepsItsWords) {
  baselines::ProcessResult ended;
  ended.kind = baselines::FailureKind::timeout;
  ended.signal = 9;
  bench::RunRecord record = example_record();
  record.set_failure(baselines::FailureKind::crashed, "the process ended before its run did");
  bench::note_end(ended, record);
  EXPECT_EQ(record.kind, baselines::FailureKind::timeout);
  ended = {};
  ended.exit_code = 1;
  ended.kind = baselines::FailureKind::refused;
  record.set_failure(baselines::FailureKind::crashed, "the mesher's program crashed");
  bench::note_end(ended, record);
  EXPECT_EQ(record.kind, baselines::FailureKind::crashed);
  record = example_record();
  bench::note_end(ended, record);
  EXPECT_EQ(record.kind, baselines::FailureKind::refused) << "it did not say so itself";
}

TEST(RunRecord, OfASweepHasItsCaseItsNumberAndWhatTheVerifierFound) {
  bench::RunRecord record = example_record();
  const Json alone = Json::parse(bench::to_json(record));
  for (const char* name : {"case", "number", "verification", "mesh_fingerprint"}) EXPECT_FALSE(alone.contains(name));
  record.case_id = "0123456789abcdef";
  record.number = 0;
  record.mesh_fingerprint = std::string(32, 'a');
  record.verification = {false, {{"positive orientation", 30, 2}}, 0.25};
  const Json json = Json::parse(bench::to_json(record));
  EXPECT_EQ(json["case"], record.case_id);
  EXPECT_EQ(json["number"], 0);
  EXPECT_EQ(json["verification"]["right"], false);
  EXPECT_EQ(json["verification"]["checks"][0]["failed"], 2);
  const bench::RunRecord back = bench::run_record_from_json(json.dump());
  EXPECT_EQ(back.number, 0);
  EXPECT_EQ(back.mesh_fingerprint, record.mesh_fingerprint);
  ASSERT_TRUE(back.verification);
  EXPECT_EQ(back.verification->checks.at(0).name, "positive orientation");
  EXPECT_EQ(back.verification->seconds, 0.25);
}

TEST(RunRecord, SurvivesFileNamesThatAreNoUtf8) {
  bench::RunRecord record = example_record();
  record.input.name = "caf\xe9.stl";
  EXPECT_TRUE(Json::accept(bench::to_json(record)));
}

TEST(RunRecord, RefusesOtherJson) {
  EXPECT_THROW(bench::run_record_from_json("{}"), InputError);
  EXPECT_THROW(bench::run_record_from_json("[1, 2"), InputError);
  EXPECT_THROW(bench::run_record_from_json(R"({"schema": "ccdt.run/1"})"), InputError);
  EXPECT_THROW(bench::run_record_from_json(R"({"schema": "ccdt.run/2"})"), InputError);
}

}  // namespace
}  // namespace ccdt
