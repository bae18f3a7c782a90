#include "reports/check_text.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "bench/run/json.h"
#include "bench/run/numbers.h"
#include "engine/base/digits.h"

namespace ccdt::reports {
namespace {

using bench::Json;
using bench::with_separators;
using repair::Diagnosis;
using repair::Fault;
using repair::RepairStep;

std::string plural(std::uint64_t count, const std::string& one) {
  return with_separators(count) + " " + one + (count == 1 ? "" : "s");
}

std::string what_of(repair::FaultKind kind) {
  for (const auto& named : names_of(kind))
    if (named.value == kind) return std::string(named.what);
  return {};
}

/// The first items of a list, as many as fit into a line.
template <class Items, class ToText>
std::string first_few(const Items& items, const ToText& to_text) {
  constexpr std::size_t most = 4;
  std::string text;
  for (std::size_t i = 0; i < std::min(most, items.size()); ++i) text += (i == 0 ? "" : ", ") + to_text(items[i]);
  if (items.size() > most) text += ", and " + with_separators(items.size() - most) + " more";
  return text;
}

std::string line_of(const Place& place) {
  std::string text;
  if (!place.facets.empty())
    text = (place.facets.size() == 1 ? "facet " : "facets ") +
           first_few(place.facets, [](long long facet) { return std::to_string(facet); });
  if (place.points.empty()) return text;
  const auto point = [](const std::array<double, 3>& p) {
    return "(" + digits(p[0]) + ", " + digits(p[1]) + ", " + digits(p[2]) + ")";
  };
  return text + (text.empty() ? "at " : " at ") + first_few(place.points, point);
}

Json to_json(const Place& place) {
  return {{"facets", place.facets}, {"points", place.points}};
}

Json to_json(const Diagnosis& diagnosis) {
  Json faults = Json::array();
  for (const Fault& fault : diagnosis.faults) {
    Json places = Json::array();
    for (const Place& place : fault.places) places.push_back(to_json(place));
    faults.push_back({{"kind", name_of(fault.kind)},
                      {"what", what_of(fault.kind)},
                      {"is_error", fault.is_error},
                      {"count", fault.count},
                      {"at_least", fault.at_least},
                      {"detail", fault.detail},
                      {"places", places}});
  }
  return {{"valid", diagnosis.is_valid()},
          {"vertices", diagnosis.vertices},
          {"facets", diagnosis.facets},
          {"segments", diagnosis.segments},
          {"regions", diagnosis.regions},
          {"volume", diagnosis.volume},
          {"faults", faults}};
}

Json to_json(const repair::Certificate& c) {
  return {{"displacement", c.displacement},
          {"area_before", c.area_before},
          {"area_after", c.area_after},
          {"area_of_lids", c.area_of_lids},
          {"area_removed", c.area_removed},
          {"largest_lid", c.largest_lid},
          {"farthest_lid", c.farthest_lid},
          {"volume_before", c.volume_before ? Json(*c.volume_before) : Json()},
          {"components_before", c.components_before},
          {"components_after", c.components_after},
          {"genus", c.genus ? Json(*c.genus) : Json()}};
}

Json to_json(const CheckReport::Copy& copy) {
  Json steps = Json::array();
  for (const RepairStep& step : copy.steps) {
    Json places = Json::array();
    for (const Place& place : step.places) places.push_back(to_json(place));
    steps.push_back({{"name", step.name}, {"what", step.what}, {"count", step.count}, {"places", places}});
  }
  Json json = {{"output", copy.output.empty() ? Json() : Json(copy.output)},
               {"steps", steps},
               {"certificate", to_json(copy.certificate)},
               {"refused", copy.refused},
               {"out_of_time", copy.is_out_of_time}};
  json.update(to_json(copy.diagnosis));
  return json;
}

std::string padded(const std::string& text, std::size_t width) {
  return std::string(width - std::min(width, text.size()), ' ') + text;
}

}  // namespace

std::string to_terminal(const Diagnosis& diagnosis, std::size_t most_places) {
  std::string text;
  constexpr std::size_t width = 9;
  for (const Fault& fault : diagnosis.faults) {
    const std::string count = (fault.at_least ? ">" : "") + with_separators(fault.count);
    text += (fault.is_error ? "error " : "note  ") + padded(count, width) + "  " + what_of(fault.kind) +
            (fault.detail.empty() ? "" : " (" + fault.detail + ")") + "\n";
    const std::size_t shown = std::min(most_places, fault.places.size());
    for (std::size_t i = 0; i < shown; ++i) {
      const std::string line = line_of(fault.places[i]);
      if (!line.empty()) text += std::string(width + 8, ' ') + line + "\n";
    }
  }
  return text;
}

std::string to_terminal(const CheckReport::Copy& copy) {
  std::string text;
  constexpr std::size_t width = 9;
  for (const RepairStep& step : copy.steps)
    text += "done  " + padded(with_separators(step.count), width) + "  " + std::string(step.what) + "\n";
  return text + "result " + padded("", width) + " " + in_few_words(copy.certificate) + "\n";
}

std::string in_few_words(const repair::Certificate& certificate) {
  const auto rounded = [](double x) { return bench::rounded(x, 4); };
  std::string text = certificate.displacement == 0 ? "nothing moved"
                                                   : "nothing moved farther than " + rounded(certificate.displacement);
  text += ", area " + rounded(certificate.area_before) + " became " + rounded(certificate.area_after);
  if (certificate.area_of_lids > 0)
    text += ", of which lids " + rounded(certificate.area_of_lids) + " (largest " + rounded(certificate.largest_lid) +
            ", up to " + rounded(certificate.farthest_lid) + " from its rim)";
  if (certificate.volume_before) text += ", the volume was " + rounded(*certificate.volume_before);
  return text;
}

std::string in_few_words(const Diagnosis& diagnosis) {
  const auto errors = static_cast<std::uint64_t>(std::ranges::count(diagnosis.faults, true, &Fault::is_error));
  if (errors > 0) return errors == 1 ? "1 kind of error" : with_separators(errors) + " kinds of errors";
  return plural(diagnosis.facets, "facet") + ", " + plural(diagnosis.regions, "region") + ", volume " +
         bench::rounded(diagnosis.volume, 6);
}

std::string to_json(const CheckReport& report) {
  Json json = {{"schema", "ccdt.check/1"}, {"input", report.input}};
  json.update(to_json(report.diagnosis));
  json["copy"] = report.copy ? to_json(*report.copy) : Json();
  return bench::to_text(json);
}

}  // namespace ccdt::reports
