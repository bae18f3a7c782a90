#include "bench/quality_json.h"

#include <limits>
#include <nlohmann/json.hpp>

namespace ccdt {
namespace {

Json histogram_json(const Histogram& h) {
  return {{"edges", h.edges}, {"counts", h.counts}};
}

Histogram histogram_from(const Json& j) {
  return {j.at("edges"), j.at("counts")};
}

Json measure_json(const Quality::Measure& m) {
  return {{"min", m.min}, {"mean", m.mean}, {"median", m.median},
          {"p99", m.p99}, {"max", m.max},   {"histogram", histogram_json(m.histogram)}};
}

Quality::Measure measure_from(const Json& j) {
  return {number_from_json(j.at("min")), number_from_json(j.at("mean")), number_from_json(j.at("median")),
          number_from_json(j.at("p99")), number_from_json(j.at("max")),  histogram_from(j.at("histogram"))};
}

}  // namespace

double number_from_json(const Json& value) {
  return value.is_null() ? std::numeric_limits<double>::infinity() : value.get<double>();
}

Json quality_json(const Quality& q) {
  return {{"r", measure_json(q.r)},
          {"dihedral_degrees",
           {{"min", q.dihedral_degrees.min},
            {"max", q.dihedral_degrees.max},
            {"histogram", histogram_json(q.dihedral_degrees.histogram)}}},
          {"aspect_ratio", measure_json(q.aspect_ratio)},
          {"radius_edge_ratio", measure_json(q.radius_edge_ratio)}};
}

Quality quality_from_json(const Json& json) {
  Quality q;
  q.r = measure_from(json.at("r"));
  const Json& d = json.at("dihedral_degrees");
  q.dihedral_degrees = {number_from_json(d.at("min")), number_from_json(d.at("max")),
                        histogram_from(d.at("histogram"))};
  if (json.contains("aspect_ratio")) q.aspect_ratio = measure_from(json.at("aspect_ratio"));
  if (json.contains("radius_edge_ratio")) q.radius_edge_ratio = measure_from(json.at("radius_edge_ratio"));
  return q;
}

}  // namespace ccdt
