#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "baselines/mesher.h"
#include "baselines/process.h"
#include "bench/run/environment.h"
#include "bench/run/json.h"
#include "bench/run/quality.h"
#include "bench/run/requirements.h"
#include "engine/options/option_table.h"

namespace ccdt::bench {

/// The result of the exact verifier for the mesh of a run.
struct VerifiedMesh {
  struct FailedCheck {
    std::string name;
    std::uint64_t checked = 0, failed = 0;
  };
  bool right = false;
  std::vector<FailedCheck> checks = {};  ///< failed checks that make the mesh wrong
  double seconds = 0;
};

/// How a repaired input differs from the file, in units of the input; see `repair::Certificate`.
struct RepairedInput {
  double displacement = 0, area_of_lids = 0, area_removed = 0;
};

/// One run of one mesher on one input, written as JSON of schema `ccdt.run/1`.
struct RunRecord {
  using Option = options::OptionValue;

  struct MesherName {
    std::string name, version, revision;
  } mesher;
  struct Input {
    std::string name, sha256;
    std::uint64_t vertices = 0, facets = 0, segments = 0;
    std::uint64_t nonplanar_facets = 0;  ///< polygons that were triangulated because they are warped
    double largest_deviation = 0;        ///< of their corners from a plane, in the units of the input
  } input;
  std::vector<std::pair<std::string, Option>> options;
  std::vector<std::pair<std::string, std::string>> mesher_settings;  ///< in the terms of the mesher
  std::vector<std::string> command;  ///< the command, in the folder where it ran; empty if unknown
  Environment environment;
  MeshCounts counts;
  StageCosts costs;  ///< zero where another mesher does not tell, or an older program did not
  double read_seconds = 0, write_seconds = 0;
  std::uint64_t peak_rss_bytes = 0;
  Quality quality;
  std::string mesh_fingerprint;                         ///< see bench/run/fingerprint.h; empty without a mesh
  std::map<std::string, std::uint64_t> limits_reached;  ///< of `limit_counts`, those that are not 0
  double largest_rounding = 0;
  baselines::RunStatus status = baselines::RunStatus::ok;
  std::optional<baselines::FailureKind> kind;  ///< of a failure; older programs did not write it
  std::string reason;                          ///< why the status is not ok
  std::string stage;                           ///< in which a signal ended the run; otherwise empty
  std::string case_id;                         ///< the case of this run; empty outside a sweep
  std::optional<int> number;                   ///< of the run among those of its case, from 0
  std::optional<VerifiedMesh> verification;
  std::optional<RepairedInput> repaired;                 ///< only if the input was repaired before it was meshed
  std::optional<surface::SurfaceChange> surface_change;  ///< only if the surface was remeshed
  Requirements required;                                 ///< of the mesh
  std::vector<MissedRequirement> missed;                 ///< those that it misses
  std::vector<std::string> notes;                        ///< what a reader must know
  std::map<std::string, std::vector<double>> samples;    ///< raw seconds by name, if one record stands for several runs

  /// Sets the name and the counts of the input.
  void set_input(const InputPlc& its);

  /// Sets the costs, and the limits that are counted among them.
  void set_costs(const StageCosts& its);

  /// Replaces the option of this name, or adds it.
  void set_option(std::string_view name, const Option& value);

  /// Records a failure; also sets the status.
  void set_failure(baselines::FailureKind why, std::string words);
};

/// The name of an option in a record: "edge_length" for "edge-length".
std::string option_key(std::string_view name);

/// A record of the mesher, the input and the options, before anything is done.
RunRecord start_record(const baselines::Mesher& mesher, const InputPlc& input, const MeshOptions& options);

/// Adds the end of its process to the record of a run. A process that failed by itself wrote more into its record than
/// its exit code says; a killed one could not.
void note_end(const baselines::ProcessResult& ended, RunRecord& record);

/// The document of a run.
inline constexpr DocumentKind run_document = {"ccdt.run/1", "not a report of schema ccdt.run/1",
                                              "give the JSON that `ccdt mesh --report` wrote"};

/// What a document has at a path, "seconds.mesh"; null if there is nothing. For readers that need few of its values, or
/// values whose names come from elsewhere.
const Json& value_at(const Json& json, std::string_view path);

/// As JSON of schema `ccdt.run/1`, indented.
std::string to_json(const RunRecord& record);
/// \throw InputError  it is not JSON of that schema
RunRecord run_record_from_json(const std::string& text);

/// Writes the file whole or not at all. \throw OutputError
void write_run_record(const RunRecord& record, const std::filesystem::path& file);
/// \throw InputError  it cannot be read, or is not JSON of that schema
RunRecord read_run_record(const std::filesystem::path& file);
/// The same; none if there is no such file, or it is not a record.
std::optional<RunRecord> find_run_record(const std::filesystem::path& file);

}  // namespace ccdt::bench
