#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>
#include <utility>

#include "baselines/parse_json.h"
#include "baselines/process.h"
#include "bench/gate/baseline.h"
#include "bench/gate/foreign_json.h"
#include "bench/gate/recording.h"
#include "bench/run/environment.h"
#include "bench/run/json.h"
#include "bench/run/json_fields.h"
#include "bench/run/numbers.h"
#include "bench/run/run_record.h"
#include "bench/sweep/sweep_document.h"
#include "engine/base/digits.h"
#include "engine/io/files.h"

namespace ccdt::gate {
namespace {

using bench::Json;

constexpr const char* what_can_be_read =
    "give the folder of a sweep, reports of `ccdt mesh --report`, the JSON of Google Benchmark or of hyperfine, or a "
    "baseline";

/// A report of `ccdt mesh` as read from its file.
struct RunFile {
  std::filesystem::path file;
  Json json;
};

Json parse(const std::filesystem::path& file) {
  io::FileBytes json = io::read_whole_file(file);
  json.bytes = valid_json_of(json.bytes);  // errors count its bytes, and one more at its end
  try {
    return baselines::parse_json(json.bytes);
  } catch (const Json::parse_error& error) {
    throw InputError("a recording is JSON, and this is not",
                     io::line_of_byte(json, std::min(error.byte, json.bytes.size())), what_can_be_read);
  } catch (const Json::exception& error) {
    throw InputError(std::string("a recording is JSON, and this cannot be read as such: ") + error.what(),
                     io::place_in(file.string()), what_can_be_read);
  }
}

bool is_run(const Json& json) {
  return json.is_object() && bench::value_at(json, "schema") == bench::run_document.schema;
}

std::invalid_argument too_many(const std::string& what, std::size_t most) {
  return std::invalid_argument("there are more than " + bench::with_separators(most) + " " + what);
}

/// Our figures have no longer names. With many members, longer names would take far more memory than the file.
constexpr std::size_t longest_name = 500;

/// Adds the numbers of a part of the report by their paths. Texts and lists other than histograms are only compared as
/// a whole. Infinite values are null.
void add_figures(const std::string& name, const Json& json, std::vector<Figure>& figures) {
  if (name.size() > longest_name)
    throw std::invalid_argument("the name of a figure is longer than " + std::to_string(longest_name) + " letters");
  const Layer layer = name.starts_with("seconds") ? Layer::time : Layer::exact;
  if (json.is_object()) {
    for (const auto& [member, value] : json.items())
      if (member != "histogram") add_figures(std::string(name).append(".").append(member), value, figures);
  } else if (json.is_number() || json.is_null()) {
    figures.push_back({name, layer, {bench::number_from_json(json)}});
  } else {
    figures.push_back({name, layer, {}, json.is_string() ? json.get<std::string>() : json.dump()});
  }
}

/// A run that failed has no mesh to measure.
std::vector<Figure> figures_of(const Json& run) {
  std::vector<Figure> figures;
  for (const char* text : {"status", "kind"})
    if (run.contains(text)) add_figures(text, run[text], figures);
  if (run.value("status", "") != "ok") return figures;
  for (const char* part : {"mesh_fingerprint", "counts", "work", "quality", "volume", "seconds"})
    if (run.contains(part)) add_figures(part, run[part], figures);
  return figures;
}

/// The recorded command, if it can be repeated.
std::string command_of(const RunFile& run) {
  if (!run.json.contains("command")) return "";
  const auto words = run.json["command"].get<std::vector<std::string>>();
  if (words.empty()) return "";
  auto folder = std::filesystem::absolute(run.file).lexically_normal().parent_path();
  if (!run.json.contains("case")) return baselines::command_line(words);
  if (folder.filename() == "runs") folder = folder.parent_path();
  return "cd " + baselines::command_line({folder.string()}) + " && " + baselines::command_line(words);
}

/// Adds a run to its case. Times of a warm-up do not count.
void add_run(const RunFile& run, bool is_warm_up, CaseFigures& one) {
  if (one.command.empty()) one.command = command_of(run);
  for (Figure& figure : figures_of(run.json)) {
    if (is_warm_up && figure.layer == Layer::time) continue;
    const std::size_t before = one.figures.size();
    Figure& known = figure_named(figure.name, figure.layer, one);
    known.samples.insert(known.samples.end(), figure.samples.begin(), figure.samples.end());
    if (one.figures.size() > before)
      known.text = std::move(figure.text);
    else if (figure.text != known.text && !known.text.ends_with(" or " + figure.text))
      known.text += " or " + figure.text;  // which is not equal to any other text
  }
}

void add_identity(const Json& run, bench::Identity& identity) {
  const Json& environment = run.at("environment");
  identity["machine.cpu"] = environment.value("cpu", "");
  for (const char* field : {"compiler", "flags", "revision"}) identity[field] = environment.value(field, "");
}

/// The options of a report that are not defaults of its mesher, so that equal cases have equal names in all recordings:
/// "part.off, ccdt, lattice bcc". They are in this program's order, since other versions may write another order.
std::string name_of_case(const Json& run, const std::string& input) {
  static const bench::RunRecord usual = bench::start_record(baselines::mesher("ccdt"), {}, {});
  std::vector<std::string> parts = {input, run.at("mesher").at("name").get<std::string>()};
  const auto add = [&](const std::string& name, const Json& value) {
    parts.push_back(name + " " + (value.is_string() ? value.get<std::string>() : value.dump()));
  };
  Json others = run.at("options");
  for (const auto& [name, usual_value] : usual.options) {
    const Json value = others.value(name, Json());
    others.erase(name);
    if (!value.is_null() && value != std::visit([](const auto& v) { return Json(v); }, usual_value)) add(name, value);
  }
  for (const auto& [name, value] : others.items())
    if (!value.is_structured()) add(name, value);
  return bench::joined(parts);
}

/// The names of the inputs. They include folders only where different inputs have the same file name.
std::vector<std::string> input_names(const std::vector<RunFile>& runs) {
  std::map<std::string, std::set<std::string>> hashes;
  const auto bare = [](const RunFile& run) {
    return std::filesystem::path(run.json.at("input").at("name").get<std::string>()).filename().string();
  };
  for (const RunFile& run : runs) hashes[bare(run)].insert(run.json.at("input").value("sha256", ""));
  std::vector<std::string> names;
  for (const RunFile& run : runs)
    names.push_back(hashes[bare(run)].size() == 1 ? bare(run) : run.json.at("input").at("name").get<std::string>());
  return names;
}

void add_runs(const std::vector<RunFile>& runs, Recording& recording) {
  const std::vector<std::string> inputs = input_names(runs);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    add_run(runs[i], false, case_named(name_of_case(runs[i].json, inputs[i]), recording));
    add_identity(runs[i].json, recording.identity);
  }
}

/// Calls `read` with the contents of a file.
/// \throw InputError  a name is missing or has the wrong type
template <class Read>
void read_from(const std::filesystem::path& file, const Read& read) {
  try {
    read();
  } catch (const Json::exception& error) {
    throw InputError(std::string("not what its schema says: ") + error.what(), io::place_in(file.string()),
                     what_can_be_read);
  } catch (const std::invalid_argument& error) {
    throw InputError(std::string("not what its schema says: ") + error.what(), io::place_in(file.string()),
                     what_can_be_read);
  }
}

Recording read_sweep(const std::filesystem::path& folder) {
  Recording recording{folder};
  const sweep::SweepDocument document = sweep::read_sweep(folder);
  for (const sweep::SweepCase& one : document.cases) {
    CaseFigures figures{one.asked.name, {}, {}};
    for (int number = 0;; ++number) {
      const auto file = folder / bench::run_file(one.id, number);
      if (!std::filesystem::exists(file)) break;
      const RunFile run = {file, parse(file)};
      read_from(file, [&] {
        add_run(run, number < one.asked.repetitions.warm_up, figures);
        add_identity(run.json, recording.identity);
      });
    }
    if (!figures.figures.empty())
      read_from(folder, [&] { add_case(std::move(figures), recording); });
    else
      recording.notes.push_back(one.asked.name + " was not run in " + folder.string());
  }
  return recording;
}

/// \return  is it a known kind of file?
bool add_file(const std::filesystem::path& file, Json json, std::vector<RunFile>& runs, Recording& recording) {
  if (is_run(json)) {
    runs.push_back({file, std::move(json)});
  } else if (is_google_benchmark(json)) {
    recording.kind = Source::google_benchmark;
    read_from(file, [&] { add_google_benchmark(json, recording); });
  } else if (is_hyperfine(json)) {
    recording.kind = Source::hyperfine;
    read_from(file, [&] { add_hyperfine(json, recording); });
  } else {
    return false;
  }
  return true;
}

Recording read_folder(const std::filesystem::path& folder) {
  Recording recording{folder};
  std::vector<std::filesystem::path> files;
  for (const auto& place : {folder, folder / "runs"})
    if (std::filesystem::is_directory(place))
      for (const auto& entry : std::filesystem::directory_iterator(place))
        if (entry.is_regular_file() && entry.path().extension() == ".json") files.push_back(entry.path());
  std::ranges::sort(files);
  std::vector<RunFile> runs;
  for (const auto& file : files) add_file(file, parse(file), runs, recording);
  if (!runs.empty()) read_from(folder, [&] { add_runs(runs, recording); });
  return recording;
}

Recording read_file(const std::filesystem::path& file) {
  Json json = parse(file);
  if (is_baseline(json)) return read_baseline(file).recording;
  Recording recording{file};
  std::vector<RunFile> runs;
  if (!add_file(file, std::move(json), runs, recording))
    throw InputError("this is not a recording", io::place_in(file.string()), what_can_be_read);
  if (!runs.empty()) read_from(file, [&] { add_runs(runs, recording); });
  return recording;
}

}  // namespace

