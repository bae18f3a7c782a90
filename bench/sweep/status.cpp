#include "bench/sweep/status.h"

#include <nlohmann/json.hpp>
#include <set>

#include "bench/run/numbers.h"

namespace ccdt::sweep {
namespace {

/// The ids at the beginning of the names of record files, one for each file.
std::multiset<std::string> recorded_ids(const std::filesystem::path& folder) {
  std::multiset<std::string> ids;
  std::error_code error;  // no folder: no records
  for (const auto& entry : std::filesystem::directory_iterator(folder / "runs", error)) {
    const std::string name = entry.path().filename().string();
    if (entry.path().extension() == ".json") ids.insert(name.substr(0, name.find('-')));
  }
  return ids;
}

}  // namespace

std::string failure_of(const bench::MeasuredCase& measured) {
  const bench::RunRecord& record = measured.first;
  return std::string(record.kind ? name_of(record.kind.value()) : name_of(record.status));
}

SweepStatus status_of(std::span<const bench::MeasuredCase> cases, const std::filesystem::path& folder) {
  std::set<std::string> known;
  SweepStatus status;
  for (const bench::MeasuredCase& measured : cases) {
    ++status.cases;
    known.insert(measured.id);
    if (bench::needs_run(measured))
      ++status.missing;
    else if (!measured.failed())
      ++status.finished;
    else
      ++status.failures[failure_of(measured)];
  }
  status.failed = status.cases - status.missing - status.finished;
  for (const std::string& id : recorded_ids(folder)) {
    ++status.runs;
    if (!known.contains(id)) ++status.obsolete;
  }
  return status;
}

bench::Json to_json(const SweepStatus& status) {
  return {{"schema", "ccdt.status/1"},   {"cases", status.cases},      {"runs", status.runs},
          {"finished", status.finished}, {"failed", status.failed},    {"missing", status.missing},
          {"obsolete", status.obsolete}, {"failures", status.failures}};
}

std::string in_words(const SweepStatus& status) {
  using bench::with_separators;
  std::string text = with_separators(status.cases) + " cases: " + with_separators(status.finished) + " finished, " +
                     with_separators(status.failed) + " failed, " + with_separators(status.missing) + " missing\n";
  for (const auto& [kind, count] : status.failures) text += "  failed: " + kind + " " + with_separators(count) + "\n";
  text += with_separators(status.runs) + " records of runs";
  if (status.obsolete > 0) text += ", " + with_separators(status.obsolete) + " of them obsolete";
  return text + "\n";
}

}  // namespace ccdt::sweep
