#include "bench/gate/paired_samples.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "bench/json_fields.h"

namespace ccdt::bench {

template <>
inline constexpr auto fields<gate::Pair> = std::tuple(field("base", &gate::Pair::base),
                                                      field("head", &gate::Pair::head),
                                                      field("head_first", &gate::Pair::head_first));

template <>
inline constexpr auto fields<gate::PairedSamples> = std::tuple(
    field("case", &gate::PairedSamples::case_name), field("figure", &gate::PairedSamples::figure),
    field("base_command", &gate::PairedSamples::base_command),
    field("head_command", &gate::PairedSamples::head_command),
    field("in_base_only", &gate::PairedSamples::in_base_only),
    field("in_head_only", &gate::PairedSamples::in_head_only), field("screening", &gate::PairedSamples::screening),
    field("confirmation", &gate::PairedSamples::confirmation));

template <>
inline constexpr auto fields<gate::SampleSet> = std::tuple(field("seed", &gate::SampleSet::seed),
                                                           field("cases", &gate::SampleSet::cases));

}  // namespace ccdt::bench

namespace ccdt::gate {
namespace {

constexpr bench::DocumentKind samples_kind = {"ccdt.samples/1", "not the samples of a gate",
                                              "give the samples.json that `ccdt gate` wrote"};

constexpr double resolution = 1e-9;  ///< seconds; of the clocks. A stage may be over sooner

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
    ratios.push_back(std::log(std::max(pair.head, resolution) / std::max(pair.base, resolution)));
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
