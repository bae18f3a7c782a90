#include "bench/run/runner.h"

#include <algorithm>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <utility>

#include "bench/run/environment.h"
#include "bench/run/in_parallel.h"
#include "bench/run/run_case.h"
#include "engine/base/errors.h"

namespace ccdt::bench {
namespace {

/// The largest number of records that a case can have. Whether each run was needed was decided when it was made;
/// deciding that again would take longer than reading all records.
int most_runs(const Repetitions& repetitions) {
  return repetitions.warm_up + looks_of(repetitions).back();
}

/// The case with this id, and its records.
///
/// \param retried  failures of these cases count, even with `retry_failed`
MeasuredCase read_case(const RunnerSettings& settings, const Case& asked, const std::string& id,
                       const std::set<std::string>& retried) {
  MeasuredCase measured{asked, id};
  while (!measured.failed() && measured.runs < most_runs(asked.repetitions)) {
    auto record = find_run_record(settings.folder / run_file(id, measured.runs));
    if (!record) break;
    const bool failed = record->status != baselines::RunStatus::ok;
    if (failed && settings.retry_failed && !retried.contains(id)) break;
    add_run(measured, *std::move(record));
  }
  return measured;
}

/// The case with the first of these ids that has all its records, otherwise with the first id.
MeasuredCase find_case(const RunnerSettings& settings, const Case& asked, const std::vector<std::string>& ids,
                       const std::set<std::string>& retried) {
  MeasuredCase of_now = read_case(settings, asked, ids.front(), retried);
  for (std::size_t i = 1; i < ids.size() && of_now.runs == 0; ++i) {
    MeasuredCase older = read_case(settings, asked, ids[i], retried);
    if (older.runs > 0 && !needs_run(older)) return older;
  }
  return of_now;
}

/// Cases of a call, each with its own id.
using Group = std::vector<MeasuredCase*>;

/// The first of each id. Equal inputs make equal cases, which are run once.
Group distinct(std::vector<MeasuredCase>& cases) {
  Group firsts;
  std::set<std::string> known;
  for (MeasuredCase& measured : cases)
    if (known.insert(measured.id).second) firsts.push_back(&measured);
  return firsts;
}

/// The measurements of the first case of an id hold for all.
void share(const Group& firsts, std::vector<MeasuredCase>& cases) {
  std::map<std::string, const MeasuredCase*> by_id;
  for (const MeasuredCase* first : firsts) by_id[first->id] = first;
  for (MeasuredCase& measured : cases) {
    const MeasuredCase& first = *by_id.at(measured.id);
    if (&measured == &first) continue;
    Case asked = std::move(measured.asked);
    measured = first;
    measured.asked = std::move(asked);
  }
}

/// Counts runs for the progress, from any thread.
class RunCounter {
 public:
  RunCounter(const Progress& progress, const Group& cases) : progress_(progress) {
    for (const MeasuredCase* measured : cases) {
      done_ += static_cast<std::uint64_t>(measured->runs);
      total_ += static_cast<std::uint64_t>(measured->runs + runs_left(*measured).least);
    }
  }

  void begin(const MeasuredCase& measured) {
    const std::lock_guard lock(mutex_);
    report(progress_, measured.asked.name, done_, total_);
  }

  /// A case may turn out to need more runs, or none after a failure.
  void end(const MeasuredCase& measured, int left_before) {
    const std::lock_guard lock(mutex_);
    ++done_;
    total_ =
        total_ + 1 + static_cast<std::uint64_t>(runs_left(measured).least) - static_cast<std::uint64_t>(left_before);
    report(progress_, measured.asked.name, done_, total_);
  }

