#pragma once

#include "bench/experiments/criteria.h"
#include "bench/experiments/quality_study.h"

namespace ccdt {

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

/// As tables, with what they say.
ExperimentResult result_of(const Lattices& lattices);

/// What the rows mean, one sentence each.
std::vector<std::string> lattices_definitions();

}  // namespace ccdt
