#pragma once

#include "bench/gate/recording.h"
#include "bench/json.h"

/// What other programs record.
namespace ccdt::gate {

/// Is it what `--benchmark_out` of Google Benchmark writes?
bool is_google_benchmark(const bench::Json& json);

/// Adds a case for each benchmark: repetitions are samples, aggregates are left out, times are in seconds. Counters
/// that are whole numbers are exact figures; the others are taken for rates, which are no better than times, with a
/// note.
///
/// \throw nlohmann::json::exception  a name is missing, or of another type
void add_google_benchmark(const bench::Json& json, Recording& recording);

/// Is it what `--export-json` of hyperfine writes?
bool is_hyperfine(const bench::Json& json);

/// Adds a case for each command, in their order.
/// \throw nlohmann::json::exception  a name is missing, or of another type
void add_hyperfine(const bench::Json& json, Recording& recording);

}  // namespace ccdt::gate
