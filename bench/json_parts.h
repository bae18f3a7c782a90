#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "bench/environment.h"
#include "engine/mesher.h"

namespace ccdt {

/// JSON whose names keep the order in which they were written.
using Json = nlohmann::ordered_json;

Json environment_json(const Environment& environment);
/// \throw nlohmann::json::exception  names are missing or of another type
Environment environment_from_json(const Json& json);
Json counts_json(const MeshCounts& counts);

/// Indented, with a line feed at the end. What is no UTF-8 (a file name may hold any bytes) is replaced.
std::string to_text(const Json& json);

}  // namespace ccdt
