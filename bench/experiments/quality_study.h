#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bench/experiments/experiment.h"
#include "bench/experiments/surfaces.h"
#include "bench/run/quality.h"
#include "bench/run/surface_measures.h"

namespace ccdt::experiments {

/// One way to fill a surface: a mesher with options.
struct QualityVariant {
  std::string name;                      ///< for people
  std::string mesher;                    ///< as in `--mesher`
  std::vector<std::string> words;        ///< options of `ccdt mesh`, except `--edge-length` and `--grading`
  std::vector<std::string> labels = {};  ///< labels of its rows: a value for each label of the plan
  bool measures_inside = false;          ///< also measure the tetrahedra away from the surface
};

/// The plan of a study: what is measured on every surface, and what is derived from it.
struct StudyPlan {
  std::string experiment;           ///< begins the names of its files
  std::vector<std::string> models;  ///< solids; the user's files come after them
  std::vector<Column> labels;       ///< of the variants
  std::vector<QualityVariant> variants = {};
  std::vector<std::string> definitions = {};  ///< further definitions, one sentence each
  void (*conclude)(ExperimentResult&) = {};   ///< adds tables and findings to those that all studies have
  bool equal_counts =
      false;          ///< gives each variant the edge length at which it makes as many tetrahedra as the first one
  bool once = false;  ///< results are deterministic and times do not matter: one run of each
  bool keeps_meshes = false;  ///< keep meshes for the viewer if they are small enough
};

/// A surface of triangles of nearly one size, for the variants to fill.
struct EvenSurface {
  std::string model;
  std::filesystem::path file;
  double edge_length = 0;
  bool remeshed = false;  ///< otherwise its triangles were even enough and are unchanged
  std::uint64_t vertices = 0, triangles = 0;
  bench::SurfaceAngles angles;
};

/// The tetrahedra of a mesh away from its surface (`inside_cells`).
struct InsideQuality {
  std::uint64_t tetrahedra = 0;
  bench::Quality quality = {};
};

/// How far the numbers of tetrahedra of comparable meshes may differ, as a share: if each variant has its own edge
/// length, chosen to make the numbers equal, and if all have the same edge length.
inline constexpr double tolerance_of_equal_counts = 0.03, tolerance_of_one_edge_length = 0.15;

/// A variant on a surface. Seconds are of meshing.
struct QualityRow : CaseRow {
  std::string model;
  std::vector<std::string> labels;
  double edge_length = 0;                    ///< target edge length
  std::uint64_t reference = 0;               ///< tetrahedra of the first variant
  std::optional<InsideQuality> inside = {};  ///< if its variant measures it; without tetrahedra if the run failed
  double tolerance = tolerance_of_equal_counts;
  /// Is the number of tetrahedra comparable?
  bool is_comparable() const;
};

/// Meshes with more tetrahedra are not kept: a page could not hold them.
inline constexpr std::uint64_t most_kept_tetrahedra = 150000;

/// Measures the models of the plan and the user's files. Each gets a surface of triangles of nearly one size, on which
/// our unimproved FCC lattice makes the wanted number of tetrahedra. The variants take turns. Searches for edge lengths
/// are not counted.
///
/// \throw InputError   there is nothing to measure
/// \throw OutputError  a file of the experiment cannot be written
ExperimentResult measure_study(const ExperimentOptions& options, bench::Runner& runner, const StudyPlan& plan);

/// The tables that all studies have (one row per mesh, histograms, surfaces), one of the tetrahedra inside if the plan
/// measures them, and those that it adds.
ExperimentResult study_result(const StudyPlan& plan, std::span<const QualityRow> rows,
                              std::span<const EvenSurface> surfaces);

}  // namespace ccdt::experiments
