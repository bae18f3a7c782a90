#include "bench/gate/calibration.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <tuple>
#include <utility>

#include "bench/gate/pair_statistics.h"
#include "bench/run/json_fields.h"
#include "bench/run/numbers.h"

namespace ccdt::bench {

template <>
inline constexpr auto fields<Estimate> = std::tuple(field("value", &Estimate::value), field("low", &Estimate::low),
                                                    field("high", &Estimate::high));

template <>
inline constexpr auto fields<gate::CaseNoise> = std::tuple(
    field("case", &gate::CaseNoise::case_name), field("figure", &gate::CaseNoise::figure),
    field("seconds", &gate::CaseNoise::seconds), field("deviation", &gate::CaseNoise::deviation),
    field("robust_deviation", &gate::CaseNoise::robust_deviation),
    field("autocorrelation", &gate::CaseNoise::autocorrelation), field("noise_floor", &gate::CaseNoise::noise_floor),
    field("pairs_needed", &gate::CaseNoise::pairs_needed),
    field_if_any("layout_deviation", &gate::CaseNoise::layout_deviation),
    field_if_any("smallest_found", &gate::CaseNoise::smallest_found),
    field("log_ratios", &gate::CaseNoise::log_ratios));

template <>
inline constexpr auto fields<gate::GateRates> = std::tuple(field("gates", &gate::GateRates::gates),
                                                           field("false_alarms", &gate::GateRates::false_alarms),
                                                           field("undecided", &gate::GateRates::undecided));

template <>
inline constexpr auto fields<gate::Calibration> = std::tuple(field("program", &gate::Calibration::program),
                                                             field("identity", &gate::Calibration::identity),
                                                             field("seed", &gate::Calibration::seed),
                                                             field("rates", &gate::Calibration::rates),
                                                             field("cases", &gate::Calibration::cases));

}  // namespace ccdt::bench

namespace ccdt::gate {
namespace {

constexpr bench::DocumentKind calibration_kind = {"ccdt.calibration/1", "not the calibration of a gate",
                                                  "give the calibration.json that `ccdt gate --calibrate` wrote"};

constexpr int simulated_resamples = 300;  ///< resamples of a bootstrap in a simulated gate

/// Draws log ratios of an unchanged program: blocks of consecutive pairs, so that disturbances longer than a pair stay
/// together (Künsch 1989). Base and head of a block are swapped at random, since they are the same program.
class BlockDraw {
 public:
  BlockDraw(std::span<const double> measured, std::uint64_t seed)
      : measured_(measured),
        block_(static_cast<std::size_t>(std::ceil(std::cbrt(static_cast<double>(measured.size()))))),
        random_(seed) {}

  /// Draws more pairs until there are this many.
  void extend(std::vector<Pair>& drawn, std::size_t count, double shift) {
    while (drawn.size() < count) {
      const std::size_t begin = draw(measured_.size() - block_ + 1);
      const double sign = draw(2) == 0 ? 1 : -1;
      for (std::size_t i = begin; i < begin + block_ && drawn.size() < count; ++i)
        drawn.push_back({1, std::exp(sign * measured_[i] + shift)});
    }
  }

  std::uint64_t seed() { return random_(); }

 private:
  std::size_t draw(std::size_t count) { return static_cast<std::size_t>(random_() >> 32) * count >> 32; }

