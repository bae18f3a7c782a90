#pragma once

#include "bench/gate/recording.h"
#include "bench/json.h"

/// Recordings of other programs.
namespace ccdt::gate {

/// Is it the output of Google Benchmark's `--benchmark_out`?
bool is_google_benchmark(const bench::Json& json);

/// Adds a case for each benchmark: repetitions are samples, aggregates are left out, times are in seconds. Counters
/// that are whole numbers are exact figures; the others count as rates, which are no better than times, with a note.
///
/// \throw nlohmann::json::exception  a name is missing, or of another type
void add_google_benchmark(const bench::Json& json, Recording& recording);

/// Is it the output of hyperfine's `--export-json`?
bool is_hyperfine(const bench::Json& json);

/// Adds a case for each command, in their order.
/// \throw nlohmann::json::exception  a name is missing, or of another type
void add_hyperfine(const bench::Json& json, Recording& recording);

}  // namespace ccdt::gate
