#include "reports/write_report.h"

#include <fstream>
#include <nlohmann/json.hpp>

#include "baselines/external_program.h"
#include "baselines/process.h"
#include "engine/io/output_file.h"
#include "reports/page.h"
#include "reports/result_text.h"

namespace ccdt {
namespace {

void write_text(const std::string& text, const std::filesystem::path& file) {
  io::OutputFile output(file);
  output << text;
  output.commit();
}

void write_tables(const ReportSection& section, const std::filesystem::path& folder) {
  if (section.is_missing) return;
  const ExperimentResult& result = section.result;
  write_text(to_markdown(result), folder / (result.name + ".md"));
  for (const ResultTable& table : result.tables) {
    const std::string stem = result.name + "-" + table.name;
    write_text(to_csv(table), folder / "tables" / (stem + ".csv"));
    if (table.is_data || table.rows.empty()) continue;
    write_text(to_markdown(text_table(table)), folder / "tables" / (stem + ".md"));
    write_text(to_latex(table, result.name), folder / "tables" / (stem + ".tex"));
  }
}

std::vector<std::string> lines_of(const std::filesystem::path& file) {
  std::vector<std::string> lines;
  std::ifstream text(file);
  for (std::string line; std::getline(text, line);)
    if (!line.empty()) lines.push_back(line);
  return lines;
}

/// Draws the charts and the cut-open meshes, by the same descriptions that the page has.
void draw_figures(const std::filesystem::path& folder, const std::filesystem::path& share, WrittenReport& written) {
  const auto script = share / "render_figures.mjs";
  const auto node = find_program("node", "CCDT_NODE");
  if (!std::filesystem::exists(script)) {
    written.notes.push_back("No figures: this build has no " + script.string() + "; build it with CCDT_BUILD_PAGE=ON.");
    return;
  }
  if (!node) {
    written.notes.emplace_back("No figures: they are drawn by the program `node`, which is not there; install nodejs.");
    return;
  }
  const TemporaryFolder work;
  const auto log = work.path() / "log";
  const int code =
      run_program({node->string(), script.string(), (folder / "report.json").string(), (folder / "figures").string()},
                  {.log = log})
          .shell_code();
  const std::vector<std::string> words = lines_of(log);
  written.notes.insert(written.notes.end(), words.begin(), words.end());
  if (code != 0) written.notes.push_back("Not all figures: drawing them ended with code " + std::to_string(code) + ".");
}

}  // namespace

WrittenReport write_report(const Report& report, const std::filesystem::path& folder,
                           const std::filesystem::path& share) {
  WrittenReport written;
  for (const char* part : {"tables", "figures"}) {
    std::filesystem::remove_all(folder / part);  // or those of experiments that are gone would stay
    std::filesystem::create_directories(folder / part);
  }
  write_text(to_text(report_json(report)), folder / "report.json");
  write_text(to_text(claims_json(report)), folder / "claims.json");
  for (const ReportSection& section : report.sections) write_tables(section, folder);
  draw_figures(folder, share, written);
  const auto page = page_template(share);
  if (!page) {
    written.notes.push_back("No page: this build has no " + (share / "page.html").string() +
                            "; build it with CCDT_BUILD_PAGE=ON.");
    return written;
  }
  written.page = folder / "index.html";
  write_text(fill_page(*page, report, folder), written.page);
  return written;
}

}  // namespace ccdt
