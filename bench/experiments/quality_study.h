#pragma once

#include <string>
#include <vector>

#include "bench/experiments/measured_case.h"
#include "bench/experiments/surfaces.h"
#include "bench/quality.h"

namespace ccdt::experiments {

/// How far the numbers of tetrahedra of two meshes may be apart for their quality to be compared, as a fraction.
inline constexpr double equal_count_tolerance = 0.15;

/// One way to fill a surface: a mesher with options.
struct QualityVariant {
  std::string name;                      ///< for people
  std::string mesher;                    ///< as in `--mesher`
  std::vector<std::string> words;        ///< options of `ccdt mesh`, but for `--edge-length` and `--grading`
  std::vector<std::string> labels = {};  ///< what tells its rows from others: a value for each label of the plan
};

/// A variant on a surface. Seconds are of meshing.
struct QualityRow : CaseOutcome {
  std::string variant;
  std::vector<std::string> labels;
  double edge_length = 0;      ///< that it was asked for
  double improve_seconds = 0;  ///< median; 0 for meshers that do not tell
  bench::Quality quality = {};
  bool is_comparable = false;  ///< about as many tetrahedra as the first row has
  bool is_ours = true;         ///< made by our engine
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
  results::Circumstances how;
  std::vector<results::Column> labels;  ///< of the variants
  std::vector<QualityCase> cases;
  std::vector<results::KeptMesh> meshes = {};
};

/// What is measured on every surface.
struct StudyPlan {
  std::string experiment;               ///< begins the names of its files
  std::vector<std::string> models;      ///< solids; the user's files come after them
  std::vector<results::Column> labels;  ///< of the variants
  std::vector<QualityVariant> variants;
  bool equal_counts = false;  ///< gives each variant the edge length for as many tetrahedra as the first has made
  bool once = false;          ///< the results are always the same and times do not matter: one run of each
  bool keeps_meshes = false;  ///< for the viewer, those that are small enough
};

/// Meshes with more tetrahedra are not kept: a page could not hold them.
inline constexpr std::uint64_t most_kept_tetrahedra = 150000;

/// Measures the plan's models and the user's files, each with a surface of triangles of nearly one size on which our
/// FCC lattice, unimproved, makes the wanted number of tetrahedra. The variants take turns. Searches for edge lengths
/// are not counted.
///
/// \throw InputError   there is nothing to measure
/// \throw OutputError  a file of the experiment cannot be written
QualityStudy measure_study(const ExperimentOptions& options, const StudyPlan& plan, const Progress& progress);

/// The definitions and tables that all studies have, with the problems that came up: a row a mesh, its histograms, the
/// surfaces.
///
/// \param definitions  more of what the rows mean, one sentence each
results::ExperimentResult study_result(const QualityStudy& study, const std::vector<std::string>& definitions);

}  // namespace ccdt::experiments
