#include "bench/gate/verdict.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace ccdt::gate {
namespace {

using bench::Json;

/// A number, a text, or null: missing or infinite.
Json value_of(const std::optional<double>& number, const std::string& text) {
  if (number && std::isfinite(*number))
    return *number == std::floor(*number) && std::abs(*number) < 9e15 ? Json(static_cast<std::int64_t>(*number))
                                                                      : Json(*number);
  return text.empty() ? Json() : Json(text);
}

Json json_of(const JudgedFigure& figure) {
  Json json = {{"name", figure.name},
               {"case", figure.case_name},
               {"layer", name_of(figure.layer)},
               {"verdict", name_of(figure.verdict)},
               {"changed", figure.changed},
               {"base", value_of(figure.base, figure.base_text)},
               {"head", value_of(figure.head, figure.head_text)},
               {"ratio", value_of(figure.ratio, {})}};
  json["gated"] = figure.is_gated;
  json["limit"] = value_of(figure.limit, {});
  json["smallest_found"] = value_of(figure.smallest_found, {});
  json["interval"] = figure.interval ? Json{figure.interval->low, figure.interval->high} : Json();
  json["words"] = figure.words;
  json["command"] = figure.command;
  return json;
}

/// The order in which kinds of figures are listed.
int rank(const JudgedFigure& figure) {
  switch (figure.verdict) {
    case Judgment::worse:
      return 0;
    case Judgment::undecided:
      return 1;
    case Judgment::incomparable:
      return 3;
    case Judgment::passed:
      break;
  }
  return figure.changed ? 2 : 4;
}

/// A performance figure that was compared.
bool is_evidence(const JudgedFigure& figure) {
  return figure.is_gated && !is_about_the_end(figure) && figure.verdict != Judgment::incomparable;
}

LayerReport report_on(Layer layer, const std::vector<JudgedFigure>& figures) {
  LayerReport report;
  report.layer = layer;
  for (const JudgedFigure& figure : figures) {
    if (figure.layer != layer) continue;
    report.is_judged = report.is_judged || is_evidence(figure);
    if (report.why.empty() && figure.verdict == Judgment::incomparable) report.why = figure.words;
  }
  if (report.is_judged)
    report.why.clear();
  else if (report.why.empty())
    report.why = "nothing was measured";
  return report;
}

}  // namespace

bool is_about_the_end(const JudgedFigure& figure) {
  return figure.name == "status" || figure.name == "kind" || figure.name == "exit_codes" || figure.name == case_figure;
}

Judgment judgment_of(const std::vector<JudgedFigure>& figures) {
  const auto has = [&](Judgment judgment) {
    return std::ranges::any_of(figures, [&](const JudgedFigure& f) { return f.is_gated && f.verdict == judgment; });
  };
  for (const Judgment judgment : {Judgment::worse, Judgment::undecided, Judgment::incomparable})
    if (has(judgment)) return judgment;
  return std::ranges::any_of(figures, is_evidence) ? Judgment::passed : Judgment::incomparable;
}

void conclude(Verdict& verdict) {
  verdict.layers.clear();
  for (const Layer layer : verdict.rules.layers) verdict.layers.push_back(report_on(layer, verdict.figures));
  verdict.verdict = judgment_of(verdict.figures);
  const bool is_complete = std::ranges::all_of(verdict.layers, &LayerReport::is_judged);
  if (verdict.verdict == Judgment::passed && verdict.rules.layers_are_chosen && !is_complete)
    verdict.verdict = Judgment::incomparable;
  std::ranges::stable_sort(verdict.figures, [](const JudgedFigure& a, const JudgedFigure& b) {
    if (rank(a) != rank(b)) return rank(a) < rank(b);
    return a.badness > b.badness;
  });
}

bool is_better(const JudgedFigure& figure) {
  return figure.verdict == Judgment::passed && figure.changed;
}

bench::Json to_json(const Verdict& verdict) {
  Json json = {{"schema", "ccdt.verdict/1"},
               {"verdict", name_of(verdict.verdict)},
               {"shadow", verdict.shadow},
               {"base", verdict.base},
               {"head", verdict.head}};
  for (const NamedValue<Judgment>& judgment : names_of(Judgment{}))
    json["counts"][std::string(judgment.name)] = std::ranges::count_if(
        verdict.figures,
        [&](const JudgedFigure& figure) { return figure.is_gated && figure.verdict == judgment.value; });
  json["layers"] = Json::array();
  for (const LayerReport& layer : verdict.layers)
    json["layers"].push_back({{"layer", name_of(layer.layer)}, {"judged", layer.is_judged}, {"why", layer.why}});
  json["correction"] = verdict.correction;
  json["rules"] = to_json(verdict.rules);
  json["notes"] = verdict.notes;
  json["figures"] = Json::array();
  for (const JudgedFigure& figure : verdict.figures) json["figures"].push_back(json_of(figure));
  return json;
}

}  // namespace ccdt::gate
