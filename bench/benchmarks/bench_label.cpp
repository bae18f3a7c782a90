// What is measured: label_cells and collect_tetrahedra, from the Delaunay tetrahedralization of all vertices and the
// finished front to the tetrahedra of the mesh.
//
//   label/MODEL/N   with the interior points of the fcc lattice; the mesh has about N vertices
//   label/FILE      a file given by --input
//
// "vertices" and "cells" are those of the mesh. Before anything is timed, the tetrahedra must fill the volume that the
// facets enclose.

#include <cmath>

#include "bench/benchmarks/benchmark_main.h"
#include "engine/label/label_cells.h"
#include "engine/mesh/assemble_mesh.h"

namespace ccdt::benchmarks {
namespace {

mesh::TetMesh label(const Stages& s) {
  const auto regions = label::label_cells(s.plc, s.delaunay, s.front.open, s.codes);
  return mesh::collect_tetrahedra(s.plc, s.front, regions, s.delaunay.cells, s.delaunay.vertices.size()).mesh;
}

/// The volume by the divergence theorem, from the triangles of the input.
double enclosed_volume(const plc::Plc& plc) {
  double volume = 0;
  for (const plc::Facet& facet : plc.facets) {
    const int outward = (plc.regions[facet.below].inside ? 1 : 0) - (plc.regions[facet.above].inside ? 1 : 0);
    if (outward == 0) continue;
    for (const auto& [a, b, c] : plc.triangles_of(facet))
      volume += outward * dot(plc.vertices[a], cross(plc.vertices[b], plc.vertices[c]));
  }
  return volume / 6;
}

std::string find_fault(const Stages& s) {
  const double filled = volume_of(label(s).tetrahedra, points_of(s.delaunay)), wanted = enclosed_volume(s.plc);
  if (std::fabs(filled - wanted) > 1e-7 * std::fabs(wanted))
    return "the cells fill " + std::to_string(filled / wanted) + " of the volume";
  return {};
}

void measure(benchmark::State& state, const Stages& s) {
  time_runs(state, [&] { return label(s); });
  set_counters(state, s.delaunay.vertices.size(), s.tetrahedra.size());
}

}  // namespace

void add_benchmarks(const Files& files) {
  add_stage({.name = "label", .find_fault = find_fault, .measure = measure}, files);
}

}  // namespace ccdt::benchmarks
