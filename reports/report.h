#pragma once

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "bench/results/experiment_result.h"
#include "reports/charts.h"
#include "reports/claims.h"

namespace ccdt::reports {

/// An experiment in a report.
struct ReportSection {
  ExperimentResult result;  ///< if missing: only the names, and the command that makes it
  bool is_missing = false;
  std::string reason;  ///< why it is missing
  std::vector<ReportChart> charts;
};

/// What a reader needs to repeat a run.
struct RunLine {
  std::string command;  ///< to be called in the folder of the report; it overwrites nothing. Empty if unknown
  std::string status;
  std::string mesher, version;
  std::vector<std::pair<std::string, std::string>> settings;  ///< in the terms of the mesher
};

/// The contents of a report.
struct Report {
  std::string title;
  std::vector<PaperClaim> claims;
  std::vector<ReportSection> sections;
  std::map<std::string, RunLine> runs;  ///< by file, relative to the folder
  bool has_raw_runs =
      true;  ///< the page contains the records of the runs; otherwise it links to them, because there are many
  std::map<std::string, std::string> more_files = {};  ///< files made from the runs, such as runs.csv: contents by name
};

/// Reads the JSON of a folder. For `ccdt reproduce`, an experiment that is missing or cannot be read is a section that
/// says so, and a missing run is a line that says so. For `ccdt sweep`, there is one section.
///
/// \throw InputError  the folder has neither an experiment nor a sweep
Report read_report(const std::filesystem::path& folder, std::span<const ReportChart> charts);

/// The report as JSON of schema `ccdt.report/1`, and only its claims as `ccdt.claims/1`.
bench::Json report_json(const Report& report);
bench::Json claims_json(const Report& report);

/// Compares two folders, as a report of one section: which deterministic figures differ, which times are outside the
/// interval of the first folder, and which verdicts have changed. Rows are matched by their labels.
///
/// \param into  the folder of the new report; its files are named relative to it
/// \throw InputError  one of the folders has no experiment
Report compare_reports(const std::filesystem::path& first, const std::filesystem::path& second,
                       const std::filesystem::path& into, std::span<const ReportChart> charts);

/// The files of a report.
struct WrittenReport {
  std::filesystem::path page;      ///< empty if there is none
  std::vector<std::string> notes;  ///< what could not be made, and what to do about it
};

/// Writes everything that is made from the JSON of a report: report.json, claims.json, NAME.md and tables/ (Markdown,
/// CSV, LaTeX) for each experiment, figures/ (SVG, PDF, PNG), more files, and the page index.html, which contains all
/// of it.
///
/// \param folder  where the runs and meshes of the report are, and its files go
/// \param share   where ccdt's own files are: page.html, charts, render_figures.mjs
/// \throw OutputError  a file cannot be written
WrittenReport write_report(const Report& report, const std::filesystem::path& folder,
                           const std::filesystem::path& share);

/// The page with all its data inside: the report, the meshes of the viewer, and the raw JSON of every run and
/// experiment, compressed. Missing files are left out.
///
/// \param folder  where the files are that the report names
std::string fill_page(const std::string& page, const Report& report, const std::filesystem::path& folder);

}  // namespace ccdt::reports
