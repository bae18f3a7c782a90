#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bench/experiments/experiment.h"
#include "bench/small_plcs/small_plc.h"
#include "bench/small_plcs/trial.h"

namespace ccdt::experiments {

using small_plcs::Family;
using small_plcs::SmallPlc;

/// The counts of the trials of one family of small PLCs.
struct FamilyTrials {
  Family family;
  std::vector<std::uint64_t> counts = {};  ///< one per column of the table
  std::uint64_t disagreements = 0;         ///< between the engine and the exhaustive tests, or among these
  std::string first_disagreement = {};     ///< with the PLC, in words
  SmallPlc counterexample = {};            ///< for each direction of the theorem, the first with the fewest vertices
  bool has_counterexample() const { return !counterexample.vertices.empty(); }
};
void add_trial(const small_plcs::Trial& trial, FamilyTrials& trials);

/// Tests the paper's Theorem 1 (section 5.2), "If and only if a model X is grazeable edge protected and face protected,
/// X has a DT", in both directions on random small PLCs by exhaustive search, and compares the engine with it.
///
/// \throw OutputError  a file of the experiment cannot be written
ExperimentResult measure_theorem1(const ExperimentOptions& options, cases::Runner& runner);
ExperimentResult theorem1_result(std::span<const FamilyTrials> families);

/// One input whose edges were protected in one way.
struct TerminationRow : CaseRow {
  std::string group;                          ///< the star, "solid", or "file"
  std::string label = {};                     ///< of the input within the group
  double degrees = 0;                         ///< asked for, of a star
  std::optional<double> smallest_angle = {};  ///< that segments enclose, in degrees
  Protection protection = Protection::midpoint;
};

/// Does the paper's edge protection, which inserts midpoints repeatedly (section 2), terminate? Protects our solids,
/// stars of segments that meet at smaller and smaller angles, and the user's files, by midpoints and by our shells.
///
/// \throw OutputError  a file of the experiment cannot be written
/// \throw InputError   none of the chosen models is part of it
ExperimentResult measure_termination(const ExperimentOptions& options, cases::Runner& runner);
ExperimentResult termination_result(std::span<const TerminationRow> rows);

/// One input with one lattice and one rule that keeps interior points away from the surface. Its counts say how many
/// points were placed, and how many were left out because they could have destroyed a protected edge.
struct InteriorRow : CaseRow {
  std::string model;
  double edge_length = 0;  ///< of one of our solids; 0: a file
  std::string rule;        ///< "paper", "no spheres", "no distances"
  Lattice lattice = Lattice::fcc;
};

/// Tests the paper's statement that interior points never do harm (section 3): by exhaustive search on small PLCs, and
/// by meshing all solids at several edge lengths and the user's files with all lattices and rules. Each is meshed once,
/// because the counts are always the same.
///
/// \throw OutputError  a file of the experiment cannot be written
/// \throw InputError   none of the chosen models is part of it
ExperimentResult measure_interior_points(const ExperimentOptions& options, cases::Runner& runner);
ExperimentResult interior_points_result(std::span<const InteriorRow> rows,
                                        std::span<const small_plcs::ExistenceTrials> trials);

}  // namespace ccdt::experiments
