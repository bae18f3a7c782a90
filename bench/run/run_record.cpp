#include "bench/run/run_record.h"

#include <algorithm>
#include <tuple>

#include "bench/run/json_fields.h"

namespace ccdt::bench {

template <>
inline constexpr auto fields<Histogram> = std::tuple(field("edges", &Histogram::edges),
                                                     field("counts", &Histogram::counts));

template <>
inline constexpr auto fields<Quality::Measure> = std::tuple(field("min", &Quality::Measure::min),
                                                            field("mean", &Quality::Measure::mean),
                                                            field("median", &Quality::Measure::median),
                                                            field("p99", &Quality::Measure::p99),
                                                            field("max", &Quality::Measure::max),
                                                            field("histogram", &Quality::Measure::histogram));

template <>
inline constexpr auto fields<Quality::Dihedral> = std::tuple(field("min", &Quality::Dihedral::min),
                                                             field("max", &Quality::Dihedral::max),
                                                             field("histogram", &Quality::Dihedral::histogram));

template <>
inline constexpr auto fields<Quality> = std::tuple(field("r", &Quality::r),
                                                   field("dihedral_degrees", &Quality::dihedral_degrees),
                                                   optional_field("aspect_ratio", &Quality::aspect_ratio),
                                                   optional_field("radius_edge_ratio", &Quality::radius_edge_ratio));

template <>
inline constexpr auto fields<ImproveCounts> = std::tuple(
    field("bad_cells", &ImproveCounts::bad_cells), field("bad_cells_left", &ImproveCounts::bad_cells_left),
    field("removed_edges", &ImproveCounts::removed_edges), field("facet_flips", &ImproveCounts::facet_flips),
    field("removed_faces", &ImproveCounts::removed_faces), field("moved_vertices", &ImproveCounts::moved_vertices),
    field("inserted_vertices", &ImproveCounts::inserted_vertices),
    field("collapsed_edges", &ImproveCounts::collapsed_edges),
    optional_field("reconnected_polyhedra", &ImproveCounts::reconnected_polyhedra),
    optional_field("removed_steiner_vertices", &ImproveCounts::removed_steiner_vertices),
    field("stop", &ImproveCounts::stop));

template <>
inline constexpr auto fields<SegmentCounts> = std::tuple(field("all", &SegmentCounts::all),
                                                         field("grazeable", &SegmentCounts::grazeable),
                                                         field("delaunay", &SegmentCounts::delaunay),
                                                         field("split", &SegmentCounts::split),
                                                         field("pieces", &SegmentCounts::pieces),
                                                         optional_field("restored", &SegmentCounts::restored),
                                                         field("front", &SegmentCounts::front));

template <>
inline constexpr auto fields<MeshCounts> =
    std::tuple(field("vertices", &MeshCounts::vertices), field("steiner_vertices", &MeshCounts::steiner_vertices),
               field("interior_vertices", &MeshCounts::interior_vertices), field("tetrahedra", &MeshCounts::tetrahedra),
               field("faces", &MeshCounts::faces), field("undelaunay_faces", &MeshCounts::undelaunay_faces),
               field("front_tetrahedra", &MeshCounts::front_tetrahedra),
               optional_field("splits_by_level", &MeshCounts::splits_by_level),
               optional_field("dropped_interior_vertices", &MeshCounts::dropped_interior_vertices),
               optional_field("core_tetrahedra", &MeshCounts::core_tetrahedra),
               optional_field("front_faces", &MeshCounts::front_faces),
               optional_field("refined_on_segments", &MeshCounts::refined_on_segments),
               optional_field("refined_in_facets", &MeshCounts::refined_in_facets),
               field_if_any("segments", &MeshCounts::segments), optional_field("improve", &MeshCounts::improve));

template <>
inline constexpr auto fields<RunRecord::MesherName> = std::tuple(field("name", &RunRecord::MesherName::name),
                                                                 field("version", &RunRecord::MesherName::version),
                                                                 field("revision", &RunRecord::MesherName::revision));

template <>
inline constexpr auto fields<RunRecord::Input> =
    std::tuple(field("name", &RunRecord::Input::name), field("sha256", &RunRecord::Input::sha256),
               field("vertices", &RunRecord::Input::vertices), field("facets", &RunRecord::Input::facets),
               field("segments", &RunRecord::Input::segments),
               optional_field("nonplanar_facets", &RunRecord::Input::nonplanar_facets),
               optional_field("largest_deviation", &RunRecord::Input::largest_deviation));

template <>
inline constexpr auto fields<VerifiedMesh::FailedCheck> =
    std::tuple(field("name", &VerifiedMesh::FailedCheck::name), field("checked", &VerifiedMesh::FailedCheck::checked),
               field("failed", &VerifiedMesh::FailedCheck::failed));

template <>
inline constexpr auto fields<RepairedInput> = std::tuple(field("displacement", &RepairedInput::displacement),
                                                         field("area_of_lids", &RepairedInput::area_of_lids),
                                                         field("area_removed", &RepairedInput::area_removed));

template <>
inline constexpr auto fields<surface::SurfaceChange> = std::tuple(
    field("distance", &surface::SurfaceChange::distance), field("distance_to_input", &surface::SurfaceChange::to_input),
    field("distance_from_input", &surface::SurfaceChange::from_input),
    field("farthest", &surface::SurfaceChange::farthest), field("area_change", &surface::SurfaceChange::area_change),
    field_if_any("volume_change", &surface::SurfaceChange::volume_change));

template <>
inline constexpr auto fields<Requirements> = std::tuple(field_if_any("dihedral_degrees",
                                                                     &Requirements::dihedral_degrees),
                                                        field_if_any("r", &Requirements::r),
                                                        field_if_any("deviation", &Requirements::deviation));

template <>
inline constexpr auto fields<MissedRequirement::Spot> = std::tuple(field("at", &MissedRequirement::Spot::at),
                                                                   field("value", &MissedRequirement::Spot::value));

template <>
inline constexpr auto fields<MissedRequirement> = std::tuple(field("name", &MissedRequirement::name),
                                                             field("limit", &MissedRequirement::limit),
                                                             field("count", &MissedRequirement::count),
                                                             field("worst", &MissedRequirement::worst));

template <>
inline constexpr auto fields<VerifiedMesh> = std::tuple(field("right", &VerifiedMesh::right),
                                                        field("checks", &VerifiedMesh::checks),
                                                        field("seconds", &VerifiedMesh::seconds));

namespace {

constexpr auto fields_before_seconds =
    std::tuple(optional_field("command", &RunRecord::command), field("environment", &RunRecord::environment),
               field("counts", &RunRecord::counts));

constexpr auto fields_after_seconds =
    std::tuple(field("peak_rss_bytes", &RunRecord::peak_rss_bytes), field("quality", &RunRecord::quality),
               field(
                   "volume", [](auto& record) -> auto& { return record.quality.volume; }),
               field_if_any("limits_reached", &RunRecord::limits_reached),
               field_if_any("mesh_fingerprint", &RunRecord::mesh_fingerprint),
               field("largest_rounding", &RunRecord::largest_rounding), field("status", &RunRecord::status),
               field_if_any("kind", &RunRecord::kind), field_if_any("reason", &RunRecord::reason),
               field_if_any("stage", &RunRecord::stage), field_if_any("case", &RunRecord::case_id),
               field_if_any("number", &RunRecord::number), field_if_any("verification", &RunRecord::verification),
               field_if_any("repaired", &RunRecord::repaired), field_if_any("surface", &RunRecord::surface_change),
               field_if_any("required", &RunRecord::required), field_if_any("missed", &RunRecord::missed),
               field_if_any("notes", &RunRecord::notes), field_if_any("samples", &RunRecord::samples));

Json options_json(const RunRecord& record) {
  Json options = Json::object();
  for (const auto& [name, option] : record.options)
    std::visit([&, &key = name](const auto& value) { options[key] = value; }, option);
  for (const auto& [name, words] : record.mesher_settings) options["mesher_settings"][name] = words;
  return options;
}

void read_options(const Json& json, RunRecord& record) {
  for (const auto& [name, value] : json.items()) {
    if (name == "mesher_settings")
      for (const auto& [setting, words] : value.items()) record.mesher_settings.emplace_back(setting, words);
    else if (value.is_boolean())
      record.options.emplace_back(name, value.get<bool>());
    else if (value.is_string())
      record.options.emplace_back(name, value.get<std::string>());
    else
      record.options.emplace_back(name, number_from_json(value));
  }
}

/// A number of each stage, by its name; without zeros, which are stages that were left out, if `only_positive`.
template <class Number>
Json stages_json(const StageCosts& costs, Number StageCost::*number, bool only_positive) {
  Json json = Json::object();
  for (const NamedValue<Stage>& stage : names_of(Stage{}))
    if (const Number value = costs[stage.value].*number; !only_positive || value > 0)
      json[std::string(stage.name)] = value;
  return json;
}

template <class Number>
void read_stages(const Json& json, Number StageCost::*number, StageCosts& costs) {
  for (const NamedValue<Stage>& stage : names_of(Stage{}))
    if (json.contains(stage.name)) json.at(std::string(stage.name)).get_to(costs[stage.value].*number);
}

Json seconds_json(const RunRecord& record) {
  Json json = {{"read", record.read_seconds}};
  json.update(stages_json(record.costs, &StageCost::seconds, false));
  json["write"] = record.write_seconds;
  json["mesh"] = record.costs.mesh_seconds;
  return json;
}

void read_seconds(const Json& json, RunRecord& record) {
  json.at("read").get_to(record.read_seconds);
  read_stages(json, &StageCost::seconds, record.costs);
  json.at("write").get_to(record.write_seconds);
  json.at("mesh").get_to(record.costs.mesh_seconds);
}

/// Only counts that are not zero: most counts belong to one stage.
Json work_json(const StageCosts& costs) {
  Json json = Json::object();
  for (const NamedValue<Stage>& stage : names_of(Stage{}))
    for (const WorkCount& c : work_counts)
      if (const std::uint64_t count = costs[stage.value].work.*c.count; count != 0)
        json[std::string(stage.name)][c.name] = count;
  return json;
}

void read_work(const Json& json, StageCosts& costs) {
  for (const NamedValue<Stage>& stage : names_of(Stage{})) {
    const Json counts = json.value(stage.name, Json::object());
    for (const WorkCount& c : work_counts)
      if (counts.contains(c.name)) counts.at(c.name).get_to(costs[stage.value].work.*c.count);
  }
}

Json json_of(const RunRecord& record) {
  Json json = {{"schema", run_document.schema},
               {"mesher", record.mesher},
               {"input", record.input},
               {"options", options_json(record)}};
  write_fields(record, fields_before_seconds, json);
  if (Json work = work_json(record.costs); !work.empty()) json["work"] = std::move(work);
  json["seconds"] = seconds_json(record);
  if (Json cpu_seconds = stages_json(record.costs, &StageCost::cpu_seconds, true); !cpu_seconds.empty())
    json["cpu_seconds"] = std::move(cpu_seconds);
  if (Json threads = stages_json(record.costs, &StageCost::threads, true); !threads.empty())
    json["threads"] = std::move(threads);
  write_fields(record, fields_after_seconds, json);
  return json;
}

RunRecord record_from(const Json& json) {
  RunRecord record;
  json.at("mesher").get_to(record.mesher);
  json.at("input").get_to(record.input);
  read_options(json.at("options"), record);
  read_fields(json, fields_before_seconds, record);
  read_work(json.value("work", Json::object()), record.costs);
  read_seconds(json.at("seconds"), record);
  read_stages(json.value("cpu_seconds", Json::object()), &StageCost::cpu_seconds, record.costs);
  read_stages(json.value("threads", Json::object()), &StageCost::threads, record.costs);
  read_fields(json, fields_after_seconds, record);
  return record;
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

void RunRecord::set_input(const InputPlc& its) {
  input.name = its.name;
  input.vertices = its.vertices.size();
  input.facets = its.facet_count();
  input.segments = its.segments.size();
}

void RunRecord::set_costs(const StageCosts& its) {
  costs = its;
  for (const StageCost& cost : costs.stages)
    for (const WorkCount& limit : limit_counts)
      if (const std::uint64_t count = cost.work.*limit.count; count != 0) limits_reached[limit.name] += count;
}

void RunRecord::set_failure(baselines::FailureKind why, std::string words) {
  kind = why;
  status = baselines::status_of(why);
  reason = std::move(words);
}

std::string option_key(std::string_view name) {
  std::string key(name);
  std::ranges::replace(key, '-', '_');
  return key;
}

RunRecord start_record(const baselines::Mesher& mesher, const InputPlc& input, const MeshOptions& options) {
  RunRecord record;
  record.environment = capture_environment();
  record.mesher = {mesher.name, baselines::version_of(mesher),
                   mesher.name == "ccdt" ? record.environment.revision : ""};
  record.set_input(input);
  MeshOptions own = options;
  for (const options::MeshOption& option : options::mesh_options()) {
    if ((option.name == "sharp-angle" || option.name == "deviation") && !surface::makes_new_surface(options.surface))
      continue;
    record.options.emplace_back(option_key(option.name), recorded_value(option, own));
  }
  record.set_option("threads", static_cast<double>(number_of_threads(options)));
  return record;
}

void note_end(const baselines::ProcessResult& ended, RunRecord& record) {
  // A process that ended by itself may report that its own child process crashed.
  const bool says_it_itself = ended.signal == 0 && record.kind;
  if (ended.kind && !says_it_itself) record.set_failure(*ended.kind, ended.reason);
}

const Json& value_at(const Json& json, std::string_view path) {
  static const Json nothing;
  const std::size_t end = std::min(path.find('.'), path.size());
  const auto found = json.is_object() ? json.find(path.substr(0, end)) : json.end();
  if (found == json.end()) return nothing;
  return end == path.size() ? *found : value_at(*found, path.substr(end + 1));
}

std::string to_json(const RunRecord& record) {
  return to_text(json_of(record));
}

RunRecord run_record_from_json(const std::string& text) {
  return read_document(text, run_document, record_from);
}

void write_run_record(const RunRecord& record, const std::filesystem::path& file) {
  write_json(json_of(record), file);
}

RunRecord read_run_record(const std::filesystem::path& file) {
  return read_document(file, run_document, record_from);
}

std::optional<RunRecord> find_run_record(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::exists(file, error)) return {};
  try {
    return read_run_record(file);
  } catch (const InputError&) {
    return {};
  }
}

}  // namespace ccdt::bench
