#include <algorithm>
#include <memory>
#include <optional>
#include <set>

#include "baselines/external_program.h"
#include "baselines/known_meshers.h"
#include "baselines/mesh_cleanup.h"
#include "baselines/mesher_input.h"
#include "baselines/process.h"
#include "engine/base/digits.h"
#include "engine/io/files.h"
#include "engine/io/plc_files.h"
#include "engine/io/tet_mesh_files.h"
#include "engine/plc/build_plc.h"

namespace ccdt::baselines {
namespace {

constexpr const char* input_stem = "input";

using Description = MesherDescription;

bool holds(ChoiceCondition condition, const InputPlc& input, const MeshOptions& options) {
  switch (condition) {
    case ChoiceCondition::interior_points:
      return options.lattice != Lattice::none;
    case ChoiceCondition::improvement:
      return improvement_of(options) != Improvement::none;
    case ChoiceCondition::edge_length:
      return options.edge_length > 0;
    case ChoiceCondition::regions:
      return !input.regions.empty();
  }
  return false;
}

std::string input_name(const Description& description) {
  return std::string(input_stem) + "." + description.input_format;
}

/// \param folder  of the run
std::vector<Placeholder> values_for(const Description& description, const InputPlc& input, const MeshOptions& options,
                                    const std::string& folder) {
  const double edge_length = target_edge_length(input, options);
  std::vector<Placeholder> values = {{"input", input_name(description)},
                                     {"stem", input_stem},
                                     {"folder", folder},
                                     {"here", folder_of(description)},
                                     {"edge_length", digits(edge_length)},
                                     {"max_volume", digits(largest_tetrahedron_volume(edge_length))}};
  std::vector<Placeholder> chosen;
  for (const Choice& choice : description.choices)
    chosen.push_back(
        {choice.name,
         fill_placeholders(holds(choice.condition, input, options) ? choice.text_if : choice.text_else, values)});
  values.insert(values.end(), chosen.begin(), chosen.end());
  return values;
}

std::vector<std::string> fill_all(const std::vector<std::string>& words, const std::vector<Placeholder>& values) {
  std::vector<std::string> all;
  for (const std::string& word : words) all.push_back(fill_placeholders(word, values));
  return all;
}

/// The program of a command: relative to the folder of the description if it has a slash, otherwise on PATH.
std::optional<std::filesystem::path> program_of(const Description& description, const std::string& name) {
  if (name.find('/') == std::string::npos) return find_on_path(name);
  const auto file = std::filesystem::path(folder_of(description)) / name;
  return std::filesystem::exists(file) ? std::optional(file) : std::nullopt;
}

MesherSettings settings_of_described(const Description& description, const InputPlc& input,
                                     const MeshOptions& options) {
  const std::vector<Placeholder> values = values_for(description, input, options, "{folder}");
  MesherSettings settings = {{"description", description.file.string()},
                             {"command", command_line(fill_all(description.command, values))}};
  for (const auto& [name, text] : description.files) settings.emplace_back(name, fill_placeholders(text, values));
  for (const auto& [name, value] : description.environment)
    settings.emplace_back("environment " + name, fill_placeholders(value, values));
  return settings;
}

bool keeps_polygons(const Description& description) {
  return description.input_format == "poly" || description.input_format == "smesh";
}

/// Surface formats need triangles; PLC formats keep polygons.
InputPlc input_for_format(const Description& description, const InputPlc& input, const MeshOptions& options) {
  if (keeps_polygons(description) || input.polygon_facets.empty()) return merge_equal_vertices(input);
  return triangulate_facets(input, options);
}

void write_input(const Description& description, const InputPlc& input, const std::filesystem::path& folder) {
  try {
    io::write_plc(input, folder / input_name(description));
  } catch (const OutputError& error) {
    throw MeshError(description.name + " reads ." + description.input_format + ": " + error.what(),
                    io::place_in(input.name), "remove it, or choose a mesher that reads .poly");
  }
}

void write_files(const Description& description, const std::vector<Placeholder>& values,
                 const std::filesystem::path& folder) {
  for (const auto& [name, text] : description.files) {
    io::OutputFile file(folder / name);
    file << fill_placeholders(text, values);
    file.commit();
  }
}

/// Runs the program in the folder.
/// \return  wall-clock seconds of the call
double call_program(const Description& description, const InputPlc& input, const std::vector<Placeholder>& values,
                    const std::filesystem::path& folder, const std::filesystem::path& log) {
  std::vector<std::string> command = fill_all(description.command, values);
  const auto program = program_of(description, command[0]);
  if (!program)
    throw InputError("/command/0: there is no program '" + command[0] + "'", io::place_in(description.file.string()),
                     description.install.empty() ? "install it, or give its path" : description.install);
  command[0] = program->string();
  ProgramOptions options{.folder = folder, .log = log, .limits = Limits()};
  for (const auto& [name, value] : description.environment)
    options.environment.emplace_back(name, fill_placeholders(value, values));
  const ProcessResult ended = run_program(command, options);
  const int code = ended.shell_code();
  if (std::ranges::find(description.success_codes, code) == description.success_codes.end())
    throw MesherError(failure_kind_of_exit_code(code),
                      description.name + " ended with code " + std::to_string(code) +
                          (code > 128 && code < 192 ? ", by signal " + std::to_string(code - 128) : "") +
                          "; it printed: " + last_lines(log),
                      io::place_in(input.name), "try another mesher, or check the surface there");
  return ended.seconds;
}

TetMesh read_output(const Description& description, const InputPlc& input, const std::string& name,
                    const std::filesystem::path& folder, const std::filesystem::path& log) {
  if (!std::filesystem::exists(folder / name))
    throw MesherError(
        FailureKind::wrong, description.name + " wrote no file " + name + "; it printed: " + last_lines(log),
        io::place_in(input.name), "try another mesher, or correct /output in " + description.file.string());
  try {
    return io::read_tet_mesh(folder / name);
  } catch (const InputError& error) {
    const long long line = error.place().line;
    throw MesherError(FailureKind::wrong,
                      "what " + description.name + " wrote cannot be read: " + name +
                          (line > 0 ? ", line " + std::to_string(line) : "") + ": " + error.what(),
                      io::place_in(input.name),
                      "try another mesher, or correct /output in " + description.file.string());
  }
}

/// Converts the output of a program to the result of a mesher.
void clean_up(const InputPlc& input, TetMesh& mesh, std::vector<std::string>& notes) {
  orient_positively(mesh);
  if (const std::size_t restored = restore_coordinates(input.vertices, mesh); restored > 0)
    notes.push_back(std::to_string(restored) +
                    " vertices of the input got their coordinates back, which files had rounded");
  if (mesh.faces.empty()) add_boundary_faces(mesh);
  if (input.inside == InputPlc::Inside::even_odd) keep_odd_regions(mesh);
  mesh.constrained_delaunay = false;
}

bool has_markers(const InputPlc& input) {
  const auto is_marker = [](int marker) { return marker != 0; };
  return std::ranges::any_of(input.triangle_markers, is_marker) ||
         std::ranges::any_of(input.polygon_facets, is_marker, &plc::PolygonFacet::marker);
}

/// Leaves out the mesher's own markers if it could not know those of the input: they would be taken for each other.
void drop_own_markers(const Description& description, const InputPlc& input, TetMesh& mesh,
                      std::vector<std::string>& notes) {
  if (!has_markers(input) || io::keeps_markers(input_name(description))) return;
  mesh.face_markers.clear();
  mesh.edge_markers.clear();
  mesh.face_names.clear();
  notes.push_back("the mesh has no markers: " + description.name + " reads ." + description.input_format +
                  ", which carries none");
}

MesherRun run_described(const Description& description, const InputPlc& input, const MeshOptions& options,
                        const Progress& progress) {
  const InputPlc given = input_for_format(description, input, options);
  const TemporaryFolder temporary;
  const auto folder = temporary.path() / "run", log = temporary.path() / "log";
  std::filesystem::create_directory(folder);
  const std::vector<Placeholder> values = values_for(description, input, options, folder.string());
  write_input(description, given, folder);
  write_files(description, values, folder);
  report(progress, description.name, 0, 0);

  MesherRun run;
  run.settings = settings_of_described(description, input, options);
  const double wall_seconds = call_program(description, input, values, folder, log);
  const auto said = description.seconds_pattern.empty() ? std::nullopt : sum_in_log(log, description.seconds_pattern);
  run.result.costs.mesh_seconds = said.value_or(wall_seconds);
  if (!said) run.notes.emplace_back("the seconds are those of the whole call, including start, reading and writing");
  run.result.mesh = read_output(description, input, fill_placeholders(description.output, values), folder, log);
  drop_own_markers(description, given, run.result.mesh, run.notes);
  clean_up(given, run.result.mesh, run.notes);
  if (run.result.mesh.tetrahedra.empty())
    throw MesherError(FailureKind::wrong,
                      description.name + " made no tetrahedra inside; it printed: " + last_lines(log),
                      io::place_in(input.name), "try another mesher, or check whether the surface is closed");
  run.result.counts = count_elements(given, run.result.mesh);
  return run;
}

std::string ask_version(const Description& description) {
  if (description.version_command.empty()) return unknown_version;
  std::vector<std::string> command = fill_all(description.version_command, {{"here", folder_of(description)}});
  const auto program = program_of(description, command[0]);
  if (!program) return unknown_version;
  command[0] = program->string();
  return version_of_program(command, description.version_pattern);
}

/// The options that change the texts.
///
/// \param bare  with `--lattice none`
std::set<std::string> options_in_texts(const Description& description, bool bare) {
  std::set<std::string> options;
  const auto note = [&](const std::string& name) {
    if (name == "edge_length" || name == "max_volume") options.insert("edge-length");
  };
  const auto note_choice = [&](const Choice& choice) {
    const bool is_inside = choice.condition == ChoiceCondition::interior_points;
    if (is_inside) options.insert("lattice");
    if (choice.condition == ChoiceCondition::improvement) options.insert("improve");
    if (choice.condition == ChoiceCondition::edge_length) options.insert("edge-length");
    if (!is_inside || !bare) std::ranges::for_each(placeholders_in(choice.text_if), note);
    if (!is_inside || bare) std::ranges::for_each(placeholders_in(choice.text_else), note);
  };
  for (const std::string& text : texts_of(description))
    for (const std::string& name : placeholders_in(text)) {
      note(name);
      const auto choice = std::ranges::find(description.choices, name, &Choice::name);
      if (choice != description.choices.end()) note_choice(*choice);
    }
  return options;
}

std::vector<OptionUse> options_of_described(const Description& description) {
  const std::set<std::string> inside = options_in_texts(description, false), bare = options_in_texts(description, true);
  std::set<std::string> all = inside;
  all.insert(bare.begin(), bare.end());
  std::vector<OptionUse> uses;
  for (const std::string& name : all)
    uses.push_back({.name = name, .only_none = name != "edge-length", .only_inside = !bare.contains(name)});
  if (!keeps_polygons(description)) uses.push_back({.name = "flatness"});  // for the triangles of polygons
  return uses;
}

}  // namespace

Mesher described_mesher(const MesherDescription& description) {
  const auto asked = std::make_shared<std::string>();
  return {.name = description.name,
          .version = "",
          .what = description.what,
          .license = description.license,
          .run = [=](const InputPlc& input, const MeshOptions& options,
                     const Progress& progress) { return run_described(description, input, options, progress); },
          .settings = [=](const InputPlc& input,
                          const MeshOptions& options) { return settings_of_described(description, input, options); },
          .ask_version =
              [=] {
                if (asked->empty()) *asked = ask_version(description);
                return *asked;
              },
          .keeps_surface = description.keeps_surface,
          .options = options_of_described(description),
          .program = program_of(description, description.command[0]).value_or(""),
          .description = description.file};
}

}  // namespace ccdt::baselines
