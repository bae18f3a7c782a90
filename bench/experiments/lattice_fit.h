#pragma once

#include "bench/experiments/criteria.h"
#include "bench/experiments/quality_study.h"

namespace ccdt {

/// How near to the surface lattice points may be.
struct LatticeSetting {
  double sphere_factor = 1;
  double clearance = usual_clearance;
  bool operator==(const LatticeSetting&) const = default;
};

/// The settings that are tried; the defaults of `ccdt mesh` among them.
std::vector<LatticeSetting> lattice_settings();
LatticeSetting default_lattice_setting();
/// "sphere 1, clearance 0.55"; the name of the setting's rows.
std::string name_of(const LatticeSetting& setting);

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

/// As tables, with what they say.
ExperimentResult result_of(const LatticeFit& fit);

/// What the rows mean, one sentence each.
std::vector<std::string> lattice_fit_definitions();

}  // namespace ccdt
