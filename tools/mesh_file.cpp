#include "tools/mesh_file.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "baselines/mesher.h"
#include "baselines/size_field_file.h"
#include "bench/run/fingerprint.h"
#include "bench/run/numbers.h"
#include "bench/run/surface_limit.h"
#include "engine/base/digits.h"
#include "engine/base/errors.h"
#include "engine/base/stopwatch.h"
#include "engine/io/files.h"
#include "engine/io/plc_files.h"
#include "engine/io/read_sizes.h"
#include "engine/io/tet_mesh_files.h"
#include "engine/options/option_table.h"
#include "engine/plc/edge_length_bounds.h"
#include "engine/repair/find_faults.h"
#include "engine/repair/repair_input.h"
#include "engine/steps/reach_count.h"
#include "engine/surface/prepare_surface.h"
#include "engine/surface/surface_change.h"
#include "reports/check_text.h"
#include "tools/options.h"
#include "tools/part_of_result.h"
#include "tools/partition_mesh.h"
#include "tools/streams.h"

namespace ccdt::tools {
namespace {

std::string note_of(const InputPlc::Warped& warped) {
  char deviation[32];
  std::snprintf(deviation, sizeof deviation, "%.3g", warped.largest_deviation);
  return std::to_string(warped.count) + (warped.count == 1 ? " facet is" : " facets are") + " not planar, by up to " +
         deviation + ": triangulated so that they bend least";
}

std::string note_of(const std::map<int, std::string>& names) {
  constexpr std::size_t most = 20;
  std::string note = "names in the file are markers:";
  std::size_t count = 0;
  for (const auto& [marker, name] : names) {
    if (count++ == most) return note + " and " + bench::with_separators(names.size() - most) + " more";
    note += " " + std::to_string(marker) + " is '" + name + "'" + (count < names.size() ? "," : "");
  }
  return note;
}

/// Another mesher leaves out what only ccdt can do. Its user should know.
std::vector<std::string> notes_on_unused_options(const MeshCommand& command) {
  const baselines::Mesher& chosen = baselines::mesher(command.mesher);
  if (chosen.name == "ccdt") return {};
  const bool remesh = surface::makes_new_surface(command.options.surface);
  std::vector<std::string> notes;
  for (const auto& [name, value] : command.given) {
    const options::MeshOption* const option = options::find_mesh_option(name);
    if (option == nullptr || name == "surface" || option->of_any_mesher || baselines::names_a_file(name))
      continue;  // they have messages of their own
    const auto use = std::ranges::find(chosen.options, name, &baselines::OptionUse::name);
    if (use == chosen.options.end()) {
      const bool marks = name == "sharp-angle" && command.markers == surface::MarkerSource::by_angle;
      if (!marks && !(remesh && option->of_remeshing))
        notes.push_back(chosen.name + " does not have the option --" + name + ", so it was not used");
    } else if (use->only_none && value != "none") {
      notes.push_back("--" + name + " was not used: " + chosen.name + " supports only 'none' and its own default");
    }
  }
  return notes;
}

std::string sha256_of_input(const std::string& name) {
  return is_stream(name) ? bench::sha256_of_text(standard_input().bytes) : bench::sha256_of_file(name);
}

void note_input(const MeshCommand& command, const InputPlc& input, bench::RunRecord& record) {
  record.set_input(input);
  record.notes.insert(record.notes.end(), input.notes.begin(), input.notes.end());
  if (!input.marker_names.empty() && command.markers == surface::MarkerSource::file)
    record.notes.push_back(note_of(input.marker_names));
  for (const std::string& note : notes_on_unused_options(command)) record.notes.push_back(note);
}

/// The input without its faults. What was done is noted.
///
/// \throw InputError  a limit forbids the repair
/// \throw LimitError  there is not enough time
InputPlc repaired(const InputPlc& input, double flatness, const Progress& progress, bench::RunRecord& record) {
  if (repair::find_faults(input, flatness, progress).is_valid()) return input;
  repair::Repaired result = repair::repair_input(input, {.flatness = flatness}, progress);
  if (result.is_out_of_time)
    throw LimitError("the input cannot be repaired in time", {.file = input.name},
                     "repair it with `ccdt check --repair --time`, which gives it more");
  if (!result.refused.empty())
    throw InputError(result.refused.front(), {.file = input.name},
                     "repair it with `ccdt check --repair --limit`, and look at the copy");
  const repair::Certificate& certificate = result.certificate;
  record.repaired = {certificate.displacement, certificate.area_of_lids, certificate.area_removed};
  record.notes.push_back("the input was repaired: " + reports::in_few_words(certificate));
  return std::move(result.input);
}

/// Gives markers to the facets, if that was asked for, and notes how many.
void mark(const MeshCommand& command, InputPlc& input, bench::RunRecord& record) {
  if (command.markers == surface::MarkerSource::file) return;
  const Stopwatch watch(record.read_seconds);
  const int count = surface::mark_by_angle(input, command.options.sharp_angle, command.options.flatness);
  record.notes.push_back("the facets got markers by angle, from 1 to " + std::to_string(count));
}

/// Reads the files with sizes that the options name. Numbers on the command line replace those of the file.
void read_size_files(const MeshCommand& command, MeshOptions& options, bench::RunRecord& record) {
  const Stopwatch watch(record.read_seconds);
  if (!options.background.name.empty()) {
    options.background = io::read_sizes(options.background.name);
    check_are_different(options.background.mesh_name, command.output);
  }
  if (options.local.name.empty()) return;
  LocalSizes local = baselines::read_size_field(options.local.name);
  if (command.given.contains("curvature-angle")) local.curvature_angle = options.local.curvature_angle;
  if (command.given.contains("elements-through")) local.elements_through = options.local.elements_through;
  options.local = std::move(local);
}

/// The surface that the mesher gets. What had to be changed is noted: a length that is too long or too short is
/// probably in the wrong unit.
///
/// \param options     get the edge length and the rule that remain for the mesher
/// \throw LimitError  the mesh would have too many vertices; ccdt itself finds that out where only the inside is filled
InputPlc prepared(const MeshCommand& command, InputPlc input, MeshOptions& options, const Progress& progress,
                  bench::RunRecord& record) {
  surface::PreparedSurface surface =
      surface::prepare_surface(input, options.surface, remesh_options_of(options), progress);
  record.read_seconds += surface.costs[Stage::plc].seconds;
  record.costs[Stage::remesh] = surface.costs[Stage::remesh];
  record.input.facets = surface.facets;
  if (surface::makes_new_surface(options.surface))
    record.surface_change = surface::measure_change(input, *surface.changed, options.deviation);
  if (surface.changed) input = *std::move(surface.changed);
  record.input.nonplanar_facets = input.warped.count;
  record.input.largest_deviation = input.warped.largest_deviation;
  if (input.warped.count > 0) record.notes.push_back(note_of(input.warped));
  if (options.edge_length > surface.edge_length)
    record.notes.push_back("--edge-length " + digits(options.edge_length) +
                           " is longer than the whole part: " + bench::rounded(surface.edge_length) +
                           ", the diagonal of its bounding box, was used instead; check the unit");
  options.edge_length = surface.edge_length;
  if (surface::makes_new_surface(options.surface)) {
    record.notes.push_back("the surface was remeshed from " + bench::with_separators(surface.facets) + " to " +
                           bench::with_separators(input.facet_count()) + " facets");
    options.surface = SurfaceRule::keep;
  }
  const bool others_fill = command.mesher != "ccdt" && options.lattice != Lattice::none;
  if (others_fill && options.edge_length > 0) plc::check_edges_of_surface(input, options.edge_length);
  return input;
}

std::string words_of(const bench::SurfaceLimit& limit) {
  return "the surface limits quality: " + bench::with_separators(limit.at_bad_triangles) + " of " +
         bench::with_separators(limit.bad_tetrahedra) + " tetrahedra with r above " +
         bench::rounded(bench::SurfaceLimit::bad_r) + " touch surface triangles with an angle below " +
         bench::rounded(bench::SurfaceLimit::bad_angle) + " degrees (smallest: " + bench::rounded(limit.least_angle) +
         "); --surface refine puts even triangles on flat facets, --surface auto on curved surfaces, too";
}

/// Writes the record that remains if the mesher or a limit ends this process: which mesher was asked for what.
void leave_provisional_record(const MeshCommand& command, const bench::RunRecord& record, LastRecord& last) {
  last.set(record);
  if (command.report.empty() || is_stream(command.report)) return;
  bench::RunRecord unfinished = record;
  unfinished.set_failure(baselines::FailureKind::crashed, "the process ended before the run was finished");
  bench::write_run_record(unfinished, command.report);
}

/// Adds the result of a mesher, and measures of its mesh.
void record_result(const MeshCommand& command, const MeshOptions& options, const baselines::MesherRun& run,
                   bench::RunRecord& record) {
  const MeshResult& result = run.result;
  record.counts = result.counts;
  StageCosts costs = result.costs;
  costs[Stage::remesh] = record.costs[Stage::remesh];
  record.set_costs(costs);
  record.largest_rounding = result.largest_rounding;
  record.mesher_settings = run.settings;
  record.notes.insert(record.notes.end(), run.notes.begin(), run.notes.end());
  if (record.mesher.name != "ccdt" && !surface::makes_new_surface(command.options.surface))
    for (const std::string& file : {options.background.name, options.local.name})
      if (!file.empty()) record.notes.push_back("only ccdt uses size functions: " + file + " was not used");
  record.quality = bench::measure_quality(result.mesh);
  if (command.options.surface == SurfaceRule::keep && improvement_of(options) != Improvement::none &&
      record.quality.r.max > bench::SurfaceLimit::bad_r)
    if (const bench::SurfaceLimit limit = bench::find_surface_limit(result.mesh); limit.limits_quality())
      record.notes.push_back(words_of(limit));
  if (result.idle_holes > 0)
    record.notes.push_back("hole points that are outside of everything that the facets enclose were not used: " +
                           bench::with_separators(result.idle_holes));
  record.mesh_fingerprint = bench::fingerprint(result.mesh);
  record.required = command.required;
  record.missed = bench::find_missed(command.required, result.mesh, record.surface_change);
  if (record.missed.empty()) return;
  std::vector<std::string> words;
  for (const bench::MissedRequirement& missed : record.missed)
    words.push_back(words_of(missed, record.counts.tetrahedra));
  record.set_failure(baselines::FailureKind::missed, bench::joined(words, "; "));
}

void partition(const MeshCommand& command, TetMesh& mesh, bench::RunRecord& record) {
  if (command.partitions == 0) return;
  const PartitionSizes sizes =
      with_file_in_errors(command.input, [&] { return partition_mesh(command.partitions, mesh); });
  record.notes.push_back("partitions have from " + bench::with_separators(sizes.least) + " to " +
                         bench::with_separators(sizes.most) + " tetrahedra, with " +
                         bench::with_separators(sizes.cut_faces) + " faces between them");
}

/// Runs a mesher. If it refuses the input, the error also names the verb that lists everything that is wrong with it.
template <class Run>
auto with_advice_on_input(const std::string& file, const Run& run) {
  try {
    return run();
  } catch (const InputError& error) {
    if (error.place().file != file) throw;
    const std::string advice = "\n  ccdt check " + file + " lists everything that is wrong with it, and can repair it";
    throw InputError(error.what(), error.place(), error.remedy() + advice);
  }
}

/// What a mesher got, and its mesh.
struct Meshed {
  InputPlc surface;  ///< the input, until it is prepared
  MeshOptions options;
  baselines::MesherRun run;
};

/// Prepares the surface and meshes it.
///
/// \param factor  of all edge lengths; already in the options
void mesh_prepared(const MeshCommand& command, double factor, Meshed& meshed, bench::RunRecord& record,
                   LastRecord& last, const Progress& progress) {
  const baselines::Mesher& chosen = baselines::mesher(command.mesher);
  meshed.options.tetrahedra = 0;
  meshed.surface = prepared(command, std::move(meshed.surface), meshed.options, progress, record);
  if (command.options.tetrahedra > 0)
    record.notes.push_back("all edge lengths were scaled by " + bench::rounded(factor) +
                           " for the wanted number of tetrahedra; the seconds are those of that mesh alone");
  record.mesher_settings = baselines::settings_of(chosen, meshed.surface, meshed.options);
  leave_provisional_record(command, record, last);
  meshed.run =
      with_advice_on_input(command.input, [&] { return chosen.run(meshed.surface, meshed.options, progress); });
  check_count(meshed.run.result.mesh.tetrahedra.size(), meshed.options.most_tetrahedra);
}

}  // namespace

bench::RunRecord begin_record(const MeshCommand& command) {
  InputPlc unread;
  unread.name = name_of_input(command.input);
  bench::RunRecord record = bench::start_record(baselines::mesher(command.mesher), unread, command.options);
  if (command.mesher != "ccdt") record.set_option("threads", 1.0);
  record.command = bench::command_line();
  return record;
}

void mesh_file(const MeshCommand& command, bench::RunRecord& record, LastRecord& last, const Progress& progress) {
  report(progress, "read", 0, 0);
  InputPlc input = [&] {
    const Stopwatch watch(record.read_seconds);
    return read_plc(command.input, command.input_format);
  }();
  note_input(command, input, record);
  if (!command.report.empty()) record.input.sha256 = sha256_of_input(command.input);
  MeshOptions options = command.options;
  if (command.repair) input = repaired(input, options.flatness, progress, record);
  mark(command, input, record);
  read_size_files(command, options, record);
  last.set(record);

  const bool is_counted = options.tetrahedra > 0;
  const bench::RunRecord begun = record;
  const auto mesh_with = [&](double factor) {
    record = begun;
    Meshed meshed{is_counted ? input : std::move(input), steps::scaled(options, factor), {}};
    mesh_prepared(command, factor, meshed, record, last, progress);
    return meshed;
  };
  Meshed meshed = is_counted ? steps::reach_count(
                                   options.tetrahedra, mesh_with,
                                   [](const Meshed& m) { return m.run.result.mesh.tetrahedra.size(); }, command.input)
                             : mesh_with(1);
  record.peak_rss_bytes = bench::peak_rss_bytes();  // the mesher's own, without that of the measurements below
  record_result(command, meshed.options, meshed.run, record);

  report(progress, "write", 0, 0);
  const Stopwatch watch(record.write_seconds);
  partition(command, meshed.run.result.mesh, record);
  if (!command.surface_output.empty()) io::write_plc(meshed.surface, command.surface_output);
  PartOfResult surface(command.surface_output);
  write_output(command.output, command.format, [&](const std::filesystem::path& file) {
    io::write_tet_mesh(meshed.run.result.mesh, file, command.format, command.order);
  });
  surface.keep();
}

}  // namespace ccdt::tools
