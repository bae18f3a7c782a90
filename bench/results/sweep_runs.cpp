#include "bench/results/sweep_runs.h"

#include <algorithm>
#include <charconv>
#include <unordered_map>
#include <utility>

#include "bench/run/in_parallel.h"

namespace ccdt::results {
namespace {

/// The cases without their runs.
Sweep sweep_of(const sweep::SweepDocument& document, const std::filesystem::path& folder) {
  Sweep sweep{.folder = folder, .name = document.name};
  for (const sweep::SweepCase& one : document.cases) {
    sweep.cases.push_back({one});
    for (const auto& [option, value] : one.options)
      if (std::ranges::find(sweep.options, option) == sweep.options.end()) sweep.options.push_back(option);
  }
  for (CaseRuns& one : sweep.cases)
    for (const std::string& name : sweep.options) {
      const auto option = std::ranges::find(one.options, name, [](const auto& o) { return o.first; });
      one.values.push_back(option == one.options.end() ? "" : option->second);
    }
  return sweep;
}

/// The case of a record, by the first part of its file name, and the age of its identity: 0 is the current one.
struct Owner {
  std::size_t of = 0, age = 0;
};
using Owners = std::unordered_map<std::string, Owner>;

/// With mixed identities, cases also have other ids.
Owners owners_of(const sweep::SweepDocument& document) {
  Owners owners;
  for (std::size_t i = 0; i < document.cases.size(); ++i) owners.emplace(document.cases[i].id, Owner{i, 0});
  for (std::size_t i = 0; i < document.cases.size(); ++i)
    for (std::size_t k = 0; k < document.cases[i].older_ids.size(); ++k)
      owners.emplace(document.cases[i].older_ids[k], Owner{i, k + 1});
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
std::vector<Record> find_records(const std::filesystem::path& folder, const sweep::SweepDocument& document) {
  std::vector<Record> records;
  if (!std::filesystem::exists(folder / "runs")) return records;
  const Owners owners = owners_of(document);
  std::vector<std::size_t> newest(document.cases.size(), owners.size());
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
  const sweep::SweepDocument document = sweep::read_sweep(folder);
  Sweep sweep = sweep_of(document, folder);
  std::vector<Record> records = find_records(folder, document);
  read_all(folder, records);
  for (Record& record : records) {
    if (record.is_broken)
      ++sweep.broken_records;
    else
      sweep.cases[record.owner.of].runs.push_back(std::move(record.run));
  }
  return sweep;
}

}  // namespace ccdt::results
