#include "bench/gate/paired_samples.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "bench/run/json_fields.h"

namespace ccdt::bench {

template <>
inline constexpr auto fields<gate::Pair> = std::tuple(field("base", &gate::Pair::base),
                                                      field("head", &gate::Pair::head),
                                                      field("head_first", &gate::Pair::head_first),
                                                      optional_field("layout", &gate::Pair::layout));

template <>
inline constexpr auto fields<gate::PairedCounter> = std::tuple(field("base", &gate::PairedCounter::base),
                                                               field("head", &gate::PairedCounter::head));

template <>
inline constexpr auto fields<gate::PairedSamples> = std::tuple(
    field("case", &gate::PairedSamples::case_name), field("figure", &gate::PairedSamples::figure),
    field("base_command", &gate::PairedSamples::base_command),
    field("head_command", &gate::PairedSamples::head_command),
    field("in_base_only", &gate::PairedSamples::in_base_only),
    field("in_head_only", &gate::PairedSamples::in_head_only), field("screening", &gate::PairedSamples::screening),
    field("confirmation", &gate::PairedSamples::confirmation),
    field_if_any("base_failure", &gate::PairedSamples::base_failure),
    field_if_any("head_failure", &gate::PairedSamples::head_failure),
    optional_field("timed_seconds", &gate::PairedSamples::timed_seconds),
    field_if_any("counters", &gate::PairedSamples::counters));

template <>
inline constexpr auto fields<gate::SampleSet> =
    std::tuple(field("seed", &gate::SampleSet::seed), optional_field("clock_seconds", &gate::SampleSet::clock_seconds),
               optional_field("rebuilt", &gate::SampleSet::is_rebuilt),
               optional_field("base_program", &gate::SampleSet::base_program),
               optional_field("head_program", &gate::SampleSet::head_program),
               optional_field("finished", &gate::SampleSet::is_finished), field("cases", &gate::SampleSet::cases));

}  // namespace ccdt::bench

namespace ccdt::gate {
namespace {

constexpr bench::DocumentKind samples_kind = {"ccdt.samples/1", "not the samples of a gate",
                                              "give the samples.json that `ccdt gate` wrote"};

constexpr double shortest = 1e-12;  ///< seconds; a stage may be over before the clock moves

}  // namespace

std::vector<double> seconds_of(std::span<const Pair> pairs, Side side) {
  std::vector<double> seconds;
  seconds.reserve(pairs.size());
  for (const Pair& pair : pairs) seconds.push_back(side == Side::base ? pair.base : pair.head);
  return seconds;
}

std::vector<double> log_ratios(std::span<const Pair> pairs) {
  std::vector<double> ratios;
  ratios.reserve(pairs.size());
  for (const Pair& pair : pairs)
    ratios.push_back(std::log(std::max(pair.head, shortest) / std::max(pair.base, shortest)));
  return ratios;
}

void write_samples(const SampleSet& samples, const std::filesystem::path& file) {
  bench::Json json = {{"schema", samples_kind.schema}};
  json.update(bench::Json(samples));
  bench::write_json(json, file);
}

SampleSet read_samples(const std::filesystem::path& file) {
  SampleSet samples;
  bench::parse_document(file, samples_kind, [&](const bench::Json& json) { json.get_to(samples); });
  return samples;
}

}  // namespace ccdt::gate
