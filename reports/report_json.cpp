#include <nlohmann/json.hpp>

#include "reports/report.h"

namespace ccdt {
namespace {

Json measure_json(const ClaimMeasure& m) {
  return {{"what", m.what},
          {"value", cell_json(m.value)},
          {"bound", m.bound},
          {"holds", m.strong == Claim::undecided ? Json(nullptr) : Json(m.strong == Claim::holds)},
          {"experiment", m.experiment},
          {"table", m.table},
          {"runs", m.runs}};
}

Json claim_json(const PaperClaim& claim) {
  Json measured = Json::array();
  for (const ClaimMeasure& m : claim.measured) measured.push_back(measure_json(m));
  return {{"id", claim.id},
          {"section", claim.section},
          {"sentence", claim.sentence},
          {"experiments", claim.experiments},
          {"measured", measured},
          {"verdict", name_of(claim.verdict)},
          {"reason", claim.reason}};
}

std::string_view status_of(const ReportSection& section) {
  if (section.is_missing) return "missing";
  return section.result.is_good ? "ok" : "failed";
}

Json section_json(const ReportSection& section) {
  const ExperimentResult& result = section.result;
  Json charts = Json::array();
  for (const ReportChart& chart : section.charts) charts.push_back(chart_json(chart));
  Json json = {{"name", result.name},
               {"title", result.title},
               {"section", result.section},
               {"status", status_of(section)},
               {"reason", section.reason},
               {"command", result.how.command},
               {"definitions", result.definitions},
               {"findings", result.findings},
               {"problems", result.problems},
               {"tables", result.tables},
               {"charts", charts},
               {"meshes", result.meshes},
               {"raw_files", result.raw_files}};
  if (section.is_missing) return json;
  json["scale"] = result.how.scale;
  json["tetrahedra"] = result.how.tetrahedra;
  json["runs"] = result.how.runs;
  json["confidence"] = result.how.confidence;
  json["limits"] = {{"seconds", result.how.limits.seconds}, {"memory_bytes", result.how.limits.memory_bytes}};
  json["environment"] = result.how.environment;
  return json;
}

Json run_json(const RunLine& run) {
  Json settings = Json::object();
  for (const auto& [name, words] : run.settings) settings[name] = words;
  return {{"command", run.command},
          {"status", run.status},
          {"mesher", run.mesher},
          {"version", run.version},
          {"settings", settings}};
}

Json all_claims(const Report& report) {
  Json claims = Json::array();
  for (const PaperClaim& claim : report.claims) claims.push_back(claim_json(claim));
  return claims;
}

}  // namespace

Json report_json(const Report& report) {
  Json sections = Json::array(), runs = Json::object();
  for (const ReportSection& section : report.sections) sections.push_back(section_json(section));
  for (const auto& [file, run] : report.runs) runs[file] = run_json(run);
  return {{"schema", "ccdt.report/1"},
          {"title", report.title},
          {"claims", all_claims(report)},
          {"experiments", sections},
          {"runs", runs}};
}

Json claims_json(const Report& report) {
  return {{"schema", "ccdt.claims/1"}, {"claims", all_claims(report)}};
}

}  // namespace ccdt
