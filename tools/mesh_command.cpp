#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "baselines/mesher.h"
#include "baselines/mesher_options.h"
#include "baselines/option_table.h"
#include "baselines/size_field_file.h"
#include "baselines/stop.h"
#include "bench/run/fingerprint.h"
#include "bench/run/numbers.h"
#include "bench/run/requirements.h"
#include "bench/run/run_record.h"
#include "bench/run/surface_limit.h"
#include "engine/base/digits.h"
#include "engine/base/errors.h"
#include "engine/base/stopwatch.h"
#include "engine/io/files.h"
#include "engine/io/plc_files.h"
#include "engine/io/read_sizes.h"
#include "engine/io/tet_mesh_files.h"
#include "engine/plc/edge_length_bounds.h"
#include "engine/repair/find_faults.h"
#include "engine/repair/repair_input.h"
#include "engine/steps/reach_count.h"
#include "engine/surface/prepare_surface.h"
#include "engine/surface/surface_change.h"
#include "reports/check_text.h"
#include "reports/result_text.h"
#include "tools/commands.h"
#include "tools/freed_memory.h"
#include "tools/limit_errors.h"
#include "tools/options.h"
#include "tools/part_of_result.h"
#include "tools/progress_bar.h"
#include "tools/sweep_command.h"
#include "tools/terminal.h"

