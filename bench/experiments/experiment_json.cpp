#include "bench/experiments/experiment_json.h"

#include <nlohmann/json.hpp>

#include "bench/experiments/measured_case.h"

namespace ccdt {

Json head_json(const std::string& schema, const std::vector<std::string>& definitions, const Circumstances& how) {
  return {{"schema", schema},
          {"definitions", definitions},
          {"runs", how.runs},
          {"confidence", Bootstrap{}.confidence},
          {"limits", {{"seconds", how.limits.seconds}, {"memory_bytes", how.limits.memory_bytes}}},
          {"environment", environment_json(how.environment)}};
}

Json estimate_json(const std::optional<Estimate>& estimate) {
  if (!estimate) return nullptr;
  return {{"median", estimate->value}, {"low", estimate->low}, {"high", estimate->high}};
}

Json optional_json(const std::optional<double>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json stages_json(const StageSeconds& s) {
  return {{"delaunay", s.delaunay}, {"face_check", s.face_check}, {"front", s.front},
          {"label", s.label},       {"cdt", cdt_seconds(s)},      {"mesh", s.mesh}};
}

}  // namespace ccdt
