#include "reports/table1_differences.h"

#include <algorithm>

#include "reports/numbers.h"

namespace ccdt {
namespace {

const Table1Ratio* ratio(const Table1Model& model, std::string_view id) {
  const auto found = std::ranges::find(model.ratios, id, &Table1Ratio::id);
  return found != model.ratios.end() && found->value ? &*found : nullptr;
}

std::string beside_paper(const Table1Ratio& ratio) {
  return with_interval(*ratio.value) + (ratio.paper ? ", in the paper " + rounded(*ratio.paper, 4) : "");
}

/// What an interval says of the paper's figure, which is known without one.
std::string words(Claim claim, const char* holds, const char* undecided, const char* fails) {
  return claim == Claim::holds ? holds : claim == Claim::fails ? fails : undecided;
}

std::string check_sentence(const Table1Model& model, const Table1Ratio& check) {
  return model.name + ": with the check the CDT costs " + beside_paper(check) + ", times Delaunay: " +
         words(is_at_most(*check.value, *check.paper), "not more than there.",
               "not to be told from there by these runs.", "more than there.");
}

std::string front_sentence(const Table1Model& model, const Table1Ratio& front) {
  return model.name + ": without it " + beside_paper(front) +
         ", times Delaunay: " + words(is_at_least(*front.value, least_gain), "at least ", "not surely ", "less than ") +
         rounded(least_gain, 1) + ".";
}

std::string check_reason(const Table1Model& model) {
  const Table1Costs& costs = *model.costs;
  return model.name + ": the check is one pass over faces and cells, and labelling another; both together take " +
         rounded(costs.check_per_vertex, 3) +
         " microseconds a vertex. They are linear as in the paper, but weigh as much as they do because they are "
         "compared with a Delaunay stage of " +
         rounded(costs.delaunay_per_vertex, 3) +
         " microseconds a vertex. (The paper's took 26 to 36 s; of how many vertices it does not say.)";
}

std::string front_reason(const Table1Model& model) {
  const Table1Costs& costs = *model.costs;
  return model.name + ": without the check the front finds each apex in " + rounded(costs.front_per_tetrahedron, 3) +
         " microseconds a tetrahedron, which is what is left to be gained.";
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
