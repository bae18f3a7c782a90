#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "bench/gate/recording.h"
#include "bench/gate/rules.h"
#include "bench/run/json.h"
#include "bench/run/statistics.h"

namespace ccdt::gate {

/// The verdict on one figure or on all.
enum class Judgment {
  passed,  ///< not worse
  worse,
  undecided,    ///< too noisy to tell
  incomparable  ///< base and head were measured under different conditions
};

constexpr auto names_of(Judgment) {
  return std::to_array<NamedValue<Judgment>>({{Judgment::passed, "passed"},
                                              {Judgment::worse, "worse"},
                                              {Judgment::undecided, "undecided"},
                                              {Judgment::incomparable, "incomparable"}});
}

/// One figure of base and head.
struct JudgedFigure {
  std::string name, case_name;
  Layer layer = Layer::exact;
  std::optional<double> base, head;         ///< medians of samples; none if it is a text or missing
  std::string base_text, head_text;         ///< value of a text
  std::optional<double> ratio;              ///< head / base; none if base is 0 or there are no numbers
  std::optional<bench::Estimate> interval;  ///< interval of the ratio, for sampled figures
  Judgment verdict = Judgment::passed;
  bool is_gated = true;                  ///< counts for the verdict on all; otherwise it is only listed
  std::optional<double> limit;           ///< of times: passed excludes a slowdown by more than this share
  std::optional<double> smallest_found;  ///< the smallest slowdown that would have been found, as a share
  bool changed = false;                  ///< base and head differ by more than the rules allow
  double badness = 0;                    ///< order of the list, the worst first
  std::string words;                     ///< why: threshold, noise, the field that differs
  std::string command;                   ///< that repeats it
};

/// What became of a layer.
struct LayerReport {
  Layer layer = Layer::exact;
  bool is_judged = false;  ///< at least one performance figure of it was compared
  std::string why;         ///< why not
};

/// The verdict of a gate: JSON of schema ccdt.verdict/1.
struct Verdict {
  Judgment verdict = Judgment::passed;
  bool shadow = false;                ///< reports, but always passes
  std::string base, head;             ///< programs or recordings
  std::vector<JudgedFigure> figures;  ///< all that were compared
  std::vector<LayerReport> layers;    ///< those of the rules
  Rules rules;                        ///< with all defaults
  std::vector<std::string> notes;     ///< what a reader must know: a history that only gets worse, layers left out
  std::string correction;             ///< the correction for the number of cases; empty without times
};

/// Does the figure say how a case ended, or whether it was there? That is not performance.
bool is_about_the_end(const JudgedFigure& figure);

/// The verdict on all figures that are gated: worse if one is worse; otherwise undecided if one is undecided; otherwise
/// incomparable if one is, or if no performance figure was compared; otherwise passed.
Judgment judgment_of(const std::vector<JudgedFigure>& figures);

/// Sets the layers and the verdict from the figures. A layer that the user chose and that was not judged makes the
/// verdict incomparable. Sorts the figures: the worst first, then undecided ones, those that got better or are new,
/// incomparable ones and the rest.
void conclude(Verdict& verdict);

/// Did it change without being worse?
bool is_better(const JudgedFigure& figure);

/// As JSON of schema ccdt.verdict/1.
bench::Json to_json(const Verdict& verdict);

}  // namespace ccdt::gate