  std::span<const double> measured_;
  std::size_t block_;
  std::mt19937_64 random_;
};

/// A case in a simulated gate.
struct SimulatedCase {
  const CaseNoise& noise;
  const TimeRules& rules;
  Threshold threshold = {};
};

Look screen(const SimulatedCase& c, double shift, BlockDraw& draw) {
  const bench::Bootstrap bootstrap = bootstrap_for(screening_confidence(c.rules), draw.seed(), simulated_resamples);
  std::vector<Pair> drawn;
  for (;;) {
    draw.extend(drawn, static_cast<std::size_t>(next_look(static_cast<int>(drawn.size()), c.rules)), shift);
    const Look look = look_at(drawn, c.threshold, bootstrap);
    if (look.call != Call::open || static_cast<int>(drawn.size()) >= c.rules.at_most) return look;
  }
}

Look confirm(const SimulatedCase& c, const Look& screening, int suspects, double shift, BlockDraw& draw) {
  const bench::Bootstrap bootstrap =
      bootstrap_for(confirmation_confidence(c.rules, suspects), draw.seed(), simulated_resamples);
  std::vector<Pair> drawn;
  for (;;) {
    draw.extend(drawn, static_cast<std::size_t>(next_look(static_cast<int>(drawn.size()), c.rules)), shift);
    const Look look = look_at(drawn, c.threshold, bootstrap);
    if (half_width(look.log_ratio) <= wanted_half_width(screening, c.rules) ||
        static_cast<int>(drawn.size()) >= c.rules.at_most)
      return look;
  }
}

struct Counts {
  int worse = 0, undecided = 0;  ///< gates
};

/// One gate with unchanged programs.
void simulate_unchanged(std::span<const SimulatedCase> cases, std::span<BlockDraw> draws, Counts& counts) {
  std::vector<std::pair<std::size_t, Look>> suspects;
  bool worse = false, undecided = false;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const Look look = screen(cases[i], 0, draws[i]);
    if (look.call == Call::worse) suspects.emplace_back(i, look);
    undecided = undecided || look.call == Call::open;
  }
  for (const auto& [i, screening] : suspects) {
    const Look look = confirm(cases[i], screening, static_cast<int>(suspects.size()), 0, draws[i]);
    worse = worse || look.call == Call::worse;
    undecided = undecided || look.call == Call::open;
  }
  counts.worse += worse;
  counts.undecided += !worse && undecided;
}

GateRates simulate_gates(std::span<const SimulatedCase> cases, std::uint64_t seed) {
  constexpr int gates = 1000;
  std::vector<BlockDraw> draws;
  for (std::size_t i = 0; i < cases.size(); ++i) draws.emplace_back(cases[i].noise.log_ratios, seed + i);
  Counts counts;
  for (int i = 0; i < gates; ++i) simulate_unchanged(cases, draws, counts);
  return {gates, bench::share_of(counts.worse, gates), bench::share_of(counts.undecided, gates)};
}

/// The share of gates that find a slowdown of one case. The draws are the same for every slowdown.
double share_found(const SimulatedCase& c, double slowdown, std::uint64_t seed) {
  constexpr int gates = 200;
  BlockDraw draw(c.noise.log_ratios, seed);
  int found = 0;
  for (int i = 0; i < gates; ++i) {
    const Look screening = screen(c, std::log1p(slowdown), draw);
    found += screening.call == Call::worse && confirm(c, screening, 1, std::log1p(slowdown), draw).call == Call::worse;
  }
  return static_cast<double>(found) / gates;
}

/// The smallest slowdown that is found with 95% probability, to 1/20 of it.
std::optional<double> smallest_found(const SimulatedCase& c, std::uint64_t seed) {
  constexpr double wanted = 0.95, precision = 1.05;
  double low = std::expm1(c.threshold.value), high = 1;
  if (share_found(c, high, seed) < wanted) return {};
  while (high > precision * low) {
    const double middle = std::sqrt(low * high);
    (share_found(c, middle, seed) < wanted ? low : high) = middle;
  }
  return high;
}

/// The log ratio below which the interval begins in 99% of the gates with an unchanged program.
double noise_floor(const SimulatedCase& c, std::uint64_t seed) {
  constexpr int gates = 400;
  BlockDraw draw(c.noise.log_ratios, seed);
  std::vector<double> lows;
  for (int i = 0; i < gates; ++i) lows.push_back(screen(c, 0, draw).log_ratio.low);
  return std::max(0.0, bench::quantile(lows, 0.99));
}

/// An interval narrows with the square root of the number of pairs. A half-width of half of `largest_noise` excludes
/// either the threshold or the slowdown to find. Pairs that resemble their neighbors carry less information.
int pairs_needed(const CaseNoise& noise, std::span<const Pair> pairs, const TimeRules& rules, std::uint64_t seed) {
  const bench::Estimate estimate = log_ratio_of(pairs, bootstrap_for(rules.confidence, seed));
  const double correlation = std::clamp(noise.autocorrelation, 0.0, 0.9);
  const double needed = static_cast<double>(noise.log_ratios.size()) *
                        std::pow(half_width(estimate) / (rules.largest_noise / 2), 2) * (1 + correlation) /
                        (1 - correlation);
  return std::max(rules.at_least, static_cast<int>(std::ceil(std::min(needed, 1e6))));
}

/// Subtracts from the log ratio of each pair the mean of its layout.
///
/// \return  the standard deviation of log time between builds, by the analysis of variance of one random effect
///          (Searle, Casella, McCulloch 1992, section 3.6); none with fewer than two layouts
std::optional<double> remove_layout_means(std::span<const Pair> pairs, std::vector<double>& ratios) {
  std::map<int, std::vector<std::size_t>> layouts;
  for (std::size_t i = 0; i < pairs.size(); ++i) layouts[pairs[i].layout].push_back(i);
  const auto count = static_cast<double>(layouts.size()), all = static_cast<double>(ratios.size());
  if (layouts.size() < 2 || ratios.size() == layouts.size()) return {};
  std::vector<double> means;
  double within = 0;
  for (const auto& [layout, members] : layouts) {
    double mean = 0;
    for (const std::size_t i : members) mean += ratios[i] / static_cast<double>(members.size());
    for (const std::size_t i : members) {
      ratios[i] -= mean;
      within += ratios[i] * ratios[i];
    }
    means.push_back(mean);
  }
  const double between = std::pow(bench::standard_deviation(means), 2);
  const double noise = within / (all - count) / (all / count);
  return std::sqrt(std::max(0.0, between - noise) / 2);  // a ratio has two builds
}

std::vector<Pair> pairs_of(std::span<const double> ratios) {
  std::vector<Pair> pairs;
  for (const double ratio : ratios) pairs.push_back({1, std::exp(ratio)});
  return pairs;
}

CaseNoise noise_of(const PairedSamples& samples, const TimeRules& rules, std::uint64_t seed) {
  CaseNoise noise;
  noise.case_name = samples.case_name;
  noise.figure = samples.figure;
  noise.log_ratios = log_ratios(samples.screening);
  noise.layout_deviation = remove_layout_means(samples.screening, noise.log_ratios);
  noise.seconds = bench::median(seconds_of(samples.screening, Side::base));
  noise.deviation = bench::standard_deviation(noise.log_ratios);
  noise.robust_deviation = bench::robust_deviation(noise.log_ratios);
  noise.autocorrelation = bench::autocorrelation(noise.log_ratios);
  noise.pairs_needed = pairs_needed(noise, pairs_of(noise.log_ratios), rules, seed);
  return noise;
}

void require_success(const PairedSamples& samples) {
  if (samples.is_comparable()) return;
  const std::string& why = samples.base_failure.empty() ? samples.head_failure : samples.base_failure;
  throw InputError("the program fails on " + samples.case_name + ": " + why, {},
                   "repair it, or leave out this case: --benchmark_filter, or time.cases of the rules");
}

/// A simulated gate draws as many pairs as a real one takes. It cannot know about noise that fewer pairs did not show.
void require_enough(const CaseNoise& noise, const TimeRules& rules) {
  const int needed = std::max(2 * rules.at_least, std::min(noise.pairs_needed, rules.at_most));
  const auto there = static_cast<int>(noise.log_ratios.size());
  if (there >= needed) return;
  // A quarter more, since more pairs may show more noise.
  const int enough = std::min(needed + needed / 4, std::max(rules.at_most, 2 * rules.at_least));
  throw TooFewSamples("too few samples for a calibration: " + noise.case_name + " has " + std::to_string(there) +
                          " pairs, and at least " + std::to_string(needed) + " are needed",
                      enough, "measure " + std::to_string(enough) + " pairs of each case");
}

using bench::percent;
using bench::rounded;

std::string shares(const bench::Estimate& share) {
  return percent(share.value) + " [" + percent(share.low) + ", " + percent(share.high) + "]";
}

}  // namespace

