#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "reports/report.h"

namespace ccdt::reports {

/// Where the files of a report are.
struct WrittenReport {
  std::filesystem::path page;      ///< empty if there is none
  std::vector<std::string> notes;  ///< what could not be made, and what to do about it
};

/// Writes everything that is made of a report's JSON: report.json, claims.json, NAME.md and tables/ (Markdown, CSV,
/// LaTeX) for each experiment, figures/ (SVG, PDF, PNG), and the page index.html, which holds all of it.
///
/// \param folder  where the runs and meshes of the report are, and its files go
/// \param share   where ccdt's own files are: page.html, charts, render_figures.mjs
/// \throw OutputError  a file cannot be written
WrittenReport write_report(const Report& report, const std::filesystem::path& folder,
                           const std::filesystem::path& share);

/// The page with all that it shows inside: the report, the meshes of the viewer, and the raw JSON of every run and
/// experiment, deflated. Files that are missing are left out.
///
/// \param folder  where the files are that the report names
std::string fill_page(const std::string& page, const Report& report, const std::filesystem::path& folder);

}  // namespace ccdt::reports
