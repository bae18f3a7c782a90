#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>

#include "baselines/external_program.h"
#include "baselines/known_meshers.h"
#include "baselines/mesh_cleanup.h"
#include "baselines/mesher_input.h"
#include "baselines/process.h"
#include "engine/base/errors.h"
#include "engine/io/output_file.h"
#include "engine/io/tet_mesh_files.h"
#include "engine/plc/build_plc.h"

namespace ccdt {
namespace {

constexpr const char* program_name = "gmsh";
constexpr const char* program_variable = "CCDT_GMSH";

/// Gmsh's own value for a size that nobody has asked for.
constexpr double no_size = 1e22;

/// Facets with the same regions at their sides and the same marker: one of Gmsh's discrete surfaces.
struct Patch {
  RegionId below, above;
  int marker = 0;
  auto operator<=>(const Patch&) const = default;
};

/// The domain as Gmsh takes it: triangles, each of a discrete surface, and volumes between such surfaces.
struct DiscreteModel {
  TetMesh triangles;              ///< `face_markers`: numbers of patches, from 1 in the order of their first triangles
  std::vector<Patch> patches;     ///< by number less one
  std::vector<RegionId> volumes;  ///< by number less one: the regions inside
};

[[noreturn]] void fail(const std::string& what, const std::string& file, const std::string& remedy) {
  Place place;
  place.file = file;
  throw MeshError(what, place, remedy);
}

[[noreturn]] void refuse(const std::string& what, const std::string& file) {
  fail("Gmsh's HXT keeps no " + what + " inside a volume", file, "leave them out, or choose another mesher");
}

/// Every segment has to be an edge of a facet.
void check_segments(const Plc& plc, std::vector<std::array<VertexId, 2>> facet_edges) {
  std::ranges::sort(facet_edges);
  for (const Segment& segment : plc.segments) {
    const auto [low, high] = std::minmax(segment.ends[0], segment.ends[1]);
    if (!std::ranges::binary_search(facet_edges, std::array{low, high})) refuse("segments", plc.name);
  }
}

DiscreteModel discrete_model(const Plc& plc) {
  DiscreteModel model;
  std::map<Patch, int> numbers;
  std::vector<std::array<VertexId, 2>> edges;
  std::vector<char> is_used(plc.vertices.size(), 0);
  for (const Facet& facet : plc.facets) {
    const bool inside_below = plc.regions[facet.below].inside, inside_above = plc.regions[facet.above].inside;
    if (facet.below == facet.above && inside_below) refuse("facets", plc.name);
    const Patch patch{facet.below, facet.above, facet.marker};
    const bool bounds = inside_below || inside_above;
    if (bounds && numbers.try_emplace(patch, static_cast<int>(numbers.size()) + 1).second)
      model.patches.push_back(patch);
    for (const auto& triangle : facet.triangles) {
      for (std::size_t i = 0; i < 3; ++i) {
        const auto [low, high] = std::minmax(triangle[i], triangle[(i + 1) % 3]);
        edges.push_back({low, high});
        is_used[low.value] = is_used[high.value] = 1;
      }
      if (!bounds) continue;
      model.triangles.faces.push_back({triangle[0].value, triangle[1].value, triangle[2].value});
      model.triangles.face_markers.push_back(numbers[patch]);
    }
  }
  if (std::ranges::count(is_used, 0) > 0) refuse("vertices", plc.name);
  check_segments(plc, std::move(edges));
  model.triangles.vertices = plc.world;
  for (std::uint32_t c = 0; c < plc.regions.size(); ++c)
    if (plc.regions[RegionId(c)].inside) model.volumes.push_back(RegionId(c));
  return model;
}

MesherSettings settings_of_gmsh(const InputPlc& input, const MeshOptions& options) {
  MesherSettings settings = {{"Mesh.Algorithm3D", "10"},
                             {"Mesh.Optimize", improvement_of(options) == Improvement::none ? "0" : "1"}};
  const bool bare = options.lattice == Lattice::none;
  if (options.edge_length == 0 && !bare) {
    settings.emplace_back("Mesh.MeshSizeExtendFromBoundary", "1");
    return settings;
  }
  const std::string size = digits(bare ? no_size : target_edge_length(input, options));
  for (const auto& [name, value] : {std::pair<const char*, std::string>{"Mesh.MeshSizeExtendFromBoundary", "0"},
                                    {"Mesh.MeshSizeMin", size},
                                    {"Mesh.MeshSizeMax", size}})
    settings.emplace_back(name, value);
  return settings;
}

/// The script that Gmsh runs: the discrete surfaces from a file, the volumes between them, and the settings.
void write_script(const DiscreteModel& model, const std::string& surface, const MesherSettings& settings,
                  const std::filesystem::path& file) {
  io::OutputFile script(file);
  script << "Merge \"" << surface << "\";\n";
  for (std::size_t v = 0; v < model.volumes.size(); ++v) {
    std::string surfaces;
    for (std::size_t p = 0; p < model.patches.size(); ++p)
      if (model.patches[p].below == model.volumes[v] || model.patches[p].above == model.volumes[v])
        surfaces += (surfaces.empty() ? "" : ", ") + std::to_string(p + 1);
    const std::string number = std::to_string(v + 1);
    script << "Surface Loop(" << number << ") = {" << surfaces << "};\nVolume(" << number << ") = {" << number
           << "};\nPhysical Volume(" << number << ") = {" << number << "};\n";
  }
  for (const auto& [name, value] : settings) script << name << " = " << value << ";\n";
  script << "Mesh.MshFileVersion = 2.2;\nMesh.Binary = 0;\n";
  script.commit();
}

/// What Gmsh says of its work.
struct Log {
  double mesh_seconds = 0;      ///< "Done meshing 3D (Wall 1.5s, ...": all of HXT, and what Gmsh does around it
  double optimize_seconds = 0;  ///< "tOptimize = 1.2": the part of that which is improvement
  std::string error;            ///< the first
};

/// The number behind a word in a line of the log, or 0.
double number_behind(const std::string& line, const std::string& word) {
  const auto at = line.find(word);
  if (at == std::string::npos) return 0;
  const auto digit = line.find_first_of("0123456789", at + word.size());
  return digit == std::string::npos ? 0 : std::strtod(line.c_str() + digit, nullptr);
}

Log read_log(const std::filesystem::path& file) {
  Log log;
  std::ifstream lines(file);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("Error") && log.error.empty()) log.error = line.substr(line.find_first_not_of(" :", 5));
    for (const char* work : {"Done meshing 3D (Wall", "Done optimizing mesh (Wall"})
      log.mesh_seconds += number_behind(line, work);
    log.optimize_seconds += number_behind(line, "tOptimize");
  }
  return log;
}

