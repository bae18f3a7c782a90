#include "reports/table1_differences.h"

#include <algorithm>

#include "reports/numbers.h"

namespace ccdt {
namespace {

const Table1Ratio* ratio(const Table1Model& model, std::string_view id) {
  const auto found = std::ranges::find(model.ratios, id, &Table1Ratio::id);
  return found != model.ratios.end() && found->value ? &*found : nullptr;
}

/// "1.21 [1.20, 1.22] times as long as Delaunay (paper: 1.019): ".
std::string times_delaunay(const Table1Ratio& ratio) {
  return with_interval(*ratio.value) + " times as long as Delaunay (paper: " + rounded(*ratio.paper, 4) + "): ";
}

/// One of three endings.
std::string ending(Claim claim, const char* holds, const char* undecided, const char* fails) {
  return claim == Claim::holds ? holds : claim == Claim::fails ? fails : undecided;
}

std::string check_sentence(const Table1Model& model, const Table1Ratio& check) {
  return model.name + ": with the check, the CDT takes " + times_delaunay(check) +
         ending(is_at_most(*check.value, *check.paper), "not more than there.", "these runs cannot tell it from there.",
                "more than there.");
}

std::string front_sentence(const Table1Model& model, const Table1Ratio& front) {
  return model.name + ": without the check, it takes " + times_delaunay(front) +
         ending(is_at_least(*front.value, least_gain), "at least ", "not surely ", "less than ") +
         rounded(least_gain, 1) + ".";
}

std::string check_reason(const Table1Model& model) {
  const Table1Costs& costs = *model.costs;
  return model.name + ": the check is one pass over the cells, labelling another; together they take " +
         rounded(costs.check_per_vertex) +
         " microseconds a vertex. That is linear, but the Delaunay stage that it is compared with takes only " +
         rounded(costs.delaunay_per_vertex) +
         " microseconds a vertex. (The paper's Delaunay took 26 to 36 s; it does not say for how many vertices.)";
}

std::string front_reason(const Table1Model& model) {
  return model.name + ": without the check, the front finds each apex in " +
         rounded(model.costs->front_per_tetrahedron) +
         " microseconds a tetrahedron; the cheaper that is, the less there is for the check to save.";
}

void add_model(const Table1Model& model, std::vector<std::string>& lines) {
  const Table1Ratio* check = ratio(model, "with_check/delaunay");
  const Table1Ratio* front = ratio(model, "without_check/delaunay");
  if (check != nullptr && check->paper) {
    lines.push_back(check_sentence(model, *check));
    if (model.costs && is_at_most(*check->value, *check->paper) != Claim::holds) lines.push_back(check_reason(model));
  }
  if (front != nullptr && front->paper) {
    lines.push_back(front_sentence(model, *front));
    if (model.costs && is_at_least(*front->value, *front->paper) != Claim::holds) lines.push_back(front_reason(model));
  }
}

}  // namespace

std::vector<std::string> table1_differences(const Table1& table) {
  std::vector<std::string> lines;
  for (const Table1Model& model : table.models) add_model(model, lines);
  return lines;
}

}  // namespace ccdt
