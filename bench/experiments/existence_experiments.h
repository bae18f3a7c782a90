#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/experiments/experiment.h"
#include "bench/experiments/measured_case.h"
#include "bench/experiments/small_plcs/small_plc.h"
#include "bench/experiments/small_plcs/trial.h"
#include "engine/base/enum_names.h"
#include "engine/plc/input.h"
#include "engine/plc/plc.h"

namespace ccdt::experiments {

using small_plcs::Family;
using small_plcs::SmallPlc;

/// The counts of the trials of one family of small PLCs.
struct FamilyTrials {
  std::string name;
  bool is_cospherical = false;  ///< not in general position, so that the theorem does not speak of it
  std::uint64_t cases = 0;
  std::uint64_t premise = 0;            ///< grazeable edge protected and face protected
  std::uint64_t dt = 0;                 ///< with a DT
  std::uint64_t against_if = 0;         ///< the premise, but no DT
  std::uint64_t against_only_if = 0;    ///< a DT, but not the premise
  std::uint64_t edges_alone = 0;        ///< face protected, but not grazeable edge protected
  std::uint64_t edges_alone_loose = 0;  ///< of these, the ones where only edges of no facet are missing
  std::uint64_t edge_protected = 0;     ///< grazeable edge protected, whatever the faces
  std::uint64_t edge_protected_without_cdt = 0;
  std::uint64_t disagreements = 0;      ///< between the engine and the exhaustive tests, or among these
  std::string first_disagreement = {};  ///< with the PLC, in words
  SmallPlc counterexample = {};         ///< of those to either direction the first with the fewest vertices
};
void add_trial(const small_plcs::Trial& trial, FamilyTrials& family);

/// Tests the paper's Theorem 1 (section 5.2), "If and only if a model X is grazeable edge protected and face protected,
/// X has a DT", in both directions on random small PLCs by exhaustive search, and holds the engine against it.
///
/// \throw OutputError  a file of the experiment cannot be written
ExperimentResult measure_theorem1(const ExperimentOptions& options, const Progress& progress = {});

/// The result without its circumstances, and without what every result of the experiment is called.
ExperimentResult theorem1_result(std::span<const FamilyTrials> families);

/// Segments or fins that meet at one point inside a cube, at a given angle: inputs that are hard to protect.
struct Star {
  std::string_view name;
  std::string_view what;      ///< one sentence
  double smallest_angle = 1;  ///< in degrees; below it there would be too many segments
  InputPlc (*make)(double degrees, std::uint64_t variant);
};

/// Variant 0 has lengths that alternate between 1 and 1 / sqrt 2; the other variants have random ones between 0.4 and
/// 1.6. A segment all around which shorter ones end is missing if these are shorter than its length times the cosine of
/// the angle. Halves of 1 and 1 / sqrt 2 stay in that proportion forever, so below 45 degrees they can split each
/// other without end.
std::span<const Star> stars();

/// One input whose edges were protected in one way.
struct TerminationCase : CaseOutcome {
  std::string group;          ///< the star, "solid", or "file"
  std::string input;          ///< name of the solid or file; of a star: which variant
  double degrees = 0;         ///< asked for, of a star
  double smallest_angle = 0;  ///< that segments enclose, in degrees
  Protection protection = Protection::midpoint;
};

/// How protecting the edges of a case came out.
enum class Termination {
  ended,    ///< all grazeable edges are protected
  stopped,  ///< at the limit of the engine
  unknown   ///< the run failed for another reason
};
Termination termination_of(const TerminationCase& c);

/// Does the paper's way to protect edges, inserting middle points again and again (section 2), come to an end? Protects
/// our solids, stars of segments that meet at smaller and smaller angles, and the user's files, by midpoints and by our
/// shells.
///
/// \throw OutputError  a file of the experiment cannot be written
/// \throw InputError   none of the models that were asked for is part of it
ExperimentResult measure_termination(const ExperimentOptions& options, const Progress& progress = {});

/// The result without its circumstances, and without what every result of the experiment is called.
ExperimentResult termination_result(std::span<const TerminationCase> cases);

/// What one interior point did to small random PLCs of a family that have a constrained Delaunay tetrahedralization.
struct ExistenceTrials {
  std::string family;
  std::uint64_t cases = 0;
  std::uint64_t lost = 0;        ///< that have none with the point
  SmallPlc counterexample = {};  ///< of these the first with the fewest vertices; the point is its last vertex
};

/// The PLC with a point inside, strictly and in general position; empty if none is found.
/// \param seed  of the draws
SmallPlc with_interior_point(const SmallPlc& plc, std::uint64_t seed);

/// Looks for existence by exhaustion, without and with the point, in so many PLCs of each family in general position.
std::vector<ExistenceTrials> try_interior_points(std::uint64_t cases_a_family);

/// Which rules keep interior points away from the surface.
enum class InteriorRule {
  paper,         ///< none in the smallest sphere of a face or subsegment, and our clearance
  no_spheres,    ///< our clearance alone
  no_distances,  ///< neither: a hundredth of the edge length from the surface is far enough
};

constexpr auto names_of(InteriorRule) {
  return std::to_array<NamedValue<InteriorRule>>({{InteriorRule::paper, "paper"},
                                                  {InteriorRule::no_spheres, "no spheres"},
                                                  {InteriorRule::no_distances, "no distances"}});
}

/// One input with one lattice under one rule. Its counts tell how many points were placed, and how many were dropped
/// because they would have destroyed a protected edge.
struct InteriorCase : CaseOutcome {
  std::string input;
  double edge_length = 0;  ///< of one of our solids; 0: a file
  Lattice lattice = Lattice::fcc;
  InteriorRule rule = InteriorRule::paper;
};

/// What became of the interior points of all inputs.
struct InteriorPoints {
  Circumstances how;
  std::vector<InteriorCase> cases;
  std::vector<ExistenceTrials> existence;
};

/// A rule over all its cases that went well.
struct InteriorSummary {
  std::uint64_t cases = 0, harmed = 0, failed = 0;  ///< `harmed`: with a dropped point
  std::uint64_t placed = 0, dropped = 0;
};
/// \param lattice  of the cases; none: all
InteriorSummary summarize(std::span<const InteriorCase> cases, InteriorRule rule, std::optional<Lattice> lattice = {});

/// Tests what the paper says in section 3, that interior points never do harm: by exhaustion on small PLCs, and meshes
/// all solids at several edge lengths, and the files of the user, with all lattices and rules; each once, for the
/// counts are always the same.
///
/// \throw OutputError  a file of the experiment cannot be written
InteriorPoints measure_interior_points(const ExperimentOptions& options, const Progress& progress = {});

/// As tables, with what they say.
ExperimentResult result_of(const InteriorPoints& points);

}  // namespace ccdt::experiments
