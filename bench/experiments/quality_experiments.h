#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bench/experiments/measured_case.h"
#include "bench/experiments/surfaces.h"
#include "bench/quality.h"
#include "engine/base/enum_names.h"

namespace ccdt::experiments {

/// Within which an edge length is looked for that makes a wanted number of tetrahedra.
struct CountSearch {
  double wanted = 0;    ///< tetrahedra
  double first = 0;     ///< edge length that is tried first
  double shortest = 0;  ///< edge lengths that may be tried
  double longest = 1e300;
  double tolerance = 0.05;  ///< of the number, as a fraction: near enough
  int most_tries = 8;
};

/// The try that came nearest.
struct CountFound {
  double edge_length = 0;
  double count = 0;
  bool is_near = false;  ///< within the tolerance
};

/// Looks for an edge length by the secant through the logarithms of the last two tries (the number of tetrahedra is
/// nearly a power of the edge length, and the third negative one at first), held within what earlier tries enclose. The
/// last try is the one that came near, if any did.
///
/// It ends when longer edges make hardly fewer tetrahedra.
///
/// \param count_of  tetrahedra at an edge length; none if the mesher failed there, which ends the search
/// \return          none if no try has gone well
std::optional<CountFound> search_edge_length(const CountSearch& search,
                                             const std::function<std::optional<std::uint64_t>(double)>& count_of);

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
ExperimentResult study_result(const QualityStudy& study, const std::vector<std::string>& definitions);

/// The criteria by which a comparison of quality is made.
enum class Criterion { mean_r, p99_r, worst_r, smallest_dihedral, largest_dihedral };

constexpr auto names_of(Criterion) {
  return std::to_array<NamedValue<Criterion>>({{Criterion::mean_r, "mean r"},
                                               {Criterion::p99_r, "p99 r"},
                                               {Criterion::worst_r, "worst r"},
                                               {Criterion::smallest_dihedral, "smallest dihedral"},
                                               {Criterion::largest_dihedral, "largest dihedral"}});
}
double value_of(const bench::Quality& quality, Criterion criterion);
/// Is a strictly better than b?
bool is_better(Criterion criterion, double a, double b);

/// What every mesher is compared by.
inline constexpr std::array judged_criteria = {Criterion::mean_r, Criterion::p99_r, Criterion::worst_r,
                                               Criterion::smallest_dihedral};

/// Our meshes beside those of other meshers, at equal numbers of tetrahedra.
struct MesherQuality : QualityStudy {};

/// Whether one of our rows is better than all others' by one criterion.
struct QualityComparison {
  Criterion criterion = Criterion::mean_r;
  double ours = 0;
  double best = 0;           ///< of the others
  std::string best_variant;  ///< whose that is; empty if there is no other to compare with
  bool is_better() const { return !best_variant.empty() && experiments::is_better(criterion, ours, best); }
};

/// By all judged criteria, against the comparable rows of other meshers. None if the row itself failed.
std::vector<QualityComparison> compare_with_others(const QualityCase& c, const QualityRow& ours);

/// Measures ccdt with its FCC lattice, improved and not, and with BCC, and TetGen, Mesh_3 and HXT (what of these the
/// build has, or the machine) on every surface, at equal numbers of tetrahedra.
///
/// \param experiment  begins the names of its files
/// \throw InputError, OutputError  as `measure_study`
MesherQuality measure_mesher_quality(const ExperimentOptions& options, const std::string& experiment,
                                     const std::vector<std::string>& models, const Progress& progress = {});

ExperimentResult result_of(const MesherQuality& quality);

/// The three lattices, each before and after improvement.
struct Lattices : QualityStudy {};

/// The criteria in which the lattices are compared.
inline constexpr std::array lattice_criteria = {Criterion::mean_r, Criterion::p99_r, Criterion::worst_r,
                                                Criterion::smallest_dihedral, Criterion::largest_dihedral};

/// The paper's claim (section 3, after Radovitzky and Ortiz) that the FCC lattice makes the best tetrahedra, by one
/// criterion.
struct LatticeClaim {
  Criterion criterion = Criterion::mean_r;
  bool improved = false;
  std::uint64_t cases = 0;                 ///< in which all three went well
  std::array<std::uint64_t, 3> best = {};  ///< in how many of these fcc, bcc and sc are the best; at a tie all of them
  bool is_confirmed() const { return cases > 0 && best[0] == cases && best[1] == 0 && best[2] == 0; }
};

/// One for each criterion, before and after improvement.
std::vector<LatticeClaim> lattice_claims(const Lattices& lattices);

/// Measures FCC, BCC and SC at the same edge length on every surface.
///
/// \throw InputError, OutputError  as `measure_study`
Lattices measure_lattices(const ExperimentOptions& options, const Progress& progress = {});

ExperimentResult result_of(const Lattices& lattices);

/// What each part of the improvement does alone: nothing, swaps, smoothing, all.
struct ImprovementParts : QualityStudy {};

/// Measures the four on every surface, with the FCC lattice.
///
/// \throw InputError, OutputError  as `measure_study`
ImprovementParts measure_improvement(const ExperimentOptions& options, const Progress& progress = {});

ExperimentResult result_of(const ImprovementParts& parts);

/// How near to the surface lattice points may be.
struct LatticeSetting {
  double sphere_factor = 1;
  double clearance = lattice::usual_clearance;
  bool operator==(const LatticeSetting&) const = default;
};

/// The settings that are tried; the defaults of `ccdt mesh` among them.
std::vector<LatticeSetting> lattice_settings();
LatticeSetting default_lattice_setting();
/// "sphere 1, clearance 0.55"; the name of the setting's rows.
std::string text_of(const LatticeSetting& setting);

/// The same surfaces with many settings.
struct LatticeFit : QualityStudy {};

/// A setting over all cases in which every setting went well.
struct SettingSummary {
  LatticeSetting setting;
  double mean_r = 0, p99_r = 0;                    ///< means over the cases
  double worst_r = 0;                              ///< geometric mean
  double smallest_dihedral = 0;                    ///< mean
  double largest_worst_r = 0, least_dihedral = 0;  ///< of all cases
  double improve_seconds = 0;                      ///< sum
  double rank = 0;  ///< mean over cases and judged criteria; 1 is the best, ties share theirs
};

/// In the order of the settings; empty without such a case.
std::vector<SettingSummary> summarize(const LatticeFit& fit);

/// Tries all settings on every surface with the FCC lattice and all of the improvement.
///
/// \throw InputError, OutputError  as `measure_study`
LatticeFit measure_lattice_fit(const ExperimentOptions& options, const Progress& progress = {});

ExperimentResult result_of(const LatticeFit& fit);

}  // namespace ccdt::experiments
