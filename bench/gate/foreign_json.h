#pragma once

#include <set>
#include <string>

#include "bench/gate/recording.h"
#include "bench/run/json.h"

/// Recordings of other programs.
namespace ccdt::gate {

/// The JSON of a benchmark. Google Benchmark writes NaN and Infinity, which JSON does not have; here they are the texts
/// "NaN", "Infinity" and "-Infinity". Lines stay lines.
std::string valid_json_of(const std::string& text);

/// Parses it.
///
/// \throw nlohmann::json::exception  it is not JSON, or a number is larger than any double
bench::Json parse_benchmark_json(const std::string& text);

/// The value of --benchmark_filter that only these benchmarks match.
std::string pattern_of(const std::set<std::string>& names);

/// Is it the output of Google Benchmark's `--benchmark_out`?
bool is_google_benchmark(const bench::Json& json);

/// Adds a case for each benchmark: repetitions are samples, and times are in seconds. Aggregates are left out, unless
/// there is nothing else: then the median counts. The counters of a benchmark are exact figures, "counters.NAME"; see
/// `is_gated_counter`.
///
/// \throw nlohmann::json::exception  a name is missing, or of another type
void add_google_benchmark(const bench::Json& json, Recording& recording);

/// Is it the output of hyperfine's `--export-json`?
bool is_hyperfine(const bench::Json& json);

/// Adds a case for each command, in their order.
/// \throw nlohmann::json::exception  a name is missing, or of another type
void add_hyperfine(const bench::Json& json, Recording& recording);

}  // namespace ccdt::gate
