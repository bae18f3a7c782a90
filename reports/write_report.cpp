#include <fstream>
#include <future>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>
#include <utility>

#include "baselines/external_program.h"
#include "baselines/parse_json.h"
#include "baselines/process.h"
#include "bench/results/compact_mesh.h"
#include "bench/results/kept_mesh.h"
#include "engine/io/files.h"
#include "reports/report.h"
#include "reports/result_text.h"

namespace ccdt::reports {
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

/// Draws the charts and the cut-open meshes from the same descriptions that the page uses.
/// \return  what could not be drawn, and what to do about it
std::vector<std::string> draw_figures(const std::filesystem::path& folder, const std::filesystem::path& share) {
  const auto script = share / "render_figures.mjs";
  const auto node = baselines::find_program("node", "CCDT_NODE");
  if (!std::filesystem::exists(script))
    return {"No figures: this build has no " + script.string() + "; build it with CCDT_BUILD_PAGE=ON."};
  if (!node) return {"No figures: the program `node`, which draws them, is missing; install nodejs."};
  const baselines::TemporaryFolder work;
  const auto log = work.path() / "log";
  const int code = baselines::run_program({node->string(), script.string(), (folder / "report.json").string(),
                                           (folder / "figures").string()},
                                          {.log = log, .limits = baselines::Limits()})
                       .shell_code();
  std::vector<std::string> notes = lines_of(log);
  if (code != 0) notes.push_back("Some figures are missing: drawing ended with code " + std::to_string(code) + ".");
  return notes;
}

constexpr std::string_view place_of_data = "<!-- ccdt data -->";

std::string compact_text(const bench::Json& json) {
  return json.dump(-1, ' ', false, bench::Json::error_handler_t::replace);
}

/// JSON for a script element: nothing in it looks like HTML, such as the end of the element or a comment.
std::string inside_script(const std::string& json) {
  std::string text;
  text.reserve(json.size());
  for (const char c : json) c == '<' ? text += "\\u003c" : text += c;
  return text;
}

/// The JSON of each existing file, by name; not of a link that leads out of the folder.
bench::Json contents_of(const std::set<std::string>& files, const std::filesystem::path& folder) {
  bench::Json contents = bench::Json::object();
  for (const std::string& file : files) {
    if (!io::is_within(folder, folder / file)) continue;
    if (auto json = baselines::try_parse_json(io::read_whole_file(folder / file).bytes))
      contents[file] = *std::move(json);
  }
  return contents;
}

std::set<std::string> mesh_files(const Report& report) {
  std::set<std::string> files;
  for (const ReportSection& section : report.sections)
    for (const KeptMesh& mesh : section.result.meshes) files.insert(mesh.file);
  return files;
}

/// The kept meshes, reduced so that a page can hold many.
bench::Json compact_meshes(const Report& report, const std::filesystem::path& folder) {
  bench::Json meshes = contents_of(mesh_files(report), folder);
  for (auto& [file, mesh] : meshes.items()) mesh = results::compact_mesh(mesh);
  return meshes;
}

std::set<std::string> raw_files(const Report& report) {
  std::set<std::string> files;
  for (const ReportSection& section : report.sections) {
    if (!section.is_missing) files.insert(section.result.name + ".json");
    files.insert(section.result.raw_files.begin(), section.result.raw_files.end());
  }
  if (report.has_raw_runs)
    for (const auto& [file, run] : report.runs) files.insert(file);
  return files;
}

std::string element(const std::string& id, const std::string& type, const std::string& content) {
  return "<script type=\"" + type + "\" id=\"" + id + "\">" + content + "</script>\n";
}

constexpr std::size_t largest_plain_report = 3 << 19;  ///< bytes; larger files are compressed

/// \param json  of the report
std::string report_element(const std::string& json) {
  const std::string text = inside_script(json);
  if (text.size() <= largest_plain_report) return element("ccdt-report", "application/json", text);
  return element("ccdt-packed-report", "text/plain", results::packed(text.data(), text.size()));
}

std::string fill_page(const std::string& page, const Report& report, const std::string& report_text,
                      const std::filesystem::path& folder) {
  const auto at = page.find(place_of_data);
  if (at == std::string::npos) throw std::logic_error("the page has no place for the data");
  const std::string raw = compact_text(contents_of(raw_files(report), folder));
  return page.substr(0, at) + report_element(report_text) +
         element("ccdt-meshes", "application/json", inside_script(compact_text(compact_meshes(report, folder)))) +
         element("ccdt-files", "text/plain", results::packed(raw.data(), raw.size())) +
         page.substr(at + place_of_data.size());
}

}  // namespace

std::string fill_page(const std::string& page, const Report& report, const std::filesystem::path& folder) {
  return fill_page(page, report, compact_text(report_json(report)), folder);
}

WrittenReport write_report(const Report& report, const std::filesystem::path& folder,
                           const std::filesystem::path& share) {
  WrittenReport written;
  for (const char* part : {"tables", "figures"}) {
    std::filesystem::remove_all(folder / part);  // otherwise those of removed experiments would stay
    std::filesystem::create_directories(folder / part);
  }
  const bench::Json json = report_json(report);
  const std::string text = compact_text(json);
  // Nobody reads millions of lines, and writing and parsing them takes long.
  write_text(text.size() > largest_plain_report ? text : bench::to_text(json), folder / "report.json");
  write_text(bench::to_text(claims_json(report)), folder / "claims.json");
  // Drawing takes as long as everything else. If no thread can be started, it happens at the end.
  auto figures = std::async(std::launch::async | std::launch::deferred, draw_figures, folder, share);
  for (const ReportSection& section : report.sections) write_tables(section, folder);
  for (const auto& [name, content] : report.more_files) write_text(content, folder / name);
  const auto page = share / "page.html";
  if (std::filesystem::exists(page)) {
    written.page = folder / "index.html";
    write_text(fill_page(io::read_whole_file(page).bytes, report, text, folder), written.page);
  } else {
    written.notes.push_back("No page: this build has no " + page.string() + "; build it with CCDT_BUILD_PAGE=ON.");
  }
  const std::vector<std::string> notes = figures.get();
  written.notes.insert(written.notes.begin(), notes.begin(), notes.end());
  return written;
}

}  // namespace ccdt::reports
