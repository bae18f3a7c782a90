#include "reports/tests/made_up_sweep.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <random>
#include <utility>

#include "bench/run/json.h"
#include "bench/run/run_record.h"
#include "engine/io/files.h"

namespace ccdt {
namespace {

using bench::Json;

struct Input {
  std::string name, model;
  double edge_length = 0;
  double size = 0;  ///< approximate number of tetrahedra
};

struct MadeUpCase {
  Input input;
  std::string mesher, lattice, locator;
};

std::vector<Input> inputs_of(const MadeUpSweep& sweep) {
  constexpr std::array models = {"piston", "bracket", "stepping-pole"};
  std::vector<Input> inputs;
  for (int model = 0; model < sweep.models; ++model)
    for (int size = 0; size < sweep.sizes; ++size) {
      const double share = sweep.sizes > 1 ? static_cast<double>(size) / (sweep.sizes - 1) : 0;
      const double length = std::round(1000 * 8 * std::pow(0.2, share)) / 1000;
      const std::string name = models.at(static_cast<std::size_t>(model));
      inputs.push_back({name + "-" + std::to_string(size), name, length, 1e4 * std::pow(10, 2 * share)});
    }
  for (int file = 0; file < sweep.files; ++file)
    inputs.push_back({"part-" + std::to_string(file) + ".off", "", 0, 2e3 * (1 + file % 97)});
  return inputs;
}

std::vector<MadeUpCase> cases_of(const MadeUpSweep& sweep) {
  std::vector<MadeUpCase> cases;
  for (const Input& input : inputs_of(sweep)) {
    for (const std::string& lattice : sweep.lattices)
      for (const std::string& locator : sweep.locators) cases.push_back({input, "ccdt", lattice, locator});
    for (const std::string& other : sweep.others) cases.push_back({input, other, "", ""});
  }
  return cases;
}

std::string id_of(std::size_t number) {
  std::array<char, 17> text{};
  std::snprintf(text.data(), text.size(), "%016llx", 0x9e3779b97f4a7c15ull * (number + 1));
  return text.data();
}

double speed_of(const MadeUpCase& c) {
  if (c.mesher == "tetgen") return 1.3;
  if (c.mesher != "ccdt") return 3;
  return (c.locator == "cavity" ? 1 : 1.15) * (c.lattice == "fcc" ? 1 : 0.9);
}

double worst_r_of(const MadeUpCase& c) {
  if (c.mesher == "tetgen") return 60;
  if (c.mesher != "ccdt") return 6;
  return c.lattice == "fcc" ? 9 : c.lattice == "bcc" ? 12 : 20;
}

Json description(const MadeUpSweep& sweep, const std::vector<MadeUpCase>& cases) {
  const Json repetitions = {{"warm_up", 1}, {"at_least", sweep.runs}, {"at_most", sweep.runs}, {"until", 0.0}};
  Json json = {{"schema", "ccdt.sweep/1"},
               {"name", "made-up"},
               {"seed", 1},
               {"verify", true},
               {"limits", {{"seconds", 60}, {"bytes", 4000000000}}},
               {"keep_meshes", false},
               {"identity", {{"machine.cpu", "made up"}}},
               {"mixed_with", Json::array()},
               {"cases", Json::array()}};
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const MadeUpCase& c = cases[i];
    Json input = {{"name", c.input.name}, {"file", "inputs/" + c.input.name}};
    if (!c.input.model.empty()) input["model"] = c.input.model;
    if (!c.input.model.empty()) input["edge_length"] = c.input.edge_length;
    Json options = Json::object();
    if (!c.lattice.empty()) options = {{"lattice", c.lattice}, {"locator", c.locator}};
    json["cases"].push_back({{"id", id_of(i)},
                             {"name", c.input.name + " " + c.mesher},
                             {"group", c.input.name},
                             {"input", input},
                             {"mesher", c.mesher},
                             {"options", options},
                             {"repetitions", repetitions}});
  }
  return json;
}

bench::RunRecord record_of(const MadeUpCase& c, double seconds, const std::string& file) {
  bench::RunRecord run;
  run.mesher = {c.mesher, "1.0", ""};
  run.mesher_settings = {{"switches", "pYq1.414a"}, {"threads", "1"}};
  run.input = {c.input.name, std::string(64, '0'), 1000, 2000, 300};
  run.command = {"ccdt", "mesh", "inputs/" + c.input.name, "-o", "again.vtu", "--report", file, "--mesher", c.mesher};
  if (!c.lattice.empty()) run.command.insert(run.command.end(), {"--lattice", c.lattice, "--locator", c.locator});
  run.environment.cpu = "made up";
  run.environment.cores = 2;
  run.counts.tetrahedra = static_cast<std::uint64_t>(c.input.size * (c.lattice == "bcc" ? 1.1 : 1));
  run.counts.vertices = run.counts.tetrahedra / 5;
  run.costs.mesh_seconds = seconds;
  run.costs[Stage::delaunay].seconds = 0.7 * seconds;
  run.peak_rss_bytes = 1000 * run.counts.tetrahedra;
  run.quality = bench::measure_quality({});
  run.quality.r = {1, 1.3, 1.2, 3, worst_r_of(c) * (1 + 0.1 * std::sin(c.input.size)), {{1, 2}, {3}}};
  run.quality.dihedral_degrees = {8, 165, {{0, 90, 180}, {1, 2}}};
  return run;
}

/// A record with the fields that a sweep adds.
void write_record(const bench::RunRecord& run, const MadeUpCase& c, const std::string& id, int number,
                  const std::string& kind, const std::filesystem::path& file) {
  Json json = Json::parse(bench::to_json(run));
  json["case"] = id;
  json["number"] = number;
  if (!kind.empty()) {
    json["kind"] = kind;
    json["reason"] = "made up";
  } else {
    json["mesh_fingerprint"] = c.input.name + c.lattice;
    json["verification"] = {{"right", true}, {"checks", Json::array()}, {"seconds", 0.01}};
  }
  io::OutputFile output(file);
  output << bench::to_text(json);
  output.commit();
}

}  // namespace

