#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/json.h"

namespace ccdt {

/// A declarative description of a chart: Vega-Lite, without its data, which are tables of an experiment.
struct ReportChart {
  std::string experiment, name, title, caption;
  std::vector<std::string> tables;  ///< each a data set of its name
  std::string spec;                 ///< the JSON of Vega-Lite
};

/// All charts of a folder, by the names of their files. None if there is no such folder.
/// \throw InputError  a file is no chart
std::vector<ReportChart> read_charts(const std::filesystem::path& folder);

Json chart_json(const ReportChart& chart);

}  // namespace ccdt