const CaseNoise* find_noise(const Calibration& calibration, const std::string& case_name) {
  const auto found = std::ranges::find(calibration.cases, case_name, &CaseNoise::case_name);
  return found == calibration.cases.end() ? nullptr : &*found;
}

Rules rules_of_calibration(const Rules& rules, int pairs) {
  Rules all = rules;
  all.layers = {Layer::time};
  all.time.at_least = all.time.at_most = pairs;
  // Nothing is a suspect, so nothing is confirmed.
  all.time.relative = std::numeric_limits<double>::max();
  for (CaseRules& special : all.special) {
    special.time.at_least = special.time.at_most = pairs;
    special.time.relative = all.time.relative;
  }
  return all;
}

Calibration calibrate(const SampleSet& samples, const Rules& rules) {
  Calibration calibration;
  calibration.seed = samples.seed;
  for (const PairedSamples& s : samples.cases) require_success(s);
  for (const PairedSamples& s : samples.cases)
    calibration.cases.push_back(noise_of(s, time_rules_of(rules, s.case_name), samples.seed));
  for (const CaseNoise& noise : calibration.cases) require_enough(noise, time_rules_of(rules, noise.case_name));

  std::vector<SimulatedCase> simulated;
  for (CaseNoise& noise : calibration.cases) {
    SimulatedCase c = {noise, time_rules_of(rules, noise.case_name)};
    const PairedSamples& measured = *std::ranges::find(samples.cases, noise.case_name, &PairedSamples::case_name);
    Precision precision = {measured.timed_seconds, samples.clock_seconds};
    c.threshold = threshold_of(c.rules, noise.seconds, precision);
    precision.noise_floor = noise.noise_floor = noise_floor(c, samples.seed);
    // Later gates judge two builds.
    precision.layout_deviation =
        noise.layout_deviation.value_or(c.rules.layout_deviation.value_or(usual_layout_deviation(noise.figure)));
    precision.cases = static_cast<int>(calibration.cases.size());
    c.threshold = threshold_of(c.rules, noise.seconds, precision);
    noise.smallest_found = smallest_found(c, samples.seed);
    simulated.push_back(c);
  }
  calibration.rates = simulate_gates(simulated, samples.seed);
  return calibration;
}

