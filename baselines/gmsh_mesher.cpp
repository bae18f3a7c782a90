#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <utility>

#include "baselines/external_program.h"
#include "baselines/known_meshers.h"
#include "baselines/mesh_cleanup.h"
#include "baselines/mesher_input.h"
#include "baselines/process.h"
#include "engine/base/digits.h"
#include "engine/io/files.h"
#include "engine/io/tet_mesh_files.h"
#include "engine/plc/build_plc.h"

namespace ccdt::baselines {
namespace {

constexpr const char* program_name = "gmsh";
constexpr const char* program_variable = "CCDT_GMSH";

/// Gmsh's value for an unspecified size.
constexpr double no_size = 1e22;

/// The facets with the same regions on their sides and the same marker: a discrete surface of Gmsh.
struct DiscreteSurface {
  RegionId below, above;
  int marker = 0;
  auto operator<=>(const DiscreteSurface&) const = default;
};

/// The domain in the form that Gmsh reads: triangles on discrete surfaces, and volumes between these surfaces.
struct DiscreteModel {
  TetMesh triangles;  ///< `face_markers`: numbers of surfaces, from 1 in the order of their first triangles
  std::vector<DiscreteSurface> surfaces;  ///< by number minus one
  std::vector<RegionId> volumes;          ///< by number minus one: the regions inside
};

[[noreturn]] void fail(const std::string& what, const std::string& file, const std::string& remedy,
                       FailureKind kind = FailureKind::refused) {
  throw MesherError(kind, what, io::place_in(file), remedy);
}

[[noreturn]] void refuse(const std::string& what, const std::string& file) {
  fail("Gmsh's HXT cannot keep " + what + " inside a volume", file, "remove them, or choose another mesher");
}

/// Checks that every segment is an edge of a facet.
void check_segments(const plc::Plc& plc, std::vector<std::array<VertexId, 2>> facet_edges) {
  std::ranges::sort(facet_edges);
  for (const plc::Segment& segment : plc.segments) {
    const auto [low, high] = std::minmax(segment.ends[0], segment.ends[1]);
    if (!std::ranges::binary_search(facet_edges, std::array{low, high})) refuse("segments", plc.name);
  }
}

DiscreteModel discrete_model(const plc::Plc& plc) {
  DiscreteModel model;
  std::map<DiscreteSurface, int> numbers;
  std::vector<std::array<VertexId, 2>> edges;
  std::vector<char> is_used(plc.vertices.size(), 0);
  for (const plc::Facet& facet : plc.facets) {
    const bool inside_below = plc.regions[facet.below].inside, inside_above = plc.regions[facet.above].inside;
    if (facet.below == facet.above && inside_below) refuse("facets", plc.name);
    const DiscreteSurface surface{facet.below, facet.above, facet.marker};
    const bool bounds = inside_below || inside_above;
    if (bounds && numbers.try_emplace(surface, static_cast<int>(numbers.size()) + 1).second)
      model.surfaces.push_back(surface);
    for (const auto& triangle : plc.triangles_of(facet)) {
      for (std::size_t i = 0; i < 3; ++i) {
        const auto [low, high] = std::minmax(triangle[i], triangle[(i + 1) % 3]);
        edges.push_back({low, high});
        is_used[low.value] = is_used[high.value] = 1;
      }
      if (!bounds) continue;
      model.triangles.faces.push_back({triangle[0].value, triangle[1].value, triangle[2].value});
      model.triangles.face_markers.push_back(numbers[surface]);
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
    for (std::size_t p = 0; p < model.surfaces.size(); ++p)
      if (model.surfaces[p].below == model.volumes[v] || model.surfaces[p].above == model.volumes[v])
        surfaces += (surfaces.empty() ? "" : ", ") + std::to_string(p + 1);
    const std::string number = std::to_string(v + 1);
    script << "Surface Loop(" << number << ") = {" << surfaces << "};\nVolume(" << number << ") = {" << number
           << "};\nPhysical Volume(" << number << ") = {" << number << "};\n";
  }
  for (const auto& [name, value] : settings) script << name << " = " << value << ";\n";
  script << "Mesh.MshFileVersion = 2.2;\nMesh.Binary = 0;\n";
  script.commit();
}

/// Replaces Gmsh's numbers by the attributes of regions and the markers of facets.
/// \throw std::out_of_range  there is no such number
void restore_attributes(const DiscreteModel& model, const plc::Plc& plc, TetMesh& mesh) {
  for (int& region : mesh.regions)
    region = plc.regions[model.volumes.at(static_cast<std::size_t>(region) - 1)].attribute;
  for (int& marker : mesh.face_markers) marker = model.surfaces.at(static_cast<std::size_t>(marker) - 1).marker;
}

TetMesh read_back(const std::filesystem::path& file, const DiscreteModel& model, const plc::Plc& plc) {
  TetMesh mesh;
  try {
    mesh = io::read_tet_mesh(file);
    restore_attributes(model, plc, mesh);
  } catch (const InputError& error) {
    fail(std::string("the output of Gmsh cannot be read: ") + error.what(), plc.name, "try another mesher",
         FailureKind::wrong);
  } catch (const std::out_of_range&) {
    fail("Gmsh wrote unknown numbers of volumes or surfaces", plc.name, "try another mesher", FailureKind::wrong);
  }
  orient_positively(mesh);
  restore_coordinates(plc.world, mesh);
  return mesh;
}

MesherRun run_gmsh(const InputPlc& input, const MeshOptions& options, const Progress& progress) {
  const auto program = find_program(program_name, program_variable);
  if (!program) fail("the program gmsh has disappeared", input.name, "install it, or set CCDT_GMSH to its path");
  const plc::Plc plc = plc::build_plc(input, {.flatness = options.flatness});
  const DiscreteModel model = discrete_model(plc);

  const TemporaryFolder folder;
  const auto file = [&](const char* name) { return folder.path() / name; };
  MesherRun run;
  run.settings = settings_of_gmsh(input, options);
  io::write_tet_mesh(model.triangles, file("surface.msh"));
  write_script(model, "surface.msh", run.settings, file("model.geo"));
  report(progress, "gmsh", 0, 0);
  // Runs in the folder with short names: longer paths have changed the tetrahedra that HXT makes.
  const std::string gmsh = std::filesystem::absolute(*program).string();
  const int code = run_program({gmsh, "model.geo", "-3", "-nt", "1", "-v", "5", "-o", "volume.msh"},
                               {.folder = folder.path(), .log = file("log"), .limits = Limits()})
                       .shell_code();
  const auto error = first_in_log(file("log"), "^Error[ :]*(.*)");
  if (code != 0 || error)
    fail("Gmsh ended with code " + std::to_string(code) + (error ? ": " + *error : ""), input.name,
         "try another mesher, or check the surface there", failure_kind_of_exit_code(code));
  if (!std::filesystem::exists(file("volume.msh")))
    fail("Gmsh wrote no mesh", input.name, "try another mesher", FailureKind::wrong);

  // "tOptimize = 1.2" is a part of "Done meshing 3D (Wall 1.5s, ...", which covers HXT and the work of Gmsh around it.
  run.result.costs[Stage::improve].seconds = sum_in_log(file("log"), "tOptimize[^0-9]*([0-9][0-9.e+-]*)").value_or(0);
  run.result.costs.mesh_seconds =
      sum_in_log(file("log"), "Done (?:meshing 3D|optimizing mesh) [(]Wall[^0-9]*([0-9][0-9.e+-]*)").value_or(0);
  run.result.mesh = read_back(file("volume.msh"), model, plc);
  if (run.result.mesh.tetrahedra.empty())
    fail("Gmsh made no tetrahedra", input.name, "try another mesher", FailureKind::wrong);
  run.result.counts = count_elements(input, run.result.mesh);
  return run;
}

/// `gmsh --version` prints nothing else.
std::string version_of_gmsh() {
  const auto program = find_program(program_name, program_variable);
  return program ? version_of_program({program->string(), "--version"}, "^[0-9]+[.][^ ]*") : unknown_version;
}

}  // namespace

std::optional<Mesher> gmsh_hxt_mesher() {
  const auto program = find_program(program_name, program_variable);
  if (!program) return std::nullopt;
  return Mesher{.name = "gmsh-hxt",
                .version = "",
                .what = "Gmsh's HXT, run as the program " + program->string() + ": refines and optimizes",
                .license = "GPL-2.0-or-later",
                .run = run_gmsh,
                .settings = settings_of_gmsh,
                .ask_version = version_of_gmsh,
                .options = {{.name = "edge-length", .only_inside = true},
                            {.name = "flatness"},
                            {.name = "improve", .only_none = true},
                            {.name = "lattice", .only_none = true}},
                .program = *program};
}

}  // namespace ccdt::baselines
