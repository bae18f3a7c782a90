#include "bench/run_record.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "bench/json_parts.h"
#include "bench/quality_json.h"
#include "engine/base/errors.h"
#include "engine/io/file_bytes.h"
#include "engine/io/output_file.h"

namespace ccdt {
namespace {

constexpr const char* schema = "ccdt.run/1";

template <class Pairs>
Json object_of(const Pairs& pairs) {
  Json object = Json::object();
  for (const auto& [name, value] : pairs) object[name] = value;
  return object;
}

Json options_json(const RunRecord& record) {
  Json options = Json::object();
  for (const auto& [name, option] : record.options)
    std::visit([&, &key = name](const auto& value) { options[key] = value; }, option);
  if (!record.mesher_settings.empty()) options["mesher_settings"] = object_of(record.mesher_settings);
  return options;
}

Json seconds_json(const RunRecord& r) {
  const StageSeconds& s = r.seconds;
  return {{"read", r.read_seconds},
          {"remesh", r.remesh_seconds},
          {"plc", s.plc},
          {"protect", s.protect},
          {"facets", s.facets},
          {"lattice", s.lattice},
          {"delaunay", s.delaunay},
          {"face_check", s.face_check},
          {"front", s.front},
          {"label", s.label},
          {"finish", s.finish},
          {"improve", s.improve},
          {"write", r.write_seconds},
          {"mesh", s.mesh}};
}

RunRecord::Option option_from(const Json& value) {
  if (value.is_boolean()) return value.get<bool>();
  if (value.is_string()) return value.get<std::string>();
  return number_from_json(value);
}

ImproveCounts improve_counts_from(const Json& j) {
  ImproveCounts c;
  c.bad_cells = j.at("bad_cells");
  c.bad_cells_left = j.at("bad_cells_left");
  c.removed_edges = j.at("removed_edges");
  c.facet_flips = j.at("facet_flips");
  c.removed_faces = j.at("removed_faces");
  c.moved_vertices = j.at("moved_vertices");
  c.inserted_vertices = j.at("inserted_vertices");
  c.collapsed_edges = j.at("collapsed_edges");
  c.stop = value_of<ImproveStop>(j.at("stop").get<std::string>()).value_or(ImproveStop::none);
  return c;
}

MeshCounts counts_from(const Json& j) {
  MeshCounts c;
  c.vertices = j.at("vertices");
  c.steiner_vertices = j.at("steiner_vertices");
  c.interior_vertices = j.at("interior_vertices");
  c.tetrahedra = j.at("tetrahedra");
  c.faces = j.at("faces");
  c.undelaunay_faces = j.at("undelaunay_faces");
  c.front_tetrahedra = j.at("front_tetrahedra");
  c.splits_by_level = j.value("splits_by_level", c.splits_by_level);
  c.dropped_interior_vertices = j.value("dropped_interior_vertices", c.dropped_interior_vertices);
  c.front_faces = j.value("front_faces", c.front_faces);
  if (j.contains("improve")) c.improve = improve_counts_from(j.at("improve"));
  return c;
}

void seconds_from(const Json& j, RunRecord& r) {
  StageSeconds& s = r.seconds;
  r.read_seconds = j.at("read");
  r.remesh_seconds = j.value("remesh", 0.0);
  s.plc = j.at("plc");
  s.protect = j.at("protect");
  s.facets = j.at("facets");
  s.lattice = j.at("lattice");
  s.delaunay = j.at("delaunay");
  s.face_check = j.at("face_check");
  s.front = j.at("front");
  s.label = j.at("label");
  s.finish = j.at("finish");
  s.improve = j.at("improve");
  r.write_seconds = j.at("write");
  s.mesh = j.at("mesh");
}

RunRecord record_from(const Json& j) {
  RunRecord r;
  const Json &mesher = j.at("mesher"), &input = j.at("input");
  r.mesher = {mesher.at("name"), mesher.at("version"), mesher.at("revision")};
  r.input = {input.at("name"), input.at("sha256"), input.at("vertices"), input.at("facets"), input.at("segments")};
  for (const auto& [name, value] : j.at("options").items()) {
    if (name != "mesher_settings") {
      r.options.emplace_back(name, option_from(value));
      continue;
    }
    for (const auto& [setting, words] : value.items()) r.mesher_settings.emplace_back(setting, words);
  }
  r.command = j.value("command", r.command);
  r.environment = environment_from_json(j.at("environment"));
  r.counts = counts_from(j.at("counts"));
  seconds_from(j.at("seconds"), r);
  r.peak_rss_bytes = j.at("peak_rss_bytes");
  r.quality = quality_from_json(j.at("quality"));
  r.quality.volume = j.at("volume");
  r.largest_rounding = j.at("largest_rounding");
  const auto status = j.at("status").get<std::string>();
  if (!value_of<RunStatus>(status)) throw std::invalid_argument("no run has the status '" + status + "'");
  r.status = *value_of<RunStatus>(status);
  r.reason = j.value("reason", "");
  r.notes = j.value("notes", std::vector<std::string>());
  if (j.contains("samples"))
    for (const auto& [name, values] : j.at("samples").items()) r.samples[name] = values.get<std::vector<double>>();
  return r;
}

}  // namespace

void RunRecord::set_option(std::string_view name, const Option& value) {
  const auto found =
      std::ranges::find(options, name, [](const auto& option) { return std::string_view(option.first); });
  if (found != options.end())
    found->second = value;
  else
    options.emplace_back(name, value);
}

RunRecord start_record(const Mesher& mesher, const InputPlc& input, const MeshOptions& options) {
  RunRecord record;
  record.environment = capture_environment();
  record.mesher = {mesher.name, version_of(mesher), mesher.name == "ccdt" ? record.environment.revision : ""};
  record.input.name = input.name;
  record.input.vertices = input.vertices.size();
  record.input.facets = input.facet_count();
  record.input.segments = input.segments.size();
  record.options = {{"face_protection", options.face_protection},
                    {"lattice", std::string(name_of(options.lattice))},
                    {"locator", std::string(name_of(options.locator))},
                    {"delaunay", std::string(name_of(options.delaunay))},
                    {"protection", std::string(name_of(options.protection))},
                    {"improve", std::string(name_of(options.improve.improvement))},
                    {"objective", std::string(name_of(options.improve.objective))},
                    {"target_r", options.improve.target_r},
                    {"target_dihedral", options.improve.target_dihedral},
                    {"boundary", std::string(name_of(options.improve.boundary))},
                    {"improve_time", options.improve.time},
                    {"surface", "keep"},
                    {"edge_length", options.edge_length},
                    {"grading", options.grading},
                    {"grid_scale", options.grid_scale},
                    {"flatness", options.flatness},
                    {"sizes", options.background.name},
                    {"sphere_factor", options.sphere_factor},
                    {"clearance", options.clearance},
                    {"threads", 1.0}};
  return record;
}

std::string to_json(const RunRecord& r) {
  Json json = {{"schema", schema},
               {"mesher", {{"name", r.mesher.name}, {"version", r.mesher.version}, {"revision", r.mesher.revision}}},
               {"input",
                {{"name", r.input.name},
                 {"sha256", r.input.sha256},
                 {"vertices", r.input.vertices},
                 {"facets", r.input.facets},
                 {"segments", r.input.segments}}},
               {"options", options_json(r)},
               {"command", r.command},
               {"environment", environment_json(r.environment)},
               {"counts", counts_json(r.counts)},
               {"seconds", seconds_json(r)},
               {"peak_rss_bytes", r.peak_rss_bytes},
               {"quality", quality_json(r.quality)},
               {"volume", r.quality.volume},
               {"largest_rounding", r.largest_rounding},
               {"status", name_of(r.status)}};
  if (!r.reason.empty()) json["reason"] = r.reason;
  if (!r.notes.empty()) json["notes"] = r.notes;
  if (!r.samples.empty()) json["samples"] = object_of(r.samples);
  return to_text(json);
}

RunRecord run_record_from_json(const std::string& text) {
  try {
    const Json json = Json::parse(text);
    if (json.value("schema", "") != schema)
      throw InputError("not a report of schema ccdt.run/1", {}, "give the JSON that `ccdt mesh --report` wrote");
    return record_from(json);
  } catch (const std::exception& error) {
    if (dynamic_cast<const Error*>(&error) != nullptr) throw;
    throw InputError("not a report of schema ccdt.run/1: " + std::string(error.what()), {},
                     "give the JSON that `ccdt mesh --report` wrote");
  }
}

void write_run_record(const RunRecord& record, const std::filesystem::path& file) {
  io::OutputFile output(file);
  output << to_json(record);
  output.commit();
}

RunRecord read_run_record(const std::filesystem::path& file) {
  try {
    return run_record_from_json(io::read_whole_file(file).bytes);
  } catch (InputError& error) {
    error.place().file = file.string();
    throw;
  }
}

}  // namespace ccdt
