#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/experiments/experiment.h"
#include "bench/json_parts.h"

namespace ccdt {

/// What every experiment's JSON begins with.
Json head_json(const std::string& schema, const std::vector<std::string>& definitions, const Circumstances& how);

Json estimate_json(const std::optional<Estimate>& estimate);
Json optional_json(const std::optional<double>& value);

/// The stages that the experiments speak of, by their names in `ccdt.run/1`, and their sum as `cdt`.
Json stages_json(const StageSeconds& seconds);

}  // namespace ccdt
