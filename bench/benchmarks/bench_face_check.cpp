// What is measured: find_delaunay_faces, the paper's face protection check: from the triangulated facets and the
// Delaunay tetrahedralization of all vertices to the place of every triangle in it.
//
//   face_check/MODEL/N        with the interior points of the fcc lattice; the mesh has about N vertices
//   face_check/flat-MODEL/N   the same, but z scaled by 0.3; edges and faces are missing then
//   face_check/FILE           a file given by --input
//
// "vertices" and "cells" are those of the tetrahedralization, "faces" the triangles looked up, "undelaunay" those that
// are not in it. Before anything is timed, the answers are compared with a sorted list of all faces of all cells.

#include <algorithm>
#include <array>

#include "bench/benchmarks/benchmark_main.h"
#include "engine/front/find_delaunay_faces.h"

namespace ccdt::benchmarks {
namespace {

using Triple = std::array<std::uint32_t, 3>;

Triple sorted_triple(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  Triple triple = {a, b, c};
  std::ranges::sort(triple);
  return triple;
}

std::vector<Triple> all_faces(const delaunay::Delaunay& delaunay) {
  std::vector<Triple> faces;
  for (const auto& v : finite_cells(delaunay))
    for (const auto& corners : delaunay::face_corners)
      faces.push_back(sorted_triple(v[corners[0]], v[corners[1]], v[corners[2]]));
  std::ranges::sort(faces);
  return faces;
}

std::string find_fault(const Stages& s) {
  const std::vector<std::uint32_t> codes = front::find_delaunay_faces(s.facets.triangles, s.delaunay);
  const std::vector<Triple> faces = all_faces(s.delaunay);
  for (std::size_t i = 0; i < codes.size(); ++i) {
    const auto& [a, b, c] = s.facets.triangles[i];
    if (std::ranges::binary_search(faces, sorted_triple(a, b, c)) != (codes[i] != delaunay::no_neighbor))
      return "triangle " + std::to_string(i) + " of the facets is judged wrongly";
  }
  return {};
}

void measure(benchmark::State& state, const Stages& s) {
  time_runs(state, [&] { return front::find_delaunay_faces(s.facets.triangles, s.delaunay); });
  set_counters(state, s.delaunay.vertices.size(), finite_cells(s.delaunay).size());
  set_count(state, "faces", s.codes.size());
  set_count(state, "undelaunay", static_cast<std::size_t>(std::ranges::count(s.codes, delaunay::no_neighbor)));
}

}  // namespace

void add_benchmarks(const Files& files) {
  add_stage({.name = "face_check", .flattened_too = true, .find_fault = find_fault, .measure = measure}, files);
}

}  // namespace ccdt::benchmarks
