#include <algorithm>

#include "baselines/known_meshers.h"
#include "baselines/mesher.h"
#include "engine/base/errors.h"

namespace ccdt {
namespace {

MesherRun run_ccdt(const InputPlc& input, const MeshOptions& options, const Progress& progress) {
  return {mesh_plc(input, options, progress), {}, {}};
}

std::vector<Mesher> meshers_of_this_build() {
  std::vector<Mesher> all;
  all.push_back({"ccdt", CCDT_VERSION, "this project's engine: conforming constrained Delaunay tetrahedralization",
                 "MIT", run_ccdt});
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

}  // namespace

std::span<const Mesher> meshers() {
  static const std::vector<Mesher> all = meshers_of_this_build();
  return all;
}

const Mesher& mesher(std::string_view name) {
  const auto all = meshers();
  const auto found = std::ranges::find(all, name, &Mesher::name);
  if (found != all.end()) return *found;
  std::string known;
  for (const Mesher& m : all) known += (known.empty() ? "" : ", ") + m.name;
  throw Error("there is no mesher '" + std::string(name) + "' in this build", {}, "choose one of: " + known);
}

}  // namespace ccdt