void write_made_up_sweep(const MadeUpSweep& sweep, const std::filesystem::path& folder) {
  using baselines::RunStatus;
  constexpr std::array<std::pair<const char*, RunStatus>, 4> kinds = {{{"timeout", RunStatus::timeout},
                                                                       {"crashed", RunStatus::crashed},
                                                                       {"refused", RunStatus::failed},
                                                                       {"out_of_memory", RunStatus::out_of_memory}}};
  std::filesystem::create_directories(folder / "runs");
  const std::vector<MadeUpCase> cases = cases_of(sweep);
  bench::write_json(description(sweep, cases), folder / "sweep.json");
  std::mt19937_64 random(7);
  const auto unit = [&random] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const MadeUpCase& c = cases[i];
    const bool fails = c.mesher != "ccdt" && unit() < sweep.failing * 3;
    const auto& [kind, status] = kinds.at(static_cast<std::size_t>(unit() * kinds.size()));
    const double noise = unit() < 0.05 ? 0.6 : 0.02;
    const double seconds = sweep.slowness * speed_of(c) * 4e-6 * std::pow(c.input.size, 1.05) * (0.9 + 0.2 * unit());
    for (int number = 0; number <= (fails ? 0 : sweep.runs); ++number) {
      const std::string file = "runs/" + id_of(i) + "-" + std::to_string(number) + ".json";
      bench::RunRecord run = record_of(c, seconds * (1 + noise * (unit() - 0.5)), file);
      if (fails) run.status = status;
      write_record(run, c, id_of(i), number, fails ? kind : "", folder / file);
    }
  }
}

}  // namespace ccdt
