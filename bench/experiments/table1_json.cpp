#include <nlohmann/json.hpp>

#include "bench/experiments/experiment_json.h"
#include "bench/experiments/table1.h"

namespace ccdt {
namespace {

Json row_json(const Table1Row& row) {
  Json json = {{"id", row.id},
               {"label", row.label},
               {"status", name_of(row.status)},
               {"seconds", estimate_json(row.seconds)},
               {"samples", row.samples},
               {"paper_seconds", optional_json(row.paper_seconds)},
               {"counts", counts_json(row.counts)}};
  if (!row.reason.empty()) json["reason"] = row.reason;
  return json;
}

Json costs_json(const std::optional<Table1Costs>& costs) {
  if (!costs) return nullptr;
  return {{"delaunay_per_vertex", costs->delaunay_per_vertex},
          {"check_per_vertex", costs->check_per_vertex},
          {"front_per_tetrahedron", costs->front_per_tetrahedron}};
}

Json model_json(const Table1Model& model) {
  Json rows = Json::array(), ratios = Json::array();
  for (const Table1Row& row : model.rows) rows.push_back(row_json(row));
  for (const Table1Ratio& ratio : model.ratios)
    ratios.push_back({{"id", ratio.id},
                      {"label", ratio.label},
                      {"ratio", estimate_json(ratio.value)},
                      {"paper_ratio", optional_json(ratio.paper)}});
  return {{"name", model.name},
          {"edge_length", model.edge_length},
          {"same_tetrahedra", model.same_tetrahedra},
          {"rows", rows},
          {"ratios", ratios},
          {"microseconds", costs_json(model.costs)}};
}

}  // namespace

std::string to_json(const Table1& table) {
  Json models = Json::array();
  for (const Table1Model& model : table.models) models.push_back(model_json(model));
  Json json = head_json("ccdt.table1/1", table1_definitions(), table.how);
  json["models"] = models;
  return to_text(json);
}

}  // namespace ccdt
