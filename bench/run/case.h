#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "baselines/process.h"
#include "bench/run/run_record.h"
#include "bench/run/statistics.h"
#include "engine/mesher.h"

namespace ccdt::bench {

/// How often a case is run.
struct Repetitions {
  int warm_up = 0;   ///< runs before those that count; they have the first numbers
  int at_least = 1;  ///< counted runs
  int at_most = 1;
  double until = 0;  ///< stop at the first look (see `looks_of`) where the half-width of the median's interval is at
                     ///< most this share of the median; 0: stop at `at_least`
  double budget_seconds = 0;  ///< stop at a look if meshing up to the next look would exceed this; 0: no limit
};

/// The numbers of counted runs after which a case may stop. Its interval takes them into account.
std::vector<int> looks_of(const Repetitions& repetitions);

/// Are these counted runs enough?
///
/// \param samples       the measured quantity
/// \param mesh_seconds  of all of them together
bool are_enough(const Repetitions& repetitions, std::span<const double> samples, double mesh_seconds);

/// The quantity of a run that is measured: seconds of one stage, of several, or of all.
using SecondsOf = std::function<double(const StageCosts&)>;

/// One mesher on one input with one set of options.
struct Case {
  std::string name;                       ///< for people
  std::string group;                      ///< cases of one group are compared, so their repetitions take turns
  std::string mesher = "ccdt";            ///< one of this build, or a file that describes another
  std::filesystem::path input;            ///< exists
  std::vector<std::string> options = {};  ///< more words of the command line of `ccdt mesh`
  baselines::Limits limits = {};          ///< of each run
  bool verify = false;                    ///< check each mesh exactly against its input
  std::string mesh_ending = {};  ///< keep the mesh of the last run, as meshes/ID and this; empty: no mesh is kept
  Repetitions repetitions = {};
  SecondsOf seconds = &StageCosts::mesh_seconds;  ///< the quantity to which `repetitions.until` applies
};

/// A case with the records of its runs.
struct MeasuredCase {
  Case asked;
  std::string id = {};  ///< hash of all that determines the result; the records' names begin with it
  std::vector<std::string> older_ids = {};  ///< with the other identities that are accepted, in their order
  int runs = 0;                             ///< number of records, numbered from 0
  RunRecord first = {};                     ///< the first run, or the one that failed; meaningless without runs
  std::vector<RunRecord> counted = {};      ///< successful runs without the warm-up
  bool failed() const { return runs > 0 && first.status != baselines::RunStatus::ok; }
};

/// Takes the record of the next run.
void add_run(MeasuredCase& measured, RunRecord record);

/// Does the case need another run? A failed case does not.
bool needs_run(const MeasuredCase& measured);

/// At least this many more runs, up to the next look, and at most this many.
struct RunsLeft {
  int least = 0, most = 0;
};
RunsLeft runs_left(const MeasuredCase& measured);

/// The file of a run, relative to the folder: "runs/ID-NUMBER.json".
std::string run_file(const std::string& id, int number);

/// The files of the runs behind a row of this case, relative to the folder: the counted ones, or the one that failed.
std::vector<std::string> run_files(const MeasuredCase& measured);

/// The file in which the mesh of a case is kept, relative to the folder: "meshes/ID.ENDING".
std::string mesh_file(const MeasuredCase& measured);

/// One number of each counted run.
std::vector<double> samples_of(const MeasuredCase& measured, const SecondsOf& seconds);

/// The median of these seconds with its interval.
/// \pre there is a counted run
Estimate median_of(const MeasuredCase& measured, const SecondsOf& seconds);

}  // namespace ccdt::bench
