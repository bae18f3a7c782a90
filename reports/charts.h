#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "bench/results/experiment_result.h"

namespace ccdt::reports {

/// The least number of different values of a column for which a chart makes sense.
struct ChartNeed {
  std::string table, column;
  std::size_t values = 1;
};

/// A declarative description of a chart: Vega-Lite without data. The data are tables of an experiment.
struct ReportChart {
  std::string experiment, name, title, caption;
  std::vector<std::string> tables;  ///< each is a data set of this name
  std::string spec;                 ///< the JSON of Vega-Lite
  std::vector<ChartNeed> needs = {};
  /// A column of the first table. If given, the chart is made for pairs of columns on which this one depends; {first},
  /// {second}, {first title} and {second title} stand for them.
  std::string map_of = {};
};

/// All charts of a folder, by the names of their files. None if there is no such folder.
/// \throw InputError  a file is not a chart
std::vector<ReportChart> read_charts(const std::filesystem::path& folder);

/// The charts for which an experiment has data. A chart of axes is made for the most important pairs.
std::vector<ReportChart> charts_for(const results::ExperimentResult& result, std::span<const ReportChart> charts);

}  // namespace ccdt::reports