std::string to_text(const Calibration& calibration) {
  std::string text =
      "case: pairs, seconds, deviation (robust), between builds, noise floor, pairs needed, smallest slowdown found\n";
  for (const CaseNoise& c : calibration.cases)
    text += c.case_name + ": " + std::to_string(c.log_ratios.size()) + ", " + rounded(c.seconds) + ", " +
            percent(c.deviation) + " (" + percent(c.robust_deviation) + "), " +
            (c.layout_deviation ? percent(*c.layout_deviation) : "not measured") + ", " +
            percent(std::expm1(c.noise_floor)) + ", " + std::to_string(c.pairs_needed) + ", " +
            (c.smallest_found ? percent(*c.smallest_found) : "more than 100%") + "\n";
  const GateRates& rates = calibration.rates;
  text += "false alarms of the whole gate: " + shares(rates.false_alarms) + "; undecided: " + shares(rates.undecided) +
          " (of " + std::to_string(rates.gates) + " simulated gates, with 95% intervals)\n";
  return text;
}

void write_calibration(const Calibration& calibration, const std::filesystem::path& file) {
  bench::Json json = {{"schema", calibration_kind.schema}};
  json.update(bench::Json(calibration));
  bench::write_json(json, file);
}

Calibration read_calibration(const std::filesystem::path& file) {
  Calibration calibration;
  bench::parse_document(file, calibration_kind, [&](const bench::Json& json) { json.get_to(calibration); });
  return calibration;
}

}  // namespace ccdt::gate
