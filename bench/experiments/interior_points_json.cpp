#include <nlohmann/json.hpp>

#include "bench/experiments/experiment_json.h"
#include "bench/experiments/interior_points.h"
#include "bench/run_record.h"

namespace ccdt {
namespace {

Json case_json(const InteriorCase& c) {
  Json json = {{"input", c.input},        {"edge_length", c.edge_length}, {"lattice", name_of(c.lattice)},
               {"rule", name_of(c.rule)}, {"status", name_of(c.status)},  {"placed", c.placed},
               {"dropped", c.dropped}};
  if (!c.reason.empty()) json["reason"] = c.reason;
  return json;
}

Json summary_json(const InteriorPoints& points, InteriorRule rule) {
  const InteriorSummary s = summarize(points.cases, rule);
  return {{"rule", name_of(rule)}, {"cases", s.cases},   {"failed", s.failed},
          {"harmed", s.harmed},    {"placed", s.placed}, {"dropped", s.dropped}};
}

}  // namespace

std::string to_json(const InteriorPoints& points) {
  Json json = head_json("ccdt.interior-points/1", interior_points_definitions(), points.how);
  json["summary"] = Json::array();
  for (const InteriorRule rule : {InteriorRule::paper, InteriorRule::no_spheres, InteriorRule::no_distances})
    json["summary"].push_back(summary_json(points, rule));
  json["cases"] = Json::array();
  for (const InteriorCase& c : points.cases) json["cases"].push_back(case_json(c));
  return to_text(json);
}

}  // namespace ccdt
