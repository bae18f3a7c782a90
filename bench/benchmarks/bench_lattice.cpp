// What is measured: place_lattice_points, from the surface (vertices, triangles, protected subsegments) in memory to
// the array of interior points; the octree and the tests of distance to the surface are included.
//
//   lattice/fcc/...   face-centered cubic
//   lattice/bcc/...   body-centered cubic
//   lattice/sc/...    simple cubic; all three at equal density
//
//   .../MODEL/N   one edge length inside and on the surface, such that the mesh has about N vertices with fcc
//   .../FILE      a file given by --input, with edges that grow away from the surface
//
// "vertices" are the points placed ("triangles" those of the surface); there are no cells yet. Before anything is
// timed, the points must be pairwise different, and about as many as with fcc: within a fifth where there are a
// thousand or more.

#include <algorithm>
#include <cmath>
#include <tuple>

#include "bench/benchmarks/benchmark_main.h"

namespace ccdt::benchmarks {
namespace {

std::vector<Point3> place(const LatticeInput& input, lattice::Lattice kind) {
  lattice::LatticeOptions options = input.options;
  options.kind = kind;
  return lattice::place_lattice_points({input.vertices, input.triangles, input.subsegments}, options).points;
}

std::string find_fault(const Stages& s, lattice::Lattice kind) {
  std::vector<Point3> points = place(s.lattice, kind);
  if (points.empty()) return "no lattice point fits inside: the edges of the surface are too long";
  const auto as_tuple = [](const Point3& p) { return std::tie(p.x, p.y, p.z); };
  std::ranges::sort(points, {}, as_tuple);
  if (std::ranges::adjacent_find(points, {}, as_tuple) != points.end()) return "two lattice points are the same";
  const auto count = static_cast<double>(points.size());
  const auto fcc = static_cast<double>(place(s.lattice, lattice::Lattice::fcc).size());
  if (fcc >= 1000 && std::fabs(count - fcc) > 0.2 * fcc)
    return std::to_string(points.size()) + " points, but fcc places " + std::to_string(fcc);
  return {};
}

void measure(benchmark::State& state, const Stages& s, lattice::Lattice kind) {
  time_runs(state, [&] { return place(s.lattice, kind); });
  set_counters(state, place(s.lattice, kind).size(), 0);
  set_count(state, "triangles", s.lattice.triangles.size());
}

}  // namespace

void add_benchmarks(const Files& files) {
  for (const lattice::Lattice strategy : {lattice::Lattice::fcc, lattice::Lattice::bcc, lattice::Lattice::sc})
    add_stage({.name = "lattice/" + std::string(name_of(strategy)),
               .find_fault = [=](const Stages& s) { return find_fault(s, strategy); },
               .measure = [=](benchmark::State& state, const Stages& s) { measure(state, s, strategy); }},
              files);
}

}  // namespace ccdt::benchmarks
