#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "reports/report.h"

namespace ccdt {

/// What became of a report's files.
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

}  // namespace ccdt
