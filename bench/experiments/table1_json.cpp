#include <nlohmann/json.hpp>

#include "bench/experiments/table1.h"
#include "bench/json_parts.h"

namespace ccdt {
namespace {

Json estimate_json(const std::optional<Estimate>& estimate) {
  if (!estimate) return nullptr;
  return {{"median", estimate->value}, {"low", estimate->low}, {"high", estimate->high}};
}

Json optional_json(const std::optional<double>& value) {
  return value ? Json(*value) : Json(nullptr);
}

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
          {"ratios", ratios}};
}

}  // namespace

std::string to_json(const Table1& table) {
  Json models = Json::array();
  for (const Table1Model& model : table.models) models.push_back(model_json(model));
  const Json json = {{"schema", "ccdt.table1/1"},
                     {"definitions", table1_definitions()},
                     {"runs", table.runs},
                     {"confidence", Bootstrap{}.confidence},
                     {"limits", {{"seconds", table.limits.seconds}, {"memory_bytes", table.limits.memory_bytes}}},
                     {"environment", environment_json(table.environment)},
                     {"models", models}};
  return to_text(json);
}

}  // namespace ccdt
