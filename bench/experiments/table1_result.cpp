#include <algorithm>

#include "bench/experiments/table1.h"
#include "bench/results/numbers.h"
#include "bench/results/result_table.h"

namespace ccdt {
namespace {

ResultTable sizes_table(const Table1& table) {
  ResultTable sizes{"sizes",
                    "The meshes",
                    {{"model", "model", ColumnKind::label},
                     {"edge_length", "edge length", ColumnKind::figure, "mm"},
                     {"vertices", "vertices"},
                     {"steiner_vertices", "Steiner vertices"},
                     {"interior_vertices", "interior vertices"},
                     {"tetrahedra", "tetrahedra"},
                     {"faces", "faces"},
                     {"undelaunay_faces", "faces that are not Delaunay"},
                     {"same_tetrahedra", "same tetrahedra without the check"}}};
  for (const Table1Model& model : table.models) {
    const Table1Row& row = model.rows.front();
    const MeshCounts& c = row.counts;
    sizes.rows.push_back({{cell_of(model.name), model.edge_length, cell_of(c.vertices), cell_of(c.steiner_vertices),
                           cell_of(c.interior_vertices), cell_of(c.tetrahedra), cell_of(c.faces),
                           cell_of(c.undelaunay_faces), cell_of(model.same_tetrahedra)},
                          row.runs});
  }
  return sizes;
}

ResultTable times_table(const Table1& table) {
  ResultTable times{"times",
                    "Seconds",
                    {{"model", "model", ColumnKind::label},
                     {"what", "what is timed", ColumnKind::label},
                     {"status", "status", ColumnKind::label},
                     {"seconds", "seconds", ColumnKind::time, "s"},
                     {"paper_seconds", "in the paper", ColumnKind::paper, "s"},
                     {"vertices", "vertices"},
                     {"tetrahedra", "tetrahedra"},
                     {"reason", "reason", ColumnKind::note}}};
  for (const Table1Model& model : table.models)
    for (const Table1Row& row : model.rows)
      times.rows.push_back(
          {{cell_of(model.name), cell_of(row.label), cell_of(name_of(row.status)), cell_of(row.seconds),
            cell_of(row.paper_seconds), row.seconds ? cell_of(row.counts.vertices) : Cell(),
            row.seconds ? cell_of(row.counts.tetrahedra) : Cell(), cell_of(row.reason)},
           row.runs});
  return times;
}

ResultTable ratios_table(const Table1& table) {
  ResultTable ratios{"ratios",
                     "Ratios",
                     {{"model", "model", ColumnKind::label},
                      {"ratio", "ratio", ColumnKind::label},
                      {"value", "here", ColumnKind::time},
                      {"paper_value", "in the paper", ColumnKind::paper}}};
  for (const Table1Model& model : table.models)
    for (const Table1Ratio& ratio : model.ratios)
      if (ratio.value)
        ratios.rows.push_back(
            {{cell_of(model.name), cell_of(ratio.label), cell_of(ratio.value), cell_of(ratio.paper)}, ratio.runs});
  return ratios;
}

ResultTable costs_table(const Table1& table) {
  ResultTable costs{"costs",
                    "What a unit of work costs",
                    {{"model", "model", ColumnKind::label},
                     {"delaunay", "Delaunay, a vertex", ColumnKind::time, "us"},
                     {"check", "face check, front and labels, a vertex", ColumnKind::time, "us"},
                     {"front", "front without the check, a tetrahedron", ColumnKind::time, "us"}}};
  for (const Table1Model& model : table.models)
    if (model.costs)
      costs.rows.push_back({{cell_of(model.name), model.costs->delaunay_per_vertex, model.costs->check_per_vertex,
                             model.costs->front_per_tetrahedron},
                            model.rows.front().runs});
  return costs;
}

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

/// Where our ratios differ from the paper's, and why, as measured.
void add_differences(const Table1Model& model, std::vector<std::string>& lines) {
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

void add_problems(const Table1Model& model, ExperimentResult& result) {
  for (const Table1Row& row : model.rows) {
    if (row.status == RunStatus::ok) continue;
    result.problems.push_back(model.name + ", " + row.label + ": " + std::string(name_of(row.status)) + ": " +
                              row.reason);
    result.is_good = result.is_good && !row.paper_seconds;
  }
  if (!model.same_tetrahedra) {
    result.problems.push_back(model.name +
                              ": with and without the check, the tetrahedra differ, which is an error of ccdt");
    result.is_good = false;
  }
}

}  // namespace

ExperimentResult result_of(const Table1& table) {
  ExperimentResult result{.how = table.how, .definitions = table1_definitions()};
  if (table.models.empty()) return result;
  result.tables = {ratios_table(table), times_table(table), sizes_table(table), costs_table(table)};
  for (const Table1Model& model : table.models) {
    add_differences(model, result.findings);
    add_problems(model, result);
  }
  return result;
}

}  // namespace ccdt
