#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "bench/results/experiment_result.h"

namespace ccdt::reports {

/// A chart makes sense only where a column of one of its tables has so many different values.
struct ChartNeed {
  std::string table, column;
  std::size_t values = 1;
};

/// A declarative description of a chart: Vega-Lite, without its data, which are tables of an experiment.
struct ReportChart {
  std::string experiment, name, title, caption;
  std::vector<std::string> tables;  ///< each a data set of its name
  std::string spec;                 ///< the JSON of Vega-Lite
  std::vector<ChartNeed> needs = {};
  /// A column of the first table; with it, the chart is made for pairs of columns that this one depends on. {first},
  /// {second}, {first title} and {second title} stand for them.
  std::string map_of = {};
};

/// All charts of a folder, by the names of their files. None if there is no such folder.
/// \throw InputError  a file is no chart
std::vector<ReportChart> read_charts(const std::filesystem::path& folder);

/// Those charts that an experiment has the data for. A chart of axes is made for the pairs that tell most.
std::vector<ReportChart> charts_for(const results::ExperimentResult& result, std::span<const ReportChart> charts);

}  // namespace ccdt::reports