const Figure* find_figure(const CaseFigures& one, const std::string& name) {
  const auto found = std::ranges::find(one.figures, name, &Figure::name);
  return found == one.figures.end() ? nullptr : &*found;
}

const CaseFigures* find_case(const Recording& recording, const std::string& name) {
  const auto found = std::ranges::find(recording.cases, name, &CaseFigures::name);
  return found == recording.cases.end() ? nullptr : &*found;
}

CaseFigures& case_named(const std::string& name, Recording& recording) {
  const auto known = std::ranges::find(recording.cases, name, &CaseFigures::name);
  if (known != recording.cases.end()) return *known;
  return add_case({name, {}, {}}, recording);
}

CaseFigures& add_case(CaseFigures one, Recording& recording) {
  if (recording.cases.size() == most_cases) throw too_many("cases", most_cases);
  if (one.figures.size() > most_figures) throw too_many("figures", most_figures);
  return recording.cases.emplace_back(std::move(one));
}

Figure& figure_named(const std::string& name, Layer layer, CaseFigures& one) {
  const auto known = std::ranges::find(one.figures, name, &Figure::name);
  if (known != one.figures.end()) return *known;
  if (one.figures.size() == most_figures) throw too_many("figures", most_figures);
  one.figures.push_back({name, layer, {}});
  return one.figures.back();
}

Recording read_recording(const std::filesystem::path& path) {
  Recording recording;
  const bool is_folder = std::filesystem::is_directory(path);
  if (is_folder) io::check_links_stay_within(path);
  if (!is_folder)
    recording = read_file(path);
  else if (std::filesystem::exists(sweep::sweep_file(path)))
    recording = read_sweep(path);
  else
    recording = read_folder(path);
  if (recording.cases.empty() && recording.kind != Source::baseline)
    throw InputError("it contains no runs", io::place_in(path.string()), what_can_be_read);
  return recording;
}

}  // namespace ccdt::gate