namespace ccdt::tools {
namespace {

struct MeshCommand {
  std::string input, output, report;
  std::string format;          ///< of the output; empty: that of its extension
  int order = 1;               ///< of the elements in the output
  std::string surface_output;  ///< file for the remeshed or repaired surface
  bool repair = false;         ///< before meshing
  std::string mesher = "ccdt";
  MeshOptions options;
  bench::Requirements required;
  baselines::Strategies strategies = baselines::Strategies::usual;
  baselines::NamedOptions given;  ///< the options on the command line
};

void check_surface_options(const MeshCommand& command) {
  const bool remesh = command.options.surface == SurfaceRule::remesh;
  const bool has_sizes =
      !command.options.background.name.empty() || !command.options.local.name.empty() || !command.options.local.empty();
  if (remesh && command.options.edge_length == 0 && !has_sizes)
    throw CLI::ValidationError("--surface remesh", "give the length of its edges with --edge-length");
  if (command.options.tetrahedra > 0 && command.options.edge_length == 0 && command.mesher != "ccdt")
    throw CLI::ValidationError("--tetrahedra", "give an edge length to begin with, by --edge-length");
  if (!remesh && !command.repair && !command.surface_output.empty())
    throw CLI::ValidationError("--surface-output", "there is no new surface without --surface remesh or --repair");
  if (!remesh && command.required.deviation)
    throw CLI::ValidationError("--deviation", "only --surface remesh makes a surface that deviates from the input's");
  if (command.options.surface == SurfaceRule::refine && command.mesher != "ccdt")
    throw CLI::ValidationError("--surface refine",
                               "only ccdt refines a surface; use --surface remesh for other meshers");
}

/// File formats that keep the vertices of a surface exactly, so that its mesh can be verified against it.
constexpr const char* surface_endings = ".off .obj .ply .poly";

void check_surface_output(const std::filesystem::path& file) {
  if (io::lower_ending(file) == ".stl")
    throw OutputError("STL would round the vertices of the new surface to single precision",
                      io::place_in(file.string()), std::string("use one of ") + surface_endings);
  if (!io::is_plc_file(file))
    throw OutputError("unknown file extension '" + file.extension().string() + "'", io::place_in(file.string()),
                      std::string("use one of ") + surface_endings);
  check_can_be_written(file);
}

void check_files(const MeshCommand& command) {
  io::check_tet_mesh_output(command.output, command.format, command.order);
  check_folder_can_be_written(command.output);
  const MeshOptions& options = command.options;
  std::vector<std::string> others = {command.input, options.background.name, options.local.name};
  for (const std::string& other : others) check_are_different(other, command.output);
  others.push_back(command.output);
  if (!command.surface_output.empty()) {
    check_surface_output(command.surface_output);
    for (const std::string& other : others) check_are_different(other, command.surface_output);
  }
  if (command.report.empty()) return;
  check_can_be_written(command.report);
  for (const std::string& other : others) check_are_different(other, command.report);
}

std::string note_of(const InputPlc::Warped& warped) {
  char deviation[32];
  std::snprintf(deviation, sizeof deviation, "%.3g", warped.largest_deviation);
  return std::to_string(warped.count) + (warped.count == 1 ? " facet is" : " facets are") + " not planar, by up to " +
         deviation + ": triangulated so that they bend least";
}

/// Another mesher leaves out what only ccdt can do. Its user should know.
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

std::vector<std::string> notes_on_unused_options(const MeshCommand& command) {
  const baselines::Mesher& chosen = baselines::mesher(command.mesher);
  if (chosen.name == "ccdt") return {};
  const bool remesh = command.options.surface == SurfaceRule::remesh;
  std::vector<std::string> notes;
  for (const auto& [name, value] : command.given) {
    const baselines::MeshOption* const option = baselines::find_mesh_option(name);
    if (option == nullptr || name == "surface" || option->of_any_mesher || baselines::names_a_file(name))
      continue;  // they have messages of their own
    const auto use = std::ranges::find(chosen.options, name, &baselines::OptionUse::name);
    if (use == chosen.options.end()) {
      if (!(remesh && option->of_remeshing))
        notes.push_back(chosen.name + " does not have the option --" + name + ", so it was not used");
    } else if (use->only_none && value != "none") {
      notes.push_back("--" + name + " was not used: " + chosen.name + " supports only 'none' and its own default");
    }
  }
  return notes;
}

bench::RunRecord begin_record(const MeshCommand& command, const InputPlc& input) {
  bench::RunRecord record = bench::start_record(baselines::mesher(command.mesher), input, command.options);
  if (command.mesher != "ccdt") record.set_option("threads", 1.0);
  record.command = bench::command_line();
  record.notes.insert(record.notes.end(), input.notes.begin(), input.notes.end());
  if (!input.marker_names.empty()) record.notes.push_back(note_of(input.marker_names));
  for (const std::string& note : notes_on_unused_options(command)) record.notes.push_back(note);
  return record;
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
      surface::prepare_surface(input, options.surface,
                               {options.edge_length, options.sharp_angle, options.flatness, &options.local,
                                &options.background, options.most_tetrahedra, options.surface_factor},
                               progress);
  record.read_seconds += surface.costs[Stage::plc].seconds;
  record.costs[Stage::remesh] = surface.costs[Stage::remesh];
  record.input.facets = surface.facets;
  if (options.surface == SurfaceRule::remesh) record.surface_change = surface::measure_change(input, *surface.changed);
  if (surface.changed) input = *std::move(surface.changed);
  record.input.nonplanar_facets = input.warped.count;
  record.input.largest_deviation = input.warped.largest_deviation;
  if (input.warped.count > 0) record.notes.push_back(note_of(input.warped));
  if (options.edge_length > surface.edge_length)
    record.notes.push_back("--edge-length " + digits(options.edge_length) +
                           " is longer than the whole part: " + bench::rounded(surface.edge_length) +
                           ", the diagonal of its bounding box, was used instead; check the unit");
  options.edge_length = surface.edge_length;
  if (options.surface == SurfaceRule::remesh) {
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
         "); --surface refine puts even triangles on flat facets, --surface remesh on curved surfaces, too";
}

/// Writes the record that remains if the mesher or a limit ends this process: which mesher was asked for what.
void leave_provisional_record(const MeshCommand& command, const bench::RunRecord& record) {
  if (command.report.empty()) return;
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
  if (record.mesher.name != "ccdt" && command.options.surface != SurfaceRule::remesh)
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
                   const Progress& progress) {
  const baselines::Mesher& chosen = baselines::mesher(command.mesher);
  meshed.options.tetrahedra = 0;
  meshed.surface = prepared(command, std::move(meshed.surface), meshed.options, progress, record);
  if (command.options.tetrahedra > 0)
    record.notes.push_back("all edge lengths were scaled by " + bench::rounded(factor) +
                           " for the wanted number of tetrahedra; the seconds are those of that mesh alone");
  record.mesher_settings = baselines::settings_of(chosen, meshed.surface, meshed.options);
  leave_provisional_record(command, record);
  meshed.run =
      with_advice_on_input(command.input, [&] { return chosen.run(meshed.surface, meshed.options, progress); });
  check_count(meshed.run.result.mesh.tetrahedra.size(), meshed.options.most_tetrahedra);
}

/// Reads, meshes, measures and writes. At every moment, the record contains what is known of the run.
void mesh_file(const MeshCommand& command, bench::RunRecord& record, const Progress& progress) {
  report(progress, "read", 0, 0);
  double read_seconds = 0;
  InputPlc input = [&] {
    const Stopwatch watch(read_seconds);
    return io::read_plc(command.input);
  }();
  record = begin_record(command, input);
  record.read_seconds = read_seconds;
  if (!command.report.empty()) record.input.sha256 = bench::sha256_of_file(command.input);
  MeshOptions options = command.options;
  if (command.repair) input = repaired(input, options.flatness, progress, record);
  read_size_files(command, options, record);

  const bool is_counted = options.tetrahedra > 0;
  const bench::RunRecord begun = record;
  const auto mesh_with = [&](double factor) {
    record = begun;
    Meshed meshed{is_counted ? input : std::move(input), steps::scaled(options, factor), {}};
    mesh_prepared(command, factor, meshed, record, progress);
    return meshed;
  };
  const Meshed meshed = is_counted
                            ? steps::reach_count(
                                  options.tetrahedra, mesh_with,
                                  [](const Meshed& m) { return m.run.result.mesh.tetrahedra.size(); }, command.input)
                            : mesh_with(1);
  record.peak_rss_bytes = bench::peak_rss_bytes();  // the mesher's own, without that of the measurements below
  record_result(command, meshed.options, meshed.run, record);

  report(progress, "write", 0, 0);
  const Stopwatch watch(record.write_seconds);
  if (!command.surface_output.empty()) io::write_plc(meshed.surface, command.surface_output);
  PartOfResult surface(command.surface_output);
  io::write_tet_mesh(meshed.run.result.mesh, command.output, command.format, command.order);
  surface.keep();
}

void record_failure(const MeshCommand& command, bench::RunRecord& record, const std::exception& error) {
  if (record.mesher.name.empty()) {  // the input could not even be read
    InputPlc unread;
    unread.name = command.input;
    record = begin_record(command, unread);
  }
  record.set_failure(baselines::failure_kind_of(error), error.what());
}

/// Is the part so small that starting more threads takes longer than they save? Not if it gets many new vertices. On
/// two cores, threads pay from about 4,000 triangles on.
bool is_small(const MeshCommand& command) {
  constexpr std::uintmax_t small_file = 100'000;  // bytes
  std::error_code unreadable;                     // is reported where the file is read
  return command.options.lattice == Lattice::none && command.options.surface == SurfaceRule::keep &&
         std::filesystem::file_size(command.input, unreadable) <= small_file && !unreadable;
}

/// \return  does the mesh keep what was required?
bool run(MeshCommand command) {
  if (command.mesher == "ccdt") keep_freed_memory();
  check_surface_options(command);
  check_files(command);
  if (command.options.threads == 0 && is_small(command)) command.options.threads = 1;
  bench::RunRecord record;
  try {
    with_progress(command.input, command.options.threads,
                  [&](const Progress& progress) { mesh_file(command, record, progress); });
  } catch (const baselines::Stopped&) {
    throw;  // the report stays as it was left for this end
  } catch (const std::exception& error) {
    record_failure(command, record, error);
    if (!command.report.empty()) bench::write_run_record(record, command.report);
    throw;
  }
  if (!command.report.empty()) bench::write_run_record(record, command.report);
  print(reports::summarize(record));
  print(command.output, record.missed.empty() ? Tone::good : Tone::bad);
  print(": " + reports::in_one_line(record) + "\n");
  return record.missed.empty();
}

std::string meshers_of_build() {
  std::string text = "Meshers of this build:\n";
  for (const baselines::Mesher& m : baselines::meshers())
    text += list_line(m.name, m.what + " (" + (m.version.empty() ? "" : m.version + ", ") + m.license + ")");
  return text +
         list_line("FILE.json", "any other mesher, as the file describes it; see the examples in baselines/described");
}

constexpr const char* mesh_footer =
    "Example: fill a part with edges of about 2 mm, and write a report of the run\n"
    "  ccdt mesh part.stl -o part.vtu --edge-length 2 --report part.json\n"
    "Example: take edge lengths from the size function part.sol, which is defined on the mesh part.mesh\n"
    "  ccdt mesh part.stl -o part.vtu --sizes part.sol\n"
    "Example: remesh the surface to the same edge length, and keep it for `ccdt verify`\n"
    "  ccdt mesh part.stl -o part.vtu --edge-length 2 --surface remesh --surface-output even.off\n"
    "Example: keep flat facets and straight segments, but give them new vertices and even triangles\n"
    "  ccdt mesh part.stl -o part.vtu --edge-length 2 --surface refine\n"
    "Example: compute the constrained Delaunay tetrahedralization of the input alone\n"
    "  ccdt mesh part.stl -o part.mesh --lattice none --steiner keep\n";

void add_files(CLI::App& verb, MeshCommand& command) {
  verb.add_option("INPUT", command.input, std::string("surface or PLC: ") + read_plc_endings)->required();
  verb.add_option("-o,--output", command.output, "mesh: .vtu .msh .msh4 .mesh .meshb .inp .xdmf .polymesh .node")
      ->required();
  verb.add_option("--format", command.format,
                  "format of the mesh, if not that of its extension: msh4 is Gmsh 4.1 (binary), msh Gmsh 2.2 (text), "
                  "polymesh a folder of OpenFOAM")
      ->check(CLI::IsMember(io::tet_mesh_formats()));
  verb.add_option("--order", command.order,
                  "2: elements with a node in the middle of each edge, in .msh .msh4 .vtu .inp .xdmf")
      ->check(whole_number(1, 2))
      ->capture_default_str();
  verb.add_option("--surface-output", command.surface_output,
                  std::string("write the remeshed or repaired surface to this file: ") + surface_endings);
  verb.add_option("--report", command.report,
                  "write a report of the run to this file, even if the run fails (JSON, schema ccdt.run/1)");
}

void add_requirements(CLI::App& verb, bench::Requirements& required) {
  constexpr double regular_dihedral = 70.53;  // no tetrahedron has more everywhere
  verb.add_option("--require-dihedral", required.dihedral_degrees,
                  "exit code 1 if a dihedral angle of the mesh is below this, or above 180 degrees less this")
      ->check(number_between(0, regular_dihedral));
  verb.add_option("--require-r", required.r, "exit code 1 if a tetrahedron has an r above this; the regular one has 1")
      ->check(number_between(1, std::numeric_limits<double>::max()));
  verb.add_option(
          "--deviation", required.deviation,
          "exit code 1 if the surface of --surface remesh may be farther than this from the old one, in units of "
          "the input")
      ->check(positive_number());
}

void add_options(CLI::App& verb, MeshCommand& command) {
  add_files(verb, command);
  verb.add_flag("--repair", command.repair, "repair an input that is not valid; `ccdt check` has options for that");
  verb.add_option("--mesher", command.mesher, "mesher: one of those below, or a .json file that describes another")
      ->check(known_mesher())
      ->capture_default_str();
  add_requirements(verb, command.required);
  add_choice(verb, "--strategies", command.strategies, "strategies that belong together; other options replace them");
  for (const baselines::MeshOption& option : baselines::mesh_options()) add_mesh_option(verb, option, command.options);
  verb.get_option("--threads")->default_str("all cores; 1 for a file up to 100 kB with --lattice none");
}

baselines::NamedOptions given_options(const CLI::App& verb) {
  baselines::NamedOptions given;
  for (const CLI::Option* option : verb.get_options())
    if (option->count() > 0 && !option->get_lnames().empty())
      given[option->get_lnames().front()] = option->results().front();
  return given;
}

/// The error in these words of a command line; empty: none.
/// \param all  the words are all options, so they must fit together
std::string fault_of(std::vector<std::string> words, bool all) {
  CLI::App verb;
  MeshCommand command;
  add_options(verb, command);
  words.insert(words.begin(), {"part.off", "-o", "part.vtu"});
  std::ranges::reverse(words);  // the order that CLI11 wants
  try {
    verb.parse(std::move(words));
    if (all) check_surface_options(command);
  } catch (const CLI::ParseError& error) {
    return error.what();
  }
  return {};
}

}  // namespace

sweep::MeshOptionRules mesh_option_rules() {
  sweep::MeshOptionRules rules;
  CLI::App verb;
  MeshCommand command;
  verb.set_help_flag();
  add_options(verb, command);
  for (const CLI::Option* option : verb.get_options())
    if (!option->get_lnames().empty()) rules.names.push_back(option->get_lnames().front());
  for (const char* other :
       {"output", "surface-output", "report", "repair", "mesher", "require-dihedral", "require-r", "deviation"})
    std::erase(rules.names, other);
  rules.fault_of_value = [](const std::string& name, const std::string& value) {
    return fault_of({"--" + name, value}, false);
  };
  rules.fault_of_words = [](const std::vector<std::string>& words) { return fault_of(words, true); };
  return rules;
}

void add_mesh_command(CLI::App& app, ExitCode& exit_code) {
  auto command = std::make_shared<MeshCommand>();
  CLI::App* verb = app.add_subcommand("mesh", "fill a solid with tetrahedra");
  add_options(*verb, *command);
  verb->footer(meshers_of_build);
  verb->footer(mesh_footer);
  verb->callback([command, verb, &exit_code] {
    command->given = given_options(*verb);
    for (const auto& [name, value] : baselines::options_of(command->strategies, command->given)) {
      CLI::Option* const option = verb->get_option("--" + name);
      option->add_result(value);
      option->run_callback();
    }
    exit_code = with_stage_of_limits(command->input, "report", [&] { return run(*command); }) ? done : failed_a_check;
  });
}

}  // namespace ccdt::tools