TetMesh read_back(const std::filesystem::path& file, const DiscreteModel& model, const Plc& plc) {
  TetMesh mesh = read_tet_mesh(file);
  for (int& region : mesh.regions)
    region = plc.regions[model.volumes.at(static_cast<std::size_t>(region) - 1)].attribute;
  for (int& marker : mesh.face_markers) marker = model.patches.at(static_cast<std::size_t>(marker) - 1).marker;
  orient_positively(mesh);
  restore_coordinates(plc.world, mesh);
  return mesh;
}

MesherRun run_gmsh(const InputPlc& input, const MeshOptions& options, const Progress& progress) {
  const auto program = find_program(program_name, program_variable);
  if (!program) fail("Gmsh is no longer there", input.name, "install it, or say by CCDT_GMSH where it is");
  const Plc plc = build_plc(input, {.flatness = options.flatness});
  const DiscreteModel model = discrete_model(plc);

  const TemporaryFolder folder;
  const auto file = [&](const char* name) { return folder.path() / name; };
  MesherRun run;
  run.settings = settings_of_gmsh(input, options);
  write_tet_mesh(model.triangles, file("surface.msh"));
  write_script(model, "surface.msh", run.settings, file("model.geo"));
  report(progress, "gmsh", 0, 0);
  const int code = run_program({program->string(), file("model.geo").string(), "-3", "-nt", "1", "-v", "5", "-o",
                                file("volume.msh").string()},
                               {.log = file("log")})
                       .shell_code();
  const Log log = read_log(file("log"));
  if (code != 0 || !log.error.empty() || !std::filesystem::exists(file("volume.msh")))
    fail("Gmsh ended with code " + std::to_string(code) + (log.error.empty() ? "" : ": " + log.error), input.name,
         "try another mesher, or check the surface there");

  run.result.seconds.improve = log.optimize_seconds;
  run.result.seconds.mesh = log.mesh_seconds;
  run.result.mesh = read_back(file("volume.msh"), model, plc);
  if (run.result.mesh.tetrahedra.empty()) fail("Gmsh made no tetrahedra", input.name, "try another mesher");
  run.result.counts = count_elements(input, run.result.mesh);
  return run;
}

/// `gmsh --version` prints it alone.
std::string version_of_gmsh() {
  const auto program = find_program(program_name, program_variable);
  return program ? version_of_program({program->string(), "--version"}, "^[0-9]+[.][^ ]*") : unknown_version;
}

}  // namespace

std::optional<Mesher> gmsh_hxt_mesher() {
  const auto program = find_program(program_name, program_variable);
  if (!program) return std::nullopt;
  return Mesher{
      "gmsh-hxt",         "",       "Gmsh's HXT, run as the program " + program->string() + ": refines and optimizes",
      "GPL-2.0-or-later", run_gmsh, settings_of_gmsh,
      version_of_gmsh};
}

}  // namespace ccdt
