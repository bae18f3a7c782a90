#pragma once

#include "bench/json_parts.h"
#include "bench/quality.h"

namespace ccdt {

/// The object `quality` of `ccdt.run/1`, with all measures and their histograms.
Json quality_json(const Quality& quality);

/// \throw nlohmann::json::exception  a fixed name is missing. Measures that older programs did not write may be.
Quality quality_from_json(const Json& json);

/// JSON has no infinity; what was infinite (r of a flat tetrahedron) is null there.
double number_from_json(const Json& value);

}  // namespace ccdt
