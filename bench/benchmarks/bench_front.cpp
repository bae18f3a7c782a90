// What is measured: advance_front, from the facets, the Delaunay tetrahedralization of all vertices and the outcome of
// the face protection check to the tetrahedra of the front; making the locator is included.
//
//   front/grid/...     vertices and faces nearby are found in uniform grids
//   front/octree/...   ... in octrees
//   front/cavity/...   ... among the Delaunay cells that the missing faces pierce
//
//   .../check/...      only faces that are not Delaunay go through the front
//   .../no_check/...   every face does (the paper's ablation); larger sizes are left out, as these take long
//
//   .../MODEL/N        with the interior points of the fcc lattice; the mesh has about N vertices
//   .../flat-MODEL/N   the same, but z scaled by 0.3; edges and faces are missing then
//   .../FILE           a file given by --input
//
// "vertices" and "cells" are those of the finished mesh in both modes, so that these can be compared, although
// with the check, the front meets only a few of them. "front_cells" are the front's own, "undelaunay" the faces that
// have been in the front. The time with the check depends on these faces, so Google Benchmark chooses the complexity
// that fits best. Before anything is timed, front and labeled cells together must be the same tetrahedra that the grid
// with the check finds.

#include <optional>

#include "bench/benchmarks/benchmark_main.h"
#include "engine/label/label_cells.h"
#include "engine/mesh/assemble_mesh.h"

namespace ccdt::benchmarks {
namespace {

struct Strategy {
  locate::LocatorKind locator;
  bool check;
};

/// The codes that `mesh_plc` passes to the front.
std::vector<std::uint32_t> codes_for(const Stages& s, bool check) {
  return check ? s.codes : std::vector<std::uint32_t>(s.codes.size(), delaunay::no_neighbor);
}

front::FrontResult advance(const Stages& s, Strategy strategy, const std::vector<std::uint32_t>& codes) {
  return front::advance_front({s.plc, s.facets, codes, s.delaunay},
                              {.locator = strategy.locator, .face_protection = strategy.check});
}

std::string find_fault(const Stages& s, Strategy strategy) {
  const auto codes = codes_for(s, strategy.check);
  const front::FrontResult front = advance(s, strategy, codes);
  const auto regions = label::label_cells(s.plc, s.delaunay, front.open, codes);
  if (sorted(mesh::collect_tetrahedra(s.plc, front, regions, s.delaunay.cells, s.delaunay.vertices.size())
                 .mesh.tetrahedra) != s.tetrahedra)
    return "the tetrahedra are not those of the grid with the check";
  return {};
}

void measure(benchmark::State& state, const Stages& s, Strategy strategy) {
  const auto codes = codes_for(s, strategy.check);
  std::optional<front::FrontResult> front;
  for (auto _ : state) {
    front.emplace(advance(s, strategy, codes));
    state.PauseTiming();
    set_count(state, "front_cells", front->tetrahedra.size());
    set_count(state, "undelaunay", front->undelaunay_faces);
    front.reset();
    state.ResumeTiming();
  }
  set_counters(state, s.delaunay.vertices.size(), s.tetrahedra.size());
}

}  // namespace

void add_benchmarks(const Files& files) {
  for (const locate::LocatorKind locator :
       {locate::LocatorKind::grid, locate::LocatorKind::octree, locate::LocatorKind::cavity})
    for (const Strategy strategy : {Strategy{locator, true}, Strategy{locator, false}})
      add_stage({.name = "front/" + std::string(name_of(locator)) + (strategy.check ? "/check" : "/no_check"),
                 .complexity = strategy.check ? benchmark::oAuto : benchmark::oN,
                 .largest = strategy.check ? model_sizes.back() : 40000,
                 .flattened_too = true,
                 .find_fault = [=](const Stages& s) { return find_fault(s, strategy); },
                 .measure = [=](benchmark::State& state, const Stages& s) { measure(state, s, strategy); }},
                files);
}

}  // namespace ccdt::benchmarks
