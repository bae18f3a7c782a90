#include <nlohmann/json.hpp>
#include <sstream>

#include "bench/experiments/experiment_json.h"
#include "bench/experiments/fig8.h"
#include "bench/experiments/measured_case.h"

namespace ccdt {
namespace {

Json point_json(const Fig8Point& point) {
  Json samples = Json::array();
  for (const StageSeconds& s : point.samples) samples.push_back(stages_json(s));
  Json json = {{"edge_length", point.edge_length},
               {"status", name_of(point.status)},
               {"cdt_seconds", estimate_json(point.cdt)},
               {"runs", point.samples.size()},
               {"samples", samples},
               {"counts", counts_json(point.counts)}};
  if (!point.reason.empty()) json["reason"] = point.reason;
  return json;
}

Json slope_json(const Estimate& slope) {
  return {{"value", slope.value}, {"low", slope.low}, {"high", slope.high}};
}

Json fit_json(const Fig8Fit& fit) {
  return {{"id", fit.id},
          {"exponent", slope_json(fit.power.slope)},
          {"claim", name_of(is_at_most(fit.power.slope, claimed_exponent))},
          {"exponent_r_squared", fit.power.r_squared},
          {"seconds_per_vertex", slope_json(fit.line.slope)},
          {"seconds_at_zero", fit.line.intercept},
          {"r_squared", fit.line.r_squared}};
}

Json series_json(const Fig8Series& series) {
  Json points = Json::array(), fits = Json::array();
  for (const Fig8Point& point : series.points) points.push_back(point_json(point));
  for (const Fig8Fit& fit : series.fits) fits.push_back(fit_json(fit));
  return {{"id", series.id}, {"label", series.label}, {"points", points}, {"fits", fits}};
}

}  // namespace

std::string to_json(const Fig8& fig8) {
  Json json = head_json("ccdt.fig8/1", fig8_definitions(), fig8.how);
  json["claimed_exponent"] = claimed_exponent;
  json["models"] = Json::array();
  for (const Fig8Model& model : fig8.models) {
    Json series = Json::array();
    for (const Fig8Series& s : model.series) series.push_back(series_json(s));
    json["models"].push_back({{"name", model.name}, {"series", series}});
  }
  return to_text(json);
}

std::string to_csv(const Fig8& fig8) {
  std::ostringstream text;
  text.precision(17);
  text << "model,strategy,edge_length,run,vertices,tetrahedra,delaunay,face_check,front,label,cdt,mesh\n";
  for (const Fig8Model& model : fig8.models)
    for (const Fig8Series& series : model.series)
      for (const Fig8Point& point : series.points)
        for (std::size_t run = 0; run < point.samples.size(); ++run) {
          const StageSeconds& s = point.samples[run];
          text << model.name << ',' << series.id << ',' << point.edge_length << ',' << run + 1 << ','
               << point.counts.vertices << ',' << point.counts.tetrahedra << ',' << s.delaunay << ',' << s.face_check
               << ',' << s.front << ',' << s.label << ',' << cdt_seconds(s) << ',' << s.mesh << '\n';
        }
  return text.str();
}

}  // namespace ccdt
