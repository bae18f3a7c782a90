#pragma once

#include "bench/experiments/criteria.h"
#include "bench/experiments/quality_study.h"

namespace ccdt {

/// Our meshes beside those of other meshers, at equal numbers of tetrahedra.
struct MesherQuality : QualityStudy {};

/// Whether one of our rows is better than all others' by one criterion.
struct Verdict {
  Criterion criterion = Criterion::mean_r;
  double ours = 0;
  double best = 0;           ///< of the others
  std::string best_variant;  ///< whose that is; empty if there is no other to compare with
  bool is_better() const { return !best_variant.empty() && ccdt::is_better(criterion, ours, best); }
};

/// By all judged criteria, against the comparable rows of other meshers. None if the row itself failed.
std::vector<Verdict> judge(const QualityCase& c, const QualityRow& ours);

/// Measures ccdt with its FCC lattice, improved and not, and with BCC, and TetGen, Mesh_3 and HXT (what of these the
/// build has, or the machine) on every surface, at equal numbers of tetrahedra.
///
/// \param experiment  begins the names of its files
/// \throw InputError, OutputError  as `measure_study`
MesherQuality measure_mesher_quality(const ExperimentOptions& options, const std::string& experiment,
                                     const std::vector<std::string>& models, const Progress& progress = {});

/// As tables, with what they say. Without name and title.
ExperimentResult result_of(const MesherQuality& quality);

/// What the rows mean, one sentence each.
std::vector<std::string> mesher_quality_definitions();

}  // namespace ccdt
