#include "bench/sweep_results/sweep_runs.h"

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>
#include <unordered_map>
#include <utility>

#include "bench/run/identity.h"
#include "bench/run/in_parallel.h"
#include "bench/run/json.h"
#include "bench/sweep/sweep_document.h"

namespace ccdt::sweep_results {
namespace {

constexpr bench::DocumentKind sweep_document = {"ccdt.sweep/1", "not a sweep of schema ccdt.sweep/1",
                                                "give a folder that `ccdt sweep` has filled"};

/// A value of an option as typed.
std::string option_text(const bench::Json& value) {
  if (value.is_string()) return value;
  if (value.is_boolean()) return value.get<bool>() ? "on" : "off";
  return value.dump();
}

void read_wanted(const bench::Json& json, bench::Repetitions& wanted) {
  wanted.warm_up = json.value("warm_up", wanted.warm_up);
  wanted.at_least = json.value("at_least", wanted.at_least);
  wanted.at_most = json.value("at_most", wanted.at_most);
  wanted.until = json.value("until", wanted.until);
}

SweepCase case_from(const bench::Json& json, Sweep& sweep) {
  SweepCase made;
  const bench::Json& input = json.at("input");
  json.at("id").get_to(made.id);
  made.name = json.value("name", made.id);
  made.group = json.value("group", "");
  input.at("name").get_to(made.input);
  made.input_file = input.value("file", "");
  made.model = input.value("model", "");
  if (input.contains("edge_length")) made.edge_length = input["edge_length"].get<double>();
  json.at("mesher").get_to(made.mesher);
  if (std::filesystem::path(made.mesher).extension() == ".json")
    made.mesher = std::filesystem::path(made.mesher).stem().string();
  if (json.contains("repetitions")) read_wanted(json["repetitions"], made.wanted);
  const bench::Json options = json.value("options", bench::Json::object());
  for (const auto& [option, value] : options.items()) {
    auto at = std::ranges::find(sweep.options, option);
    if (at == sweep.options.end()) at = sweep.options.insert(at, option);
    made.options.resize(std::max(made.options.size(), static_cast<std::size_t>(at - sweep.options.begin()) + 1));
    made.options[static_cast<std::size_t>(at - sweep.options.begin())] = option_text(value);
  }
  return made;
}

Sweep sweep_from(const bench::Json& json) {
  Sweep sweep;
  sweep.name = json.value("name", "sweep");
  sweep.is_mixed = json.contains("mixed_with") && !json["mixed_with"].empty();
  if (json.contains("limits")) {
    sweep.limit_seconds = json["limits"].value("seconds", 0.0);
    sweep.limit_bytes = json["limits"].value("bytes", 0.0);
  }
  for (const bench::Json& one : json.at("cases")) sweep.cases.push_back(case_from(one, sweep));
  for (SweepCase& one : sweep.cases) one.options.resize(sweep.options.size());
  return sweep;
}

/// The case of a record, by the first part of its file name, and the age of its identity: 0 is the current one.
struct Owner {
  std::size_t of = 0, age = 0;
};
using Owners = std::unordered_map<std::string, Owner>;

/// With mixed identities, cases also have other ids.
Owners owners_of(const std::filesystem::path& folder, const Sweep& sweep) {
  Owners owners;
  for (std::size_t i = 0; i < sweep.cases.size(); ++i) owners.emplace(sweep.cases[i].id, Owner{i, 0});
  if (!sweep.is_mixed) return owners;
  const sweep::SweepDocument document = sweep::read_sweep(folder);
  bench::FileHashes hashes;
  for (std::size_t age = 1; age < document.identities.size(); ++age)
    for (std::size_t i = 0; i < document.cases.size(); ++i)
      owners.emplace(id_of(document.cases[i].asked, document.identities[age], hashes), Owner{i, age});
  return owners;
}

/// An existing record and its case.
struct Record {
  Owner owner;
  NumberedRun run;
  bool is_broken = false;
};

/// The records of the cases, by their file names ID-NUMBER.json. A case that was run with the current identity has only
/// these records.
std::vector<Record> find_records(const std::filesystem::path& folder, const Sweep& sweep) {
  std::vector<Record> records;
  if (!std::filesystem::exists(folder / "runs")) return records;
  const Owners owners = owners_of(folder, sweep);
  std::vector<std::size_t> newest(sweep.cases.size(), owners.size());
  for (const auto& entry : std::filesystem::directory_iterator(folder / "runs")) {
    if (entry.path().extension() != ".json") continue;
    const std::string stem = entry.path().stem().string();
    const std::size_t dash = std::min(stem.rfind('-'), stem.size());
    const auto owner = owners.find(stem.substr(0, dash));
    int number = -1;
    std::from_chars(stem.data() + std::min(dash + 1, stem.size()), stem.data() + stem.size(), number);
    if (owner == owners.end() || number < 0) continue;
    newest[owner->second.of] = std::min(newest[owner->second.of], owner->second.age);
    records.push_back({owner->second, {number, "runs/" + entry.path().filename().string(), {}}});
  }
  std::erase_if(records, [&](const Record& r) { return r.owner.age != newest[r.owner.of]; });
  std::ranges::sort(records, {}, [](const Record& r) { return std::pair(r.owner.of, r.run.number); });
  return records;
}

void read_all(const std::filesystem::path& folder, std::vector<Record>& records) {
  bench::in_parallel(records.size(), [&](std::size_t i) {
    auto values = read_run_values(folder / records[i].run.file);
    records[i].is_broken = !values;
    if (values) records[i].run.values = std::move(*values);
  });
}

}  // namespace

Sweep read_sweep(const std::filesystem::path& folder) {
  Sweep sweep = bench::read_document(folder / sweep_file, sweep_document, sweep_from);
  std::vector<Record> records = find_records(folder, sweep);
  read_all(folder, records);
  for (Record& record : records) {
    if (record.is_broken)
      ++sweep.broken_records;
    else
      sweep.cases[record.owner.of].runs.push_back(std::move(record.run));
  }
  return sweep;
}

}  // namespace ccdt::sweep_results
