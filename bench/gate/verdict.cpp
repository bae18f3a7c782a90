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

}  // namespace

Judgment judgment_of(const std::vector<JudgedFigure>& figures) {
  const auto has = [&](Judgment judgment) {
    return std::ranges::any_of(figures, [&](const JudgedFigure& figure) { return figure.verdict == judgment; });
  };
  if (has(Judgment::worse)) return Judgment::worse;
  // It means little that both ran if none of their results can be compared.
  const bool is_compared = std::ranges::any_of(figures, [&](const JudgedFigure& figure) {
    const bool is_end = figure.name == "status" || figure.name == "exit_codes";
    return figure.verdict == Judgment::undecided ||
           (figure.verdict == Judgment::passed && !(is_end && has(Judgment::incomparable)));
  });
  if (!is_compared) return Judgment::incomparable;
  return has(Judgment::undecided) ? Judgment::undecided : Judgment::passed;
}

void conclude(Verdict& verdict) {
  verdict.verdict = judgment_of(verdict.figures);
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
    json["counts"][std::string(judgment.name)] =
        std::ranges::count(verdict.figures, judgment.value, &JudgedFigure::verdict);
  json["correction"] = verdict.correction;
  json["notes"] = verdict.notes;
  json["figures"] = Json::array();
  for (const JudgedFigure& figure : verdict.figures) json["figures"].push_back(json_of(figure));
  return json;
}

}  // namespace ccdt::gate
