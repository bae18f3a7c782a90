#include <algorithm>
#include <array>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "bench/gate/callgrind_profile.h"
#include "bench/gate/instructions.h"
#include "engine/base/errors.h"

namespace ccdt::gate {
namespace {

/// A function that `mesh_plc` calls, and the name of its stage in reports.
struct StageFunction {
  std::string_view function, stage;
};

constexpr auto stage_functions = std::to_array<StageFunction>({{"ccdt::plc::gather_plc", "plc"},
                                                               {"ccdt::front::find_delaunay_faces", "plc"},
                                                               {"ccdt::plc::check_plc", "plc"},
                                                               {"ccdt::refine::refine_plc", "refine"},
                                                               {"ccdt::protection::unprotected", "protect"},
                                                               {"ccdt::protection::protect_edges", "protect"},
                                                               {"ccdt::facets::triangulate_facets", "facets"},
                                                               {"ccdt::lattice::place_lattice_points", "lattice"},
                                                               {"ccdt::protection::make_room", "lattice"},
                                                               {"ccdt::delaunay::build_delaunay", "delaunay"},
                                                               {"ccdt::delaunay::insert_points", "delaunay"},
                                                               {"ccdt::delaunay::wrap_delaunay", "delaunay"},
                                                               {"ccdt::cores::insert_points", "delaunay"},
                                                               {"ccdt::front::find_delaunay_faces_again", "face_check"},
                                                               {"ccdt::facets::follow_interior_vertices", "face_check"},
                                                               {"ccdt::folds::find_touching_faces", "face_check"},
                                                               {"ccdt::folds::find_loose_folds", "face_check"},
                                                               {"ccdt::folds::find_contacts", "face_check"},
                                                               {"ccdt::front::advance_front", "front"},
                                                               {"ccdt::label::label_cells", "label"},
                                                               {"ccdt::mesh::collect_tetrahedra", "label"},
                                                               {"ccdt::mesh::check_volume", "finish"},
                                                               {"ccdt::mesh::finish_mesh", "finish"},
                                                               {"ccdt::mesh::to_world", "finish"},
                                                               {"ccdt::mesh::join_tetrahedra", "improve"},
                                                               {"ccdt::improve::improve_mesh", "improve"}});
constexpr std::string_view whole = "ccdt::mesh_plc";
constexpr std::string_view remesh = "ccdt::surface::remesh_surface";

/// The share that a caller may execute itself, outside its stages. More means that a stage was inlined into it.
constexpr double largest_rest = 0.1;

const StageFunction* stage_function(std::string_view name) {
  const auto* const found = std::ranges::find(stage_functions, bare_name(name), &StageFunction::function);
  return found == stage_functions.end() ? nullptr : found;
}

std::vector<std::string> all_names_of(const CallGraph& graph, std::string_view function) {
  std::set<std::string> names;
  for (const auto& [caller, callee] : graph.calls)
    for (const std::string& name : {caller, callee.name})
      if (bare_name(name) == function) names.insert(name);
  return {names.begin(), names.end()};
}

/// Adds the stages that `mesh_plc` calls directly or indirectly, but not those within another stage: a new surface also
/// needs a PLC, and the paper's Delaunay method begins with insertion.
void add_stages(const CallGraph& graph, StageInstructions& stages, std::set<std::string_view>& found) {
  std::vector<std::string> pending = all_names_of(graph, whole);
  std::set<std::string> seen(pending.begin(), pending.end());
  while (!pending.empty()) {
    const std::string caller = std::move(pending.back());
    pending.pop_back();
    const auto [begin, end] = graph.calls.equal_range(caller);
    for (auto call = begin; call != end; ++call) {
      const CallGraph::Callee& callee = call->second;
      if (const StageFunction* stage = stage_function(callee.name)) {
        stages[std::string(stage->stage)] += callee.instructions;
        found.insert(stage->function);
      } else if (seen.insert(callee.name).second) {
        pending.push_back(callee.name);
      }
    }
  }
}

[[noreturn]] void fail_for_inlined(double share, const std::set<std::string_view>& found) {
  std::string missing;
  for (const StageFunction& f : stage_functions)
    if (!found.contains(f.function)) missing.append(missing.empty() ? "" : ", ").append(f.function);
  throw InputError("the stages do not add up to the whole: " + std::to_string(static_cast<int>(100 * share)) +
                       "% of the instructions of mesh_plc are outside of them; not called: " + missing,
                   {}, "build the program without -flto, so that no stage is inlined into its caller");
}

}  // namespace

StageInstructions stage_instructions(std::string_view profile) {
  const CallGraph graph = read_callgrind(profile);
  StageInstructions stages;
  for (const StageFunction& f : stage_functions) stages[std::string(f.stage)] = 0;
  std::set<std::string_view> found;
  add_stages(graph, stages, found);
  std::uint64_t sum = 0;
  for (const auto& [stage, instructions] : stages) sum += instructions;

  const std::uint64_t mesh = inclusive_instructions(graph, whole);
  if (mesh == 0)
    throw InputError("the function ccdt::mesh_plc is not in the profile", {},
                     "build the program without -flto, do not strip it, and let it mesh with --mesher ccdt");
  const double rest = static_cast<double>(mesh) - static_cast<double>(sum);
  const double share = rest / static_cast<double>(mesh);
  if (share < 0 || share > largest_rest) fail_for_inlined(share, found);
  stages["mesh"] = mesh;
  stages["rest"] = mesh - sum;
  stages["remesh"] = inclusive_instructions(graph, remesh);
  return stages;
}

}  // namespace ccdt::gate
