#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bench/experiments/experiment.h"
#include "bench/experiments/small_plcs/small_plc.h"
#include "bench/experiments/small_plcs/trial.h"
#include "engine/plc/plc.h"

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
ExperimentResult measure_theorem1(const ExperimentOptions& options, bench::Runner& runner);
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
ExperimentResult measure_termination(const ExperimentOptions& options, bench::Runner& runner);
ExperimentResult termination_result(std::span<const TerminationRow> rows);

/// One input with one lattice and one rule that keeps interior points away from the surface. Its counts say how many
/// points were placed, and how many were left out because they could have destroyed a protected edge.
struct InteriorRow : CaseRow {
  std::string model;
  double edge_length = 0;  ///< of one of our solids; 0: a file
  std::string rule;        ///< "paper", "no spheres", "no distances"
  Lattice lattice = Lattice::fcc;
};

/// Tests the paper's statement that interior points never do harm (section 3). Searches small PLCs exhaustively, and
/// meshes the user's files, and all solids at several edge lengths, with all lattices and rules. Each is meshed once,
/// because the counts are always the same.
///
/// \throw OutputError  a file of the experiment cannot be written
/// \throw InputError   none of the chosen models is part of it
ExperimentResult measure_interior_points(const ExperimentOptions& options, bench::Runner& runner);
ExperimentResult interior_points_result(std::span<const InteriorRow> rows,
                                        std::span<const small_plcs::ExistenceTrials> trials);

/// One input, with the Steiner vertices that a conforming Delaunay tetrahedralization needs. The number that the CDT
/// needs is in the counts of its run.
struct ConformingRow : CaseRow {
  std::string model;
  double edge_length = 0;  ///< of one of our solids; 0: a file
  Protection protection = Protection::midpoint;
  std::uint64_t missing_segments = 0,
                missing_faces = 0;               ///< in the Delaunay tetrahedralization of the input's vertices
  std::uint64_t on_segments = 0, in_facets = 0;  ///< Steiner vertices of the conforming tetrahedralization
  bool is_conforming = false;                    ///< it was found within its limits
};

/// Compares the Steiner vertices of our CDT with those of a conforming Delaunay tetrahedralization (paper, section 1:
/// "CCDT adds fewer vertices"). The inputs are our solids, also flattened, the parts in the repository, and the user's
/// files.
///
/// \throw OutputError  a file of the experiment cannot be written
/// \throw InputError   none of the chosen models is part of it
ExperimentResult measure_conforming(const ExperimentOptions& options, bench::Runner& runner);
ExperimentResult conforming_result(std::span<const ConformingRow> rows);

/// One input, with or without interior points, and both conditions for a Delaunay tetrahedralization that contains it.
struct ConditionsRow : CaseRow {
  std::string model;
  double edge_length = 0;  ///< of one of our solids; 0: a file
  Lattice lattice = Lattice::none;
  std::uint64_t faces = 0;
  std::uint64_t occupied = 0;        ///< faces whose smallest sphere holds a vertex: against Radovitzky and Ortiz
  std::uint64_t touched = 0;         ///< faces with a vertex on that sphere and none in it
  std::uint64_t undelaunay = 0;      ///< faces that are not Delaunay: against Theorem 1
  std::uint64_t missing_edges = 0;   ///< grazeable segments that are not Delaunay: the same
  std::uint64_t contradictions = 0;  ///< undelaunay faces with nothing in or on their smallest sphere; must be 0

  bool fulfills_theirs() const { return occupied == 0; }
  bool fulfills_theorem() const { return undelaunay == 0 && missing_edges == 0; }
};

/// Finds the violations of both conditions in a PLC with these interior points (grid units).
void count_violations(const plc::Plc& plc, std::span<const Point3> interior, ConditionsRow& row);

/// Counts the models that fulfill the condition of Radovitzky and Ortiz (2000), and those that fulfill the condition of
/// Theorem 1 (paper, section 5.2). The models are our solids, the parts in the repository and the user's files, each
/// without interior points and with those of the FCC lattice.
///
/// \throw OutputError  a file of the experiment cannot be written
/// \throw InputError   none of the chosen models is part of it
ExperimentResult measure_conditions(const ExperimentOptions& options, bench::Runner& runner);
ExperimentResult conditions_result(std::span<const ConditionsRow> rows);

}  // namespace ccdt::experiments