 private:
  const Progress& progress_;
  std::mutex mutex_;
  std::uint64_t done_ = 0, total_ = 0;
};

void run_counted(const RunPlace& place, MeasuredCase& measured, RunCounter& counter) {
  const int left_before = runs_left(measured).least;
  counter.begin(measured);
  run_next(place, measured);
  counter.end(measured, left_before);
}

/// The groups of cases that are compared with each other, in the order of their first cases.
std::vector<Group> groups_of(const Group& cases) {
  std::vector<Group> groups;
  std::map<std::string, std::size_t> known;
  for (MeasuredCase* measured : cases) {
    const auto [found, is_new] = known.try_emplace(measured->asked.group, groups.size());
    if (is_new) groups.emplace_back();
    groups[found->second].push_back(measured);
  }
  return groups;
}

/// The cases of a group that run next: those that need runs and have the fewest, in random order. The order depends on
/// the seed and the round alone, so that it is the same after an interruption.
Group next_round(const Group& group, std::uint64_t seed) {
  Group round;
  for (MeasuredCase* measured : group) {
    if (!needs_run(*measured)) continue;
    if (!round.empty() && measured->runs < round.front()->runs) round.clear();
    if (round.empty() || measured->runs == round.front()->runs) round.push_back(measured);
  }
  const auto key = [&](const MeasuredCase* measured) {
    return sha256_of_text(std::to_string(seed) + " " + std::to_string(measured->runs) + " " + measured->id);
  };
  std::ranges::sort(round, {}, key);
  return round;
}

void run_in_turn(const RunPlace& place, const Group& group, std::uint64_t seed, RunCounter& counter) {
  for (Group round = next_round(group, seed); !round.empty(); round = next_round(group, seed))
    for (MeasuredCase* measured : round) run_counted(place, *measured, counter);
}

/// Runs several cases at the same time, each with all its repetitions.
void run_beside(const RunPlace& place, const Group& cases, RunCounter& counter) {
  const auto run_all = [&](std::size_t i) {
    while (needs_run(*cases[i])) run_counted(place, *cases[i], counter);
  };
  in_parallel(cases.size(), run_all, static_cast<std::size_t>(place.jobs));
}

bool is_uncertain(const MeasuredCase& measured) {
  const double until = measured.asked.repetitions.until;
  return until > 0 && !measured.failed() && relative_spread(median_of(measured, measured.asked.seconds)) > until;
}

}  // namespace

Runner::Runner(RunnerSettings settings) : settings_(std::move(settings)) {}

std::vector<MeasuredCase> Runner::load(std::span<const Case> cases) {
  std::vector<std::vector<std::string>> ids(cases.size());
  for (std::size_t i = 0; i < cases.size(); ++i)  // here, because only one thread may use the hashes
    for (const Identity& identity : settings_.identities) ids[i].push_back(id_of(cases[i], identity, hashes_));
  std::vector<MeasuredCase> all(cases.size());
  in_parallel(cases.size(), [&](std::size_t i) {
    all[i] = find_case(settings_, cases[i], ids[i], tried_);
    all[i].older_ids.assign(ids[i].begin() + 1, ids[i].end());
  });
  return all;
}

std::vector<MeasuredCase> Runner::run(std::span<const Case> cases) {
  std::vector<MeasuredCase> all = load(cases);
  const Group different = distinct(all);
  RunCounter counter(settings_.progress, different);
  const RunPlace place{settings_.program, settings_.folder, settings_.jobs};
  if (settings_.jobs > 1)
    run_beside(place, different, counter);
  else
    for (const Group& group : groups_of(different)) run_in_turn(place, group, settings_.seed, counter);
  share(different, all);

  for (const MeasuredCase& measured : all) {
    tried_.insert(measured.id);
    if (is_uncertain(measured)) uncertain_.insert(measured.asked.name);
    const bool is_kept = measured.asked.mesh_ending.empty() || exists(settings_.folder / mesh_file(measured));
    if (!is_kept && !measured.failed()) make_mesh_again(place, measured);
  }
  return all;
}

MeasuredCase Runner::run(const Case& asked) {
  return run(std::span(&asked, 1)).front();
}

}  // namespace ccdt::bench
