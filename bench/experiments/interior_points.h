#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bench/experiments/measured_case.h"
#include "bench/experiments/small_plcs/small_plc.h"
#include "engine/base/enum_names.h"

namespace ccdt::experiments {

/// What one interior point did to small random PLCs of a family that have a constrained Delaunay tetrahedralization.
struct ExistenceTrials {
  std::string family;
  std::uint64_t cases = 0;
  std::uint64_t lost = 0;  ///< that have none with the point
  small_plcs::SmallPlc counterexample =
      {};  ///< of these the first with the fewest vertices; the point is its last vertex
};

/// The PLC with a point inside, strictly and in general position; empty if none is found.
/// \param seed  of the draws
small_plcs::SmallPlc with_interior_point(const small_plcs::SmallPlc& plc, std::uint64_t seed);

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
  results::Circumstances how;
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
results::ExperimentResult result_of(const InteriorPoints& points);

}  // namespace ccdt::experiments
