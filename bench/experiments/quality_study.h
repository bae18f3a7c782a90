#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/experiments/even_surface.h"
#include "bench/experiments/experiment.h"
#include "bench/quality.h"
#include "engine/base/progress.h"
#include "engine/mesher.h"

namespace ccdt {

/// How far the numbers of tetrahedra of two meshes may be apart for their quality to be compared, as a fraction.
inline constexpr double equal_count_tolerance = 0.15;

/// One way to fill a surface: a mesher with options.
struct QualityVariant {
  std::string name;                      ///< for people
  std::string mesher;                    ///< as in `--mesher`
  std::vector<std::string> words;        ///< options of `ccdt mesh`, but for `--edge-length` and `--grading`
  std::vector<std::string> labels = {};  ///< what tells its rows from others: a value for each label of the plan
};

/// A variant on a surface.
struct QualityRow {
  std::string variant;
  std::vector<std::string> labels;
  double edge_length = 0;           ///< that it was asked for
  std::vector<double> samples;      ///< seconds of meshing in the counted runs, in order
  std::optional<Estimate> seconds;  ///< none if a run failed
  double improve_seconds = 0;       ///< median; 0 for meshers that do not tell
  MeshCounts counts;
  Quality quality;
  bool is_comparable = false;  ///< about as many tetrahedra as the first row has
  RunStatus status = RunStatus::ok;
  std::string reason;
  std::vector<std::string> runs = {};  ///< files of the runs
  bool is_ours = true;                 ///< made by our engine
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
  std::vector<Column> labels;  ///< of the variants
  std::vector<QualityCase> cases;
  std::vector<KeptMesh> meshes = {};
};

/// What is measured on every surface.
struct StudyPlan {
  std::string experiment;           ///< begins the names of its files
  std::vector<std::string> models;  ///< solids; the user's files come after them
  std::vector<Column> labels;       ///< of the variants
  std::vector<QualityVariant> variants;
  bool equal_counts = false;  ///< gives each variant the edge length for as many tetrahedra as the first has made
  bool once = false;          ///< the results are always the same and times do not matter: one run of each
  bool keeps_meshes = false;  ///< for the viewer, those that are small enough
};

/// Meshes with more tetrahedra are not kept: a page could not hold them.
inline constexpr std::uint64_t most_kept_tetrahedra = 150000;

/// The paper's three models.
std::vector<std::string> names_of_paper_models();

/// Measures the plan's models and the user's files, each with a surface of triangles of nearly one size on which our
/// FCC lattice, unimproved, makes the wanted number of tetrahedra. The variants take turns. Searches for edge lengths
/// are not counted.
///
/// \throw InputError   there is nothing to measure
/// \throw OutputError  a file of the experiment cannot be written
QualityStudy measure_study(const ExperimentOptions& options, const StudyPlan& plan, const Progress& progress);

/// The tables that all studies have, with the problems that came up: a row a mesh, its histograms, the surfaces.
ExperimentResult study_result(const QualityStudy& study);

/// "piston, 10,000 tetrahedra".
std::string title_of(const QualityCase& c);

/// What the rows of every study mean, one sentence each.
std::vector<std::string> study_definitions();

}  // namespace ccdt
