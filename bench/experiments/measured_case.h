#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bench/experiments/experiment.h"
#include "bench/run_record.h"

namespace ccdt::experiments {

/// A call of `ccdt mesh` to measure.
struct MeshCall {
  std::string mesher;
  std::filesystem::path input;
  std::filesystem::path output;      ///< where its mesh goes
  std::vector<std::string> options;  ///< more of the command line
};

/// A call with the records of its runs.
struct MeasuredCase {
  std::string name;  ///< within its group
  std::string stem;  ///< of the names of its records: "piston-with_check"
  MeshCall call;
  std::vector<RunRecord> counted = {};
  RunRecord first = {};       ///< of the run that is not counted, or of the one that failed
  std::size_t first_run = 0;  ///< the number of that run
  bool failed() const { return first.status != baselines::RunStatus::ok; }
};

/// Runs a call in a child process of its own and returns its record, which is also written to `report`. A child that
/// crashes or meets a limit has a record as well, with its status and the reason.
///
/// The child runs in the experiment's folder and gets paths relative to it, so that its command can be repeated
/// wherever that folder has been moved to.
///
/// \throw OutputError  the record cannot be written
RunRecord run_call(const ExperimentOptions& options, const MeshCall& call, const std::filesystem::path& report);

/// Is the run of this number still to be made, now that the case has been run once? Cases of which a run takes long are
/// counted three times at most. What is long depends on the scale: a second with 10,000 tetrahedra a model.
bool is_counted(const ExperimentOptions& options, const MeasuredCase& measured, int number);

/// Runs a case once, unless it has failed before; run 0 is not counted. Its record goes to runs/STEM-NUMBER.json.
/// \throw OutputError  the record cannot be written
void run_once(const ExperimentOptions& options, MeasuredCase& measured, int number);

/// Called before or after a run of a case, with the number of the run.
using RunCallback = std::function<void(MeasuredCase&, int number)>;

/// Runs the cases in turn (A B C A B C ...): run `first_number` of each, then the next, up to `options.runs`.
void run_in_turn(const ExperimentOptions& options, std::vector<MeasuredCase>& cases, int first_number,
                 const RunCallback& before, const RunCallback& after = {});

/// The files of the runs that a row of this case stands on, relative to the folder: the counted ones, or the one that
/// failed.
std::vector<std::string> run_files(const MeasuredCase& measured);

/// Keeps the mesh that the case has just made, for pictures: in meshes/STEM.json.
/// \pre it has not failed, and its mesh is still there
/// \throw OutputError
KeptMesh keep_mesh(const ExperimentOptions& options, const MeasuredCase& measured, const std::string& title);

/// The seconds of a run that are of interest.
using SecondsOf = std::function<double(const StageSeconds&)>;

/// One number of each counted run.
std::vector<double> samples_of(const MeasuredCase& measured, const SecondsOf& seconds);

/// What the rows of all experiments say of a case.
struct CaseOutcome {
  baselines::RunStatus status = baselines::RunStatus::ok;
  std::string reason = {};             ///< why the status is not ok
  std::vector<std::string> runs = {};  ///< files of the runs
  MeshCounts counts = {};
  std::vector<double> samples = {};      ///< seconds of the counted runs, in order
  std::optional<Estimate> seconds = {};  ///< their median; none if a run failed
  bool ok() const { return status == baselines::RunStatus::ok; }
  /// "timeout: limit of 600 s"
  std::string failure() const;
};
/// Without seconds.
CaseOutcome outcome_of(const MeasuredCase& measured);
CaseOutcome outcome_of(const MeasuredCase& measured, const SecondsOf& seconds);

}  // namespace ccdt::experiments
