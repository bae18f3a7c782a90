// What is measured: improve_mesh, from the constrained Delaunay tetrahedralization, complete except for coordinates,
// to the improved mesh; all boundary vertices stay. Making and undoing the structure that is improved is included.
//
//   improve/swap/...     edges and faces are removed
//   improve/smooth/...   interior vertices move
//   improve/all/...      both, and interior vertices come and go
//
//   .../MODEL/N        with the interior points of the fcc lattice; the mesh has about N vertices
//   .../flat-MODEL/N   the same, but z scaled by 0.3: surface triangles make the targets unreachable for many cells,
//                      so everything is tried
//   .../FILE           a file given by --input
//
// "vertices" and "cells" are those of the mesh before; "bad" are its cells that are not good enough, "bad_left" those
// afterwards. There may be more of them: moving vertices spreads the error that cannot be removed over several cells,
// because only the worst cell counts. Before anything is timed, the improved mesh is checked: all cells are positive,
// the worst is no worse than before, and together they fill the same volume.

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "bench/benchmarks/benchmark_main.h"
#include "engine/geometry/predicates.h"
#include "engine/improve/improve_mesh.h"
#include "engine/label/label_cells.h"
#include "engine/mesh/assemble_mesh.h"
#include "engine/tets/cell_complex.h"

namespace ccdt::benchmarks {
namespace {

/// The data that `improve_mesh` gets and changes.
struct Unimproved {
  mesh::TetMesh mesh;
  LargeVector<delaunay::Cell> cells;
  std::vector<std::uint32_t> facet_of_face;
  std::vector<Point3> points;
  protection::SegmentChains chains;
};

const Unimproved& unimproved(const Stages& s) {
  static std::map<const Stages*, Unimproved> made;
  const auto [at, is_new] = made.try_emplace(&s);
  Unimproved& u = at->second;
  if (is_new) {
    u.points = points_of(s.delaunay);
    const auto regions = label::label_cells(s.plc, s.delaunay, s.front.open, s.codes);
    mesh::CollectedMesh collected =
        mesh::collect_tetrahedra(s.plc, s.front, regions, s.delaunay.cells, s.delaunay.vertices.size());
    u.facet_of_face = mesh::finish_mesh(s.plc, s.chains, u.points, s.facets, collected);
    u.cells = mesh::join_tetrahedra(collected.mesh, std::move(collected.sources), s.delaunay.cells);
    u.mesh = std::move(collected.mesh);
    u.chains = s.chains;
  }
  return u;
}

improve::ImproveOptions options_of(improve::Improvement improvement) {
  improve::ImproveOptions options;
  options.improvement = improvement;
  options.steiner = improve::SteinerRule::keep;  // the same mesh for each kind of improvement
  return options;
}

improve::ImproveCounts improve(const Stages& s, improve::Improvement improvement, Unimproved& u) {
  return improve::improve_mesh(
      {s.plc, u.chains, std::move(u.cells), std::move(u.facet_of_face), s.plc.vertices.size(), s.first_interior},
      options_of(improvement), u.points, u.mesh);
}

/// The quality of the worst cell; not positive if a cell is not.
double least_quality(const Unimproved& u) {
  const tets::QualityGoal goal = improve::goal_of({});
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [a, b, c, d] : u.mesh.tetrahedra) {
    const auto& at = u.points;
    if (orient3d(at[a], at[b], at[c], at[d]) <= 0) return 0;
    least = std::min(least, tets::cell_quality(goal, at[a], at[b], at[c], at[d]));
  }
  return least;
}

std::string find_fault(const Stages& s, improve::Improvement improvement) {
  const Unimproved& before = unimproved(s);
  Unimproved after = before;
  improve(s, improvement, after);
  const double least = least_quality(after), volume = volume_of(before.mesh.tetrahedra, before.points);
  if (!(least > 0)) return "a cell is not positive";
  if (least < least_quality(before)) return "the worst cell is worse than before";
  if (std::fabs(volume_of(after.mesh.tetrahedra, after.points) - volume) > 1e-9 * volume)
    return "the volume has changed";
  return {};
}

void measure(benchmark::State& state, const Stages& s, improve::Improvement improvement) {
  const Unimproved& before = unimproved(s);
  improve::ImproveCounts counts;
  for (auto _ : state) {
    state.PauseTiming();
    auto mesh = std::make_optional(before);
    state.ResumeTiming();
    counts = improve(s, improvement, *mesh);
    state.PauseTiming();
    mesh.reset();
    state.ResumeTiming();
  }
  set_count(state, "bad", counts.bad_cells);
  set_count(state, "bad_left", counts.bad_cells_left);
  set_counters(state, before.points.size(), before.mesh.tetrahedra.size());
}

}  // namespace

void add_benchmarks(const Files& files) {
  for (const improve::Improvement strategy :
       {improve::Improvement::swap, improve::Improvement::smooth, improve::Improvement::all})
    add_stage({.name = "improve/" + std::string(name_of(strategy)),
               .flattened_too = true,
               .find_fault = [=](const Stages& s) { return find_fault(s, strategy); },
               .measure = [=](benchmark::State& state, const Stages& s) { measure(state, s, strategy); }},
              files);
}

}  // namespace ccdt::benchmarks
