#include "bench/experiments/ablation.h"

#include <nlohmann/json.hpp>

namespace ccdt {

std::vector<std::string> ablation_definitions() {
  std::vector<std::string> definitions = study_definitions();
  definitions.insert(definitions.end(),
                     {
                         "none: the constrained Delaunay tetrahedralization with its FCC lattice.",
                         "swap: other tetrahedra of the same vertices. smooth: other places for them.",
                         "all: both, and vertices inside are inserted and taken out.",
                         "Improve: median seconds of the improvement, which are part of the seconds.",
                     });
  return definitions;
}

Ablation measure_ablation(const ExperimentOptions& options, const Progress& progress) {
  std::vector<QualityVariant> variants;
  for (const char* improve : {"none", "swap", "smooth", "all"})
    variants.push_back({improve, "ccdt", {"--lattice", "fcc", "--improve", improve}});
  return {measure_study(options, {"ablation", {50000}, variants, false, false}, progress)};
}

std::string to_json(const Ablation& ablation) {
  return to_text(study_json("ccdt.ablation/1", ablation_definitions(), ablation));
}

}  // namespace ccdt
