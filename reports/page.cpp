#include "reports/page.h"

#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>

#include "bench/results/kept_mesh.h"
#include "engine/base/errors.h"
#include "engine/io/file_bytes.h"

namespace ccdt {
namespace {

constexpr std::string_view place_of_data = "<!-- ccdt data -->";

/// JSON as a script element may hold it: nothing in it ends the element.
std::string inside_script(const Json& json) {
  std::string text;
  for (const char c : json.dump(-1, ' ', false, Json::error_handler_t::replace)) {
    if (c == '/' && text.ends_with('<')) text += '\\';
    text += c;
  }
  return text;
}

/// The JSON of each file that is there, by its name.
Json contents_of(const std::set<std::string>& files, const std::filesystem::path& folder) {
  Json contents = Json::object();
  for (const std::string& file : files) {
    if (!std::filesystem::exists(folder / file)) continue;
    Json json = Json::parse(io::read_whole_file(folder / file).bytes, nullptr, false);
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

std::set<std::string> raw_files(const Report& report) {
  std::set<std::string> files;
  for (const ReportSection& section : report.sections) {
    if (!section.is_missing) files.insert(section.result.name + ".json");
    files.insert(section.result.raw_files.begin(), section.result.raw_files.end());
  }
  for (const auto& [file, run] : report.runs) files.insert(file);
  return files;
}

std::string element(const std::string& id, const std::string& type, const std::string& content) {
  return "<script type=\"" + type + "\" id=\"" + id + "\">" + content + "</script>\n";
}

}  // namespace

std::optional<std::string> page_template(const std::filesystem::path& share) {
  const auto file = share / "page.html";
  if (!std::filesystem::exists(file)) return std::nullopt;
  return io::read_whole_file(file).bytes;
}

std::string fill_page(const std::string& page, const Report& report, const std::filesystem::path& folder) {
  const auto at = page.find(place_of_data);
  if (at == std::string::npos) throw std::logic_error("the page has no place for the data");
  const std::string raw = contents_of(raw_files(report), folder).dump(-1, ' ', false, Json::error_handler_t::replace);
  const std::string json = "application/json";
  return page.substr(0, at) + element("ccdt-report", json, inside_script(report_json(report))) +
         element("ccdt-meshes", json, inside_script(contents_of(mesh_files(report), folder))) +
         element("ccdt-files", "text/plain", packed(raw.data(), raw.size())) + page.substr(at + place_of_data.size());
}

}  // namespace ccdt
