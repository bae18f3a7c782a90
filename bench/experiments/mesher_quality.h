#pragma once

#include "bench/experiments/criteria.h"
#include "bench/experiments/quality_study.h"

namespace ccdt {

/// What we aim at.
inline constexpr double wanted_mean_r = 1.20, wanted_worst_r = 3, wanted_dihedral = 18;
inline constexpr double wanted_speed = 0.7e6;  ///< tetrahedra a second, all stages together

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

/// Is it a row of our engine?
bool is_ours(const QualityRow& row);

/// Does the surface itself forbid that all dihedral angles of a mesh that keeps it reach this many degrees? Only an
/// angle between facets does: some tetrahedron has to fit into it.
bool forbids_dihedral(const SurfaceAngles& angles, double degrees);

/// Measures ccdt with its FCC and its BCC lattice, TetGen, Mesh_3 and HXT (what of these the build has, or the machine)
/// on every surface at about 50,000 and 500,000 tetrahedra.
///
/// \throw InputError, OutputError  as `measure_study`
MesherQuality measure_mesher_quality(const ExperimentOptions& options, const Progress& progress = {});

/// As JSON of schema `ccdt.quality/1`.
std::string to_json(const MesherQuality& quality);

/// What the rows mean, one sentence each.
std::vector<std::string> mesher_quality_definitions();

}  // namespace ccdt
