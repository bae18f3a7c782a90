#include <algorithm>
#include <map>
#include <utility>

#include "baselines/known_meshers.h"
#include "baselines/mesher.h"
#include "baselines/mesher_options.h"
#include "engine/io/files.h"
#include "engine/version.h"

namespace ccdt::baselines {
namespace {

MesherRun run_ccdt(const InputPlc& input, const MeshOptions& options, const Progress& progress) {
  return {mesh_plc(input, options, progress), {}, {}};
}

std::vector<Mesher> meshers_of_this_build() {
  std::vector<Mesher> all;
  all.push_back({"ccdt", std::string(engine_version),
                 "this project's engine: conforming constrained Delaunay tetrahedralization", "MIT", run_ccdt});
  all.back().options = options_of_engine();
#ifdef CCDT_WITH_TETGEN
  all.push_back(tetgen_mesher());
#endif
#ifdef CCDT_WITH_CGAL_MESHERS
  all.push_back(cgal_mesh3_mesher());
  all.push_back(cgal_delaunay_mesher());
#endif
  if (auto gmsh = gmsh_hxt_mesher()) all.push_back(*std::move(gmsh));
  return all;
}

std::string names_of_all() {
  std::string names;
  for (const Mesher& m : meshers()) names += (names.empty() ? "" : ", ") + m.name;
  return names;
}

/// The mesher that a file describes. Each file is read once.
const Mesher& mesher_of_file(const std::string& file) {
  static std::map<std::string, Mesher> known;
  if (const auto found = known.find(file); found != known.end()) return found->second;
  Mesher described = described_mesher(read_mesher_description(file));
  const auto all = meshers();
  if (std::ranges::find(all, described.name, &Mesher::name) != all.end())
    throw InputError("/name: '" + described.name + "' is a mesher of this build", io::place_in(file),
                     "give the description another name, so that reports can tell them apart");
  return known.emplace(file, std::move(described)).first->second;
}

}  // namespace

std::span<const Mesher> meshers() {
  static const std::vector<Mesher> all = meshers_of_this_build();
  return all;
}

bool is_mesher_description(std::string_view name_or_file) {
  return name_or_file.ends_with(".json");
}

const Mesher& mesher(std::string_view name_or_file) {
  if (is_mesher_description(name_or_file)) return mesher_of_file(std::string(name_or_file));
  const auto all = meshers();
  const auto found = std::ranges::find(all, name_or_file, &Mesher::name);
  if (found != all.end()) return *found;
  throw Error("there is no mesher '" + std::string(name_or_file) + "' in this build", {},
              "choose one of: " + names_of_all() + "; or give a .json file that describes another");
}

std::string version_of(const Mesher& mesher) {
  return mesher.ask_version ? mesher.ask_version() : mesher.version;
}

MesherSettings settings_of(const Mesher& mesher, const InputPlc& input, const MeshOptions& options) {
  return mesher.settings ? mesher.settings(input, options) : MesherSettings();
}

}  // namespace ccdt::baselines
