#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/experiments/even_surface.h"
#include "bench/experiments/experiment.h"
#include "bench/json_parts.h"
#include "bench/quality.h"
#include "engine/base/progress.h"
#include "engine/mesher.h"

namespace ccdt {

/// How far the numbers of tetrahedra of two meshes may be apart for their quality to be compared, as a fraction.
inline constexpr double equal_count_tolerance = 0.15;

/// Cases of which a run takes longer than this are counted at most three times.
inline constexpr double long_quality_run_seconds = 10;

/// One way to fill a surface: a mesher with options.
struct QualityVariant {
  std::string name;                ///< for people
  std::string mesher;              ///< as in `--mesher`
  std::vector<std::string> words;  ///< options of `ccdt mesh`, but for `--edge-length` and `--grading`
};

/// A variant on a surface.
struct QualityRow {
  std::string variant;
  double edge_length = 0;           ///< that it was asked for
  std::vector<double> samples;      ///< seconds of meshing in the counted runs, in order
  std::optional<Estimate> seconds;  ///< none if a run failed
  double improve_seconds = 0;       ///< median; 0 for meshers that do not tell
  MeshCounts counts;
  Quality quality;
  bool is_comparable = false;  ///< about as many tetrahedra as the first row has
  RunStatus status = RunStatus::ok;
  std::string reason;
  bool ok() const { return status == RunStatus::ok; }
};

/// A surface at one size, filled by all variants.
struct QualityCase {
  std::string name;          ///< of the solid or of the file
  std::uint64_t wanted = 0;  ///< tetrahedra
  EvenSurface surface;
  std::vector<QualityRow> rows;  ///< none if there is no surface
  std::string reason;            ///< why there is none
};

struct QualityStudy {
  Circumstances how;
  std::vector<QualityCase> cases;
};

/// What is measured on every surface.
struct StudyPlan {
  std::string experiment;            ///< begins the names of its files
  std::vector<std::uint64_t> sizes;  ///< tetrahedra that the first variant is to make; divided by the scale
  std::vector<QualityVariant> variants;
  bool equal_counts = false;  ///< gives each variant the edge length for as many tetrahedra as the first has made
  bool once = false;          ///< the results are always the same and times do not matter: one run of each
};

/// Measures the paper's models and the user's files, each with a surface of triangles of nearly one size on which our
/// FCC lattice, unimproved, makes the wanted number of tetrahedra. The variants take turns. Searches for edge lengths
/// are not counted.
///
/// \throw InputError   there is nothing to measure
/// \throw OutputError  a file of the experiment cannot be written
QualityStudy measure_study(const ExperimentOptions& options, const StudyPlan& plan, const Progress& progress);

/// As JSON: the circumstances and all cases.
Json study_json(const std::string& schema, const std::vector<std::string>& definitions, const QualityStudy& study);

/// What the rows of every study mean, one sentence each.
std::vector<std::string> study_definitions();

}  // namespace ccdt
