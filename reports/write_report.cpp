#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>

#include "baselines/external_program.h"
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

/// Draws the charts and the cut-open meshes, by the same descriptions that the page has.
void draw_figures(const std::filesystem::path& folder, const std::filesystem::path& share, WrittenReport& written) {
  const auto script = share / "render_figures.mjs";
  const auto node = baselines::find_program("node", "CCDT_NODE");
  if (!std::filesystem::exists(script)) {
    written.notes.push_back("No figures: this build has no " + script.string() + "; build it with CCDT_BUILD_PAGE=ON.");
    return;
  }
  if (!node) {
    written.notes.emplace_back("No figures: they are drawn by the program `node`, which is not there; install nodejs.");
    return;
  }
  const baselines::TemporaryFolder work;
  const auto log = work.path() / "log";
  const int code = baselines::run_program({node->string(), script.string(), (folder / "report.json").string(),
                                           (folder / "figures").string()},
                                          {.log = log})
                       .shell_code();
  const std::vector<std::string> words = lines_of(log);
  written.notes.insert(written.notes.end(), words.begin(), words.end());
  if (code != 0) written.notes.push_back("Not all figures: drawing them ended with code " + std::to_string(code) + ".");
}

constexpr std::string_view place_of_data = "<!-- ccdt data -->";

/// JSON as a script element may hold it: nothing in it ends the element.
std::string inside_script(const bench::Json& json) {
  std::string text;
  for (const char c : json.dump(-1, ' ', false, bench::Json::error_handler_t::replace)) {
    if (c == '/' && text.ends_with('<')) text += '\\';
    text += c;
  }
  return text;
}

/// The JSON of each file that is there, by its name.
bench::Json contents_of(const std::set<std::string>& files, const std::filesystem::path& folder) {
  bench::Json contents = bench::Json::object();
  for (const std::string& file : files) {
    if (!std::filesystem::exists(folder / file)) continue;
    bench::Json json = bench::Json::parse(io::read_whole_file(folder / file).bytes, nullptr, false);
    if (!json.is_discarded()) contents[file] = std::move(json);
  }
  return contents;
}

std::set<std::string> mesh_files(const Report& report) {
  std::set<std::string> files;
  for (const ReportSection& section : report.sections)
    for (const KeptMesh& mesh : section.result.meshes) files.insert(mesh.file);
  return files;
}

/// The kept meshes, small enough for a page of many.
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

constexpr std::size_t largest_plain_report = 3 << 19;  ///< bytes; a larger one is deflated

std::string report_element(const Report& report) {
  const std::string text = inside_script(report_json(report));
  if (text.size() <= largest_plain_report) return element("ccdt-report", "application/json", text);
  return element("ccdt-packed-report", "text/plain", results::packed(text.data(), text.size()));
}

}  // namespace

std::string fill_page(const std::string& page, const Report& report, const std::filesystem::path& folder) {
  const auto at = page.find(place_of_data);
  if (at == std::string::npos) throw std::logic_error("the page has no place for the data");
  const std::string raw =
      contents_of(raw_files(report), folder).dump(-1, ' ', false, bench::Json::error_handler_t::replace);
  const std::string json = "application/json";
  return page.substr(0, at) + report_element(report) +
         element("ccdt-meshes", json, inside_script(compact_meshes(report, folder))) +
         element("ccdt-files", "text/plain", results::packed(raw.data(), raw.size())) +
         page.substr(at + place_of_data.size());
}

WrittenReport write_report(const Report& report, const std::filesystem::path& folder,
                           const std::filesystem::path& share) {
  WrittenReport written;
  for (const char* part : {"tables", "figures"}) {
    std::filesystem::remove_all(folder / part);  // or those of experiments that are gone would stay
    std::filesystem::create_directories(folder / part);
  }
  write_text(bench::to_text(report_json(report)), folder / "report.json");
  write_text(bench::to_text(claims_json(report)), folder / "claims.json");
  for (const ReportSection& section : report.sections) write_tables(section, folder);
  for (const auto& [name, content] : report.more_files) write_text(content, folder / name);
  draw_figures(folder, share, written);
  const auto page = share / "page.html";
  if (!std::filesystem::exists(page)) {
    written.notes.push_back("No page: this build has no " + page.string() + "; build it with CCDT_BUILD_PAGE=ON.");
    return written;
  }
  written.page = folder / "index.html";
  write_text(fill_page(io::read_whole_file(page).bytes, report, folder), written.page);
  return written;
}

}  // namespace ccdt::reports
