#include "reports/chart.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "engine/base/errors.h"
#include "engine/io/file_bytes.h"

namespace ccdt {
namespace {

/// What all charts have in common; whoever draws them has it.
constexpr const char* shared_file = "config.json";

ReportChart read_chart(const std::filesystem::path& file) {
  try {
    const Json json = Json::parse(io::read_whole_file(file).bytes);
    return {json.at("experiment"), json.at("name"),   json.at("title"),
            json.at("caption"),    json.at("tables"), json.at("spec").dump()};
  } catch (const Json::exception& error) {
    Place place;
    place.file = file.string();
    throw InputError(std::string("no chart: ") + error.what(), place, "build ccdt anew: its charts are broken");
  }
}

}  // namespace

std::vector<ReportChart> read_charts(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  if (!std::filesystem::exists(folder)) return {};
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".json" && entry.path().filename() != shared_file) files.push_back(entry.path());
  std::ranges::sort(files);
  std::vector<ReportChart> charts;
  for (const auto& file : files) charts.push_back(read_chart(file));
  return charts;
}

Json chart_json(const ReportChart& chart) {
  return {{"name", chart.name},
          {"title", chart.title},
          {"caption", chart.caption},
          {"tables", chart.tables},
          {"spec", Json::parse(chart.spec)}};
}

}  // namespace ccdt
