// What is measured: protect_edges, from the Delaunay tetrahedralization of the input's vertices to the one in which
// every grazeable segment is a chain of edges; the copy of the tetrahedralization that it changes is made outside.
//
//   protection/shell/...      splits at the foot of the encroaching vertex, or on spheres around common ends
//   protection/midpoint/...   the paper's bisection
//
//   .../MODEL/N        the surface whose mesh has about N vertices
//   .../flat-MODEL/N   the same, but z scaled by 0.3; edges and faces are missing then
//   .../FILE           a file given by --input
//
// "vertices" and "cells" are those of the resulting tetrahedralization, which has no interior vertices yet;
// "segments" counts the grazeable ones, "steiner" the vertices put on them. Most vertices are on no segment, so the
// time is not linear in their number, and Google Benchmark chooses the complexity that fits best. Before anything is
// timed, all pieces of all grazeable segments must be edges of the result.

#include <algorithm>
#include <utility>

#include "bench/benchmarks/benchmark_main.h"
#include "engine/delaunay/delaunay.h"
#include "engine/protection/protect_edges.h"

namespace ccdt::benchmarks {
namespace {

std::string find_fault(const Stages& s, protection::Protection strategy) {
  const protection::ProtectedDelaunay result =
      protection::protect_edges(s.plc, protection::unprotected(s.plc, s.input_delaunay), strategy);
  for (std::size_t segment = 0; segment < result.chains.size(); ++segment) {
    if (!result.must_be_chain[segment]) continue;
    const auto chain = result.chains[segment];
    for (std::size_t i = 0; i + 1 < chain.size(); ++i)
      if (!has_edge(result.delaunay, chain[i].vertex, chain[i + 1].vertex))
        return "segment " + std::to_string(segment) + " is not protected";
  }
  return {};
}

void measure(benchmark::State& state, const Stages& s, protection::Protection strategy) {
  protection::ProtectedDelaunay changed;
  for (auto _ : state) {
    state.PauseTiming();
    changed = {};  // its memory is reused, as in a run of the mesher
    changed = protection::unprotected(s.plc, s.input_delaunay);
    state.ResumeTiming();
    changed = protection::protect_edges(s.plc, std::move(changed), strategy);
  }
  set_counters(state, changed.delaunay.vertices.size(), finite_cells(changed.delaunay).size());
  set_count(state, "segments", static_cast<std::size_t>(std::ranges::count(changed.must_be_chain, true)));
  set_count(state, "steiner", changed.delaunay.vertices.size() - s.input_delaunay.vertices.size());
}

}  // namespace

void add_benchmarks(const Files& files) {
  for (const protection::Protection strategy : {protection::Protection::shell, protection::Protection::midpoint})
    add_stage({.name = "protection/" + std::string(name_of(strategy)),
               .complexity = benchmark::oAuto,
               .flattened_too = true,
               .find_fault = [=](const Stages& s) { return find_fault(s, strategy); },
               .measure = [=](benchmark::State& state, const Stages& s) { measure(state, s, strategy); }},
              files);
}

}  // namespace ccdt::benchmarks
