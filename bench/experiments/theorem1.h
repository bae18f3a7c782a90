#pragma once

#include "bench/experiments/experiment.h"
#include "bench/experiments/small_plcs/trial.h"

namespace ccdt::experiments {

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
  std::uint64_t disagreements = 0;           ///< between the engine and the exhaustive tests, or among these
  std::string first_disagreement = {};       ///< with the PLC, in words
  small_plcs::SmallPlc counterexample = {};  ///< of those to either direction the first with the fewest vertices
};
void add_trial(const small_plcs::Trial& trial, FamilyTrials& family);

/// Tests the paper's Theorem 1 (section 5.2), "If and only if a model X is grazeable edge protected and face protected,
/// X has a DT", in both directions on random small PLCs by exhaustive search, and holds the engine against it.
///
/// \throw OutputError  a file of the experiment cannot be written
results::ExperimentResult measure_theorem1(const ExperimentOptions& options, const Progress& progress = {});

/// The result without its circumstances, and without what every result of the experiment is called.
results::ExperimentResult theorem1_result(std::span<const FamilyTrials> families);

}  // namespace ccdt::experiments
