#pragma once

#include <span>
#include <string>
#include <vector>

#include "bench/experiments/experiment.h"
#include "bench/experiments/surfaces.h"
#include "bench/surface_measures.h"

namespace ccdt::experiments {

/// One way to fill a surface: a mesher with options.
struct QualityVariant {
  std::string name;                      ///< for people
  std::string mesher;                    ///< as in `--mesher`
  std::vector<std::string> words;        ///< options of `ccdt mesh`, but for `--edge-length` and `--grading`
  std::vector<std::string> labels = {};  ///< what tells its rows from others: a value for each label of the plan
};

/// What is measured on every surface, and what follows from it.
struct StudyPlan {
  std::string experiment;           ///< begins the names of its files
  std::vector<std::string> models;  ///< solids; the user's files come after them
  std::vector<Column> labels;       ///< of the variants
  std::vector<QualityVariant> variants = {};
  std::vector<std::string> definitions = {};  ///< more of what the rows mean, one sentence each
  void (*conclude)(ExperimentResult&) = {};   ///< adds tables and findings to the tables that all studies have
  bool equal_counts = false;  ///< gives each variant the edge length for as many tetrahedra as the first has made
  bool once = false;          ///< the results are always the same and times do not matter: one run of each
  bool keeps_meshes = false;  ///< for the viewer, those that are small enough
};

/// A surface of triangles of nearly one size, for the variants to fill.
struct EvenSurface {
  std::string model;
  std::filesystem::path file;
  double edge_length = 0;
  bool remeshed = false;  ///< else its triangles are as they came, because they were even enough
  std::uint64_t vertices = 0, triangles = 0;
  bench::SurfaceAngles angles;
};

/// A variant on a surface. Seconds are of meshing.
struct QualityRow : CaseRow {
  std::string model;
  std::vector<std::string> labels;
  double edge_length = 0;       ///< that it was asked for
  std::uint64_t reference = 0;  ///< tetrahedra that the first variant has made
  /// Has it made about as many?
  bool is_comparable() const;
};

/// Meshes with more tetrahedra are not kept: a page could not hold them.
inline constexpr std::uint64_t most_kept_tetrahedra = 150000;

/// Measures the plan's models and the user's files, each with a surface of triangles of nearly one size on which our
/// FCC lattice, unimproved, makes the wanted number of tetrahedra. The variants take turns. Searches for edge lengths
/// are not counted.
///
/// \throw InputError   there is nothing to measure
/// \throw OutputError  a file of the experiment cannot be written
ExperimentResult measure_study(const ExperimentOptions& options, cases::Runner& runner, const StudyPlan& plan);

/// The tables that all studies have: a row a mesh, its histograms, the surfaces; with what the plan adds.
ExperimentResult study_result(const StudyPlan& plan, std::span<const QualityRow> rows,
                              std::span<const EvenSurface> surfaces);

}  // namespace ccdt::experiments
