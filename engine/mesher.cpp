#include "engine/mesher.h"

#include <string>
#include <utility>

#include "engine/base/errors.h"
#include "engine/base/parallel.h"
#include "engine/folds/protect_facets.h"
#include "engine/mesh/assemble_mesh.h"
#include "engine/mesh/check_sides.h"
#include "engine/mesh/collect_tetrahedra.h"
#include "engine/options/check_options.h"
#include "engine/plc/check_input.h"
#include "engine/plc/gather_parts.h"
#include "engine/steps/fill_domain.h"
#include "engine/steps/improve_mesh.h"
#include "engine/steps/make_plc.h"
#include "engine/steps/protect_domain.h"
#include "engine/steps/reach_count.h"
#include "engine/surface/prepare_surface.h"

namespace ccdt {
namespace {

using steps::ProtectedDomain, steps::Run, steps::Tetrahedralization;

/// All stages from an input to its constrained Delaunay tetrahedralization. If nearly flat facets are in the way,
/// meshing starts again from the vertices of the PLC, with their folds protected. A refined surface has too many folds
/// for that, so there it starts again before refinement, with flat facets.
///
/// \param domain  gets everything but its tetrahedra
Tetrahedralization tetrahedralize(const InputPlc& input, bool flattens, ProtectedDomain& domain, Run& run) {
  const bool refines = run.options.surface == SurfaceRule::refine;
  steps::TetrahedralizedPlc start = steps::make_plc(input, flattens, run);
  domain.plc = std::move(start.plc);
  folds::SurfaceProtector protector(domain.plc, std::move(start.delaunay), std::move(start.chains),
                                    plc::tolerance_of(domain.plc, run.options.flatness), run.options.protection);
  for (;;) {
    try {
      steps::protect_domain(protector, domain, run);
      return steps::fill_domain(domain, run);
    } catch (const MeshError&) {
      if (!protector.protect_folds()) throw;
      if (refines) break;
    }
  }
  return tetrahedralize(input, true, domain, run);
}

/// The vertices, regions and counts of the mesh, in the units of the input.
MeshResult finish(const ProtectedDomain& domain, Tetrahedralization t, Run& run) {
  const plc::Plc& plc = domain.plc;
  mesh::check_sides(plc, t.points, t.mesh.faces);
  mesh::drop_foreign_edges(plc, domain.chains, t.mesh);
  t.mesh.vertices = run.measured(Stage::finish, [&] { return mesh::to_world(plc, t.points, t.mesh.tetrahedra); });
  if (const auto attribute = mesh::common_attribute(plc.regions))
    t.mesh.regions.assign(t.mesh.tetrahedra.size(), *attribute);
  run.counts.vertices = t.mesh.vertices.size();
  run.counts.tetrahedra = t.mesh.tetrahedra.size();
  check_count(run.counts.tetrahedra, run.options.most_tetrahedra);
  for (const StageCost& cost : run.costs.stages) run.costs.mesh_seconds += cost.seconds;
  run.costs.mesh_seconds -= run.costs[Stage::remesh].seconds;
  return {std::move(t.mesh), std::move(run.counts), run.costs, plc.largest_rounding, plc.idle_holes.size()};
}

MeshResult mesh_on_threads(const InputPlc& input, const MeshOptions& options, const Progress& progress) {
  const surface::PreparedSurface surface =
      surface::prepare_surface(input, options.surface, remesh_options_of(options), progress);
  Run run{options, progress, surface.costs};
  run.options.edge_length = surface.edge_length;
  ProtectedDomain domain;
  Tetrahedralization t = tetrahedralize(surface.changed ? *surface.changed : input, false, domain, run);
  t.mesh.face_names = input.marker_names;
  steps::improve_mesh(domain, t, run);
  return finish(domain, std::move(t), run);
}

/// Is so little to do that other threads would begin when all is done? Nothing asks for shorter edges than those of a
/// small surface.
bool is_tiny(const InputPlc& input, const MeshOptions& options) {
  constexpr std::size_t few_vertices = 100;
  const bool has_sizes = options.edge_length > 0 || options.tetrahedra > 0 || !options.background.empty() ||
                         !options.local.empty() || !input.regions.empty();
  return input.vertices.size() <= few_vertices && !has_sizes && options.surface == SurfaceRule::keep &&
         options.lattice != Lattice::refinement;
}

}  // namespace

Improvement improvement_of(const MeshOptions& options) {
  return options.improve.improvement.value_or(options.lattice == Lattice::none ? Improvement::none : Improvement::all);
}

void check_count(std::uint64_t tetrahedra, double most) {
  if (most > 0 && static_cast<double>(tetrahedra) > most)
    throw LimitError("the mesh has " + std::to_string(tetrahedra) + " tetrahedra, more than allowed", {},
                     "give longer edges, or allow more tetrahedra");
}

unsigned number_of_threads(const MeshOptions& options) {
  return options.threads == 0 ? thread_backend::core_count() : options.threads;
}

MeshResult mesh_plc(const InputPlc& input, const MeshOptions& options, const Progress& progress) {
  return with_file_in_errors(input.name, [&] {
    plc::check_input(input);
    options::check_options(options);
    const unsigned threads = options.threads == 0 && is_tiny(input, options) ? 1 : options.threads;
    return with_threads(threads, [&] {
      if (options.tetrahedra == 0) return mesh_on_threads(input, options, progress);
      return steps::reach_count(
          options.tetrahedra,
          [&](double factor) { return mesh_on_threads(input, steps::scaled(options, factor), progress); },
          [](const MeshResult& result) { return result.mesh.tetrahedra.size(); }, input.name);
    });
  });
}

}  // namespace ccdt
