#include <nlohmann/json.hpp>

#include "bench/experiments/experiment_json.h"
#include "bench/experiments/locators.h"
#include "bench/run_record.h"

namespace ccdt {
namespace {

Json row_json(const LocatorsRow& row) {
  Json json = {{"locator", name_of(row.locator)},
               {"status", name_of(row.status)},
               {"front_seconds", estimate_json(row.seconds)},
               {"samples", row.samples}};
  if (!row.reason.empty()) json["reason"] = row.reason;
  return json;
}

Json case_json(const LocatorsCase& c) {
  Json rows = Json::array();
  for (const LocatorsRow& row : c.rows) rows.push_back(row_json(row));
  const auto claim = expectation(c);
  return {{"name", c.name},
          {"kind", name_of(c.kind)},
          {"face_protection", c.face_protection},
          {"edge_ratio", c.edge_ratio},
          {"counts", counts_json(c.counts)},
          {"rows", rows},
          {"octree/grid", estimate_json(c.octree_over_grid)},
          {"cavity/grid", estimate_json(c.cavity_over_grid)},
          {"claim", claim ? Json(name_of(*claim)) : Json(nullptr)}};
}

}  // namespace

std::string to_json(const Locators& locators) {
  Json json = head_json("ccdt.locators/1", locators_definitions(), locators.how);
  json["cases"] = Json::array();
  for (const LocatorsCase& c : locators.cases) json["cases"].push_back(case_json(c));
  return to_text(json);
}

}  // namespace ccdt
