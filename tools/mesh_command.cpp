#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "baselines/mesher.h"
#include "baselines/mesher_options.h"
#include "baselines/stop.h"
#include "bench/run/run_record.h"
#include "engine/base/errors.h"
#include "engine/io/files.h"
#include "engine/io/plc_files.h"
#include "engine/io/tet_mesh_files.h"
#include "engine/options/option_table.h"
#include "reports/result_text.h"
#include "tools/commands.h"
#include "tools/freed_memory.h"
#include "tools/limit_errors.h"
#include "tools/markers.h"
#include "tools/mesh_file.h"
#include "tools/options.h"
#include "tools/progress_bar.h"
#include "tools/streams.h"
#include "tools/sweep_command.h"
#include "tools/terminal.h"

namespace ccdt::tools {
namespace {

void check_surface_options(const MeshCommand& command) {
  const bool remesh = command.options.surface == SurfaceRule::remesh;
  const bool has_sizes =
      !command.options.background.name.empty() || !command.options.local.name.empty() || !command.options.local.empty();
  const bool changes = surface::makes_new_surface(command.options.surface);
  if (remesh && command.options.edge_length == 0 && !has_sizes)
    throw CLI::ValidationError("--surface remesh", "give the length of its edges with --edge-length");
  const bool has_length = command.options.edge_length > 0 || command.options.surface == SurfaceRule::automatic;
  if (command.options.tetrahedra > 0 && !has_length && command.mesher != "ccdt")
    throw CLI::ValidationError("--tetrahedra", "give an edge length to begin with, by --edge-length");
  if (!changes && !command.repair && !command.surface_output.empty())
    throw CLI::ValidationError("--surface-output",
                               "there is no new surface without --surface auto, remesh or --repair");
  if (!changes && command.options.deviation > 0)
    throw CLI::ValidationError("--deviation", "only --surface auto and remesh make a surface that deviates");
  if (command.options.periodic != Periodicity::none && (changes || command.mesher != "ccdt"))
    throw CLI::ValidationError("--periodic", "only ccdt makes equal sides, with --surface keep or refine");
  if (command.options.surface == SurfaceRule::refine && command.mesher != "ccdt")
    throw CLI::ValidationError("--surface refine",
                               "only ccdt refines a surface; use --surface auto or remesh for other meshers");
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
  check_mesh_stream(command.output, command.format);
  io::check_tet_mesh_output(command.output, command.format, command.order, command.partitions > 0);
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
  if (command.options.deviation > 0) command.required.deviation = command.options.deviation;
  if (command.mesher == "ccdt") keep_freed_memory();
  check_surface_options(command);
  give_standard_output({command.output, command.report});
  check_files(command);
  if (command.options.threads == 0 && is_small(command)) command.options.threads = 1;
  bench::RunRecord record = begin_record(command);
  const auto write_report = [&] {
    LastRecord::disarm();
    if (!command.report.empty()) write_text(command.report, bench::to_json(record));
  };
  LastRecord last(command.report);
  last.set(record);
  try {
    with_progress(name_of_input(command.input), command.options.threads, [&](const Progress& progress) {
      mesh_file(command, record, last, [&](std::string_view stage, std::uint64_t done, std::uint64_t total) {
        if (stage != "estimate") last.enter(stage);
        report(progress, stage, done, total);
      });
    });
  } catch (const baselines::Stopped&) {
    leave_last_record();
    throw;
  } catch (const std::exception& error) {
    record.set_failure(baselines::failure_kind_of(error), error.what());
    write_report();
    throw;
  }
  write_report();
  print(reports::summarize(record));
  print(name_of_output(command.output), record.missed.empty() ? Tone::good : Tone::bad);
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
    "Example: give a CAD part even triangles, near its surface, that follow fillets and merge needles\n"
    "  ccdt mesh part.stl -o part.vtu --surface auto\n"
    "Example: remesh the surface to the same edge length, and keep it for `ccdt verify`\n"
    "  ccdt mesh part.stl -o part.vtu --edge-length 2 --surface remesh --surface-output even.off\n"
    "Example: keep flat facets and straight segments, but give them new vertices and even triangles\n"
    "  ccdt mesh part.stl -o part.vtu --edge-length 2 --surface refine\n"
    "Example: compute the constrained Delaunay tetrahedralization of the input alone\n"
    "  ccdt mesh part.stl -o part.mesh --lattice none --steiner keep\n";

void add_files(CLI::App& verb, MeshCommand& command) {
  verb.add_option("INPUT", command.input, std::string("surface or PLC: ") + read_plc_endings)->required();
  add_input_format(verb, "--input-format", command.input_format, io::plc_format_names());
  verb.add_option("-o,--output", command.output,
                  "mesh: .vtu .msh .msh4 .mesh .meshb .inp .xdmf .polymesh .node; - is standard output, with --format")
      ->required();
  verb.add_option("--format", command.format,
                  "format of the mesh, if not that of its extension: msh4 is Gmsh 4.1 (binary), msh Gmsh 2.2 (text), "
                  "polymesh a folder of OpenFOAM")
      ->check(CLI::IsMember(io::tet_mesh_formats()));
  verb.add_option("--order", command.order,
                  "2: elements with a node in the middle of each edge, in .msh .msh4 .vtu .inp .xdmf")
      ->check(whole_number(1, 2))
      ->capture_default_str();
  verb.add_option(
          "--partitions", command.partitions,
          "divide the tetrahedra into this many parts for solvers on several processes, by METIS, in .msh .msh4 "
          ".vtu")
      ->check(whole_number(1, 1'000'000));
  verb.add_option("--surface-output", command.surface_output,
                  std::string("write the remeshed or repaired surface to this file: ") + surface_endings);
  add_report(
      verb, "write a report of the run to this file, even if the run fails or is interrupted (JSON, schema ccdt.run/1)",
      command.report);
}

void add_requirements(CLI::App& verb, bench::Requirements& required) {
  constexpr double regular_dihedral = 70.53;  // no tetrahedron has more everywhere
  verb.add_option("--require-dihedral", required.dihedral_degrees,
                  "exit code 1 if a dihedral angle of the mesh is below this, or above 180 degrees less this")
      ->check(number_between(0, regular_dihedral));
  verb.add_option("--require-r", required.r, "exit code 1 if a tetrahedron has an r above this; the regular one has 1")
      ->check(number_between(1, std::numeric_limits<double>::max()));
}

void add_options(CLI::App& verb, MeshCommand& command) {
  add_files(verb, command);
  verb.add_flag("--repair", command.repair, "repair an input that is not valid; `ccdt check` has options for that");
  add_markers(verb, command.markers);
  verb.add_option("--mesher", command.mesher, "mesher: one of those below, or a .json file that describes another")
      ->check(known_mesher())
      ->capture_default_str();
  add_requirements(verb, command.required);
  add_choice(verb, "--strategies", command.strategies, "strategies that belong together; other options replace them");
  for (const options::MeshOption& option : options::mesh_options()) add_mesh_option(verb, option, command.options);
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
  for (const char* other : {"output", "input-format", "format", "order", "partitions", "surface-output", "report",
                            "json", "repair", "markers", "mesher", "require-dihedral", "require-r"})
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
