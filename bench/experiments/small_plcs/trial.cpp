#include "bench/experiments/small_plcs/trial.h"

#include <algorithm>
#include <map>

#include "engine/base/errors.h"
#include "engine/mesher.h"

namespace ccdt::small {
namespace {

std::vector<Tetrahedron> in_vertices_of(const SmallPlc& plc, const TetMesh& mesh) {
  std::map<std::array<double, 3>, Vertex> vertex_at;
  const InputPlc input = as_input(plc);
  for (Vertex v = 0; v < input.vertices.size(); ++v) vertex_at[as_array(input.vertices[v])] = v;
  std::vector<Tetrahedron> tetrahedra;
  for (const auto& corners : mesh.tetrahedra) {
    Tetrahedron t{};
    std::ranges::transform(corners, t.begin(), [&](auto v) { return vertex_at.at(as_array(mesh.vertices[v])); });
    std::ranges::sort(t);
    tetrahedra.push_back(t);
  }
  std::ranges::sort(tetrahedra);
  return tetrahedra;
}

std::string disagreement_of(const Trial& trial, bool is_cospherical) {
  if (!trial.engine.failure.empty()) return "the engine failed: " + trial.engine.failure;
  if (is_cospherical) {  // the engine's symbolic perturbation takes another PLC
    if (trial.protection.premise() && !trial.engine.is_protected) return "the engine misses what is strongly Delaunay";
    return {};
  }
  if (trial.search.constrained_delaunay > 1) return "there are several constrained Delaunay tetrahedralizations";
  if (trial.search.some_is_delaunay != trial.has_dt)
    return "the search and the Delaunay tetrahedra disagree about a DT";
  if (trial.engine.is_protected != trial.protection.premise())
    return "the engine and the brute-force tests disagree about protection";
  if (!trial.engine.has_steiner_vertices && trial.engine.tetrahedra != trial.search.first)
    return "the engine's mesh is not the constrained Delaunay tetrahedralization";
  return {};
}

}  // namespace

EngineAnswer ask_engine(const SmallPlc& plc) {
  MeshOptions options;
  options.lattice = Lattice::none;
  options.improve.improvement = Improvement::none;
  try {
    const MeshResult result = mesh_plc(as_input(plc), options);
    EngineAnswer answer{.has_steiner_vertices = result.counts.steiner_vertices > 0};
    answer.is_protected = !answer.has_steiner_vertices && result.counts.undelaunay_faces == 0;
    if (!answer.has_steiner_vertices) answer.tetrahedra = in_vertices_of(plc, result.mesh);
    return answer;
  } catch (const Error& error) {
    return {.failure = error.what()};
  }
}

Trial try_plc(SmallPlc plc, bool is_cospherical) {
  Trial trial{.plc = std::move(plc)};
  trial.protection = protection_of(trial.plc);
  trial.search = search_constrained_delaunay(trial.plc);
  trial.has_dt = is_cospherical ? trial.search.some_is_delaunay : has_delaunay_tetrahedralization(trial.plc);
  trial.engine = ask_engine(trial.plc);
  trial.disagreement = disagreement_of(trial, is_cospherical);
  return trial;
}

}  // namespace ccdt::small
