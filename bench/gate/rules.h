#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "bench/gate/recording.h"
#include "bench/run/json.h"

namespace ccdt::gate {

/// Which change of a figure is a loss.
enum class Better {
  fewer,  ///< more is worse: work, Steiner vertices
  more,   ///< less is worse: the smallest dihedral angle
  same    ///< every change is a loss until the baseline is updated: the mesh itself
};

constexpr auto names_of(Better) {
  return std::to_array<NamedValue<Better>>({{Better::fewer, "fewer"}, {Better::more, "more"}, {Better::same, "same"}});
}

/// Rules for counts, quality and work.
struct ExactRules {
  std::vector<std::string> cases = {"*"};    ///< patterns of names
  std::vector<std::string> figures = {"*"};  ///< patterns of names (fnmatch)
  std::vector<std::string> ignore = {};
  double relative =
      1e-9;  ///< tolerance for figures that are not integers: libraries differ in the last bits of a logarithm
  std::vector<std::pair<std::string, double>> tolerances = {};  ///< pattern, and the relative loss that is allowed
  std::vector<std::pair<std::string, Better>> better = {};      ///< pattern of names; overrides the default
};

/// Rules for the instruction counts of stages. Worse means beyond both thresholds.
struct InstructionRules {
  std::vector<std::string> cases = {"*"};  ///< patterns of names
  double relative = 0.005;
  double absolute = 100000;
};

/// Rules for times. Worse means: the whole interval is beyond the largest of all thresholds, twice.
struct TimeRules {
  std::vector<std::string> cases = {"*"};  ///< patterns of names
  std::string figure = "seconds.mesh";     ///< of the report of `ccdt mesh`; "wall": the time of the whole process
  double relative = 0.01;
  double absolute_seconds = 0;  ///< of one run, or of one iteration of a benchmark
  double confidence = 0.95;
  double largest_noise = 0.02;       ///< to pass, a case must exclude a slowdown by the threshold plus this
  int at_least = 20, at_most = 200;  ///< pairs
  int layouts = 20;                  ///< builds of each program at the first look, if they are rebuilt
  /// Standard deviation of log time between builds, if they are not rebuilt. None: `usual_layout_deviation`.
  std::optional<double> layout_deviation = {};
};

/// Thresholds of some cases.
struct CaseRules {
  std::string cases;  ///< pattern of names
  TimeRules time;
};

/// What is gated: schema ccdt.rules/1.
struct Rules {
  std::set<Layer> layers = {Layer::exact, Layer::instructions, Layer::time};
  bool layers_are_chosen = false;  ///< by the user: each of them must be judged
  ExactRules exact;
  InstructionRules instructions;
  TimeRules time;
  std::vector<CaseRules> special;           ///< the first match counts
  std::vector<std::string> may_be_missing;  ///< patterns of cases that the head need not have
  bool shadow = false;
};

/// Does one of the patterns match?
bool matches(const std::vector<std::string>& patterns, const std::string& name);

/// Does the layer compare this figure of this case?
bool is_gated(const Rules& rules, Layer layer, const std::string& case_name, const std::string& figure);

/// Which change of an exact figure is a loss. The first matching rule decides; without one, the default for the names
/// of ccdt.run/1; without that, the answer is `same`.
Better better_of(const ExactRules& rules, const std::string& figure);

/// How large a relative loss of an exact figure may be.
double tolerance_of(const ExactRules& rules, const std::string& figure);

/// Does a rule say how to judge this figure: a tolerance, or which change is better?
bool has_rule(const ExactRules& rules, const std::string& figure);

/// The thresholds of a case.
const TimeRules& time_rules_of(const Rules& rules, const std::string& case_name);

/// All rules with their defaults, as JSON of schema ccdt.rules/1.
bench::Json to_json(const Rules& rules);

/// \throw InputError  the file cannot be read or is invalid; names the JSON pointer
Rules read_rules(const std::filesystem::path& file);

}  // namespace ccdt::gate
