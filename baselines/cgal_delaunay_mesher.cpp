#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>
#include <CGAL/version.h>

#include <chrono>
#include <utility>

#include "baselines/known_meshers.h"
#include "baselines/mesh_cleanup.h"
#include "baselines/mesher_input.h"
#include "engine/io/files.h"

namespace ccdt::baselines {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_3<std::uint32_t, Kernel>;
using DataStructure =
    CGAL::Triangulation_data_structure_3<VertexBase, CGAL::Delaunay_triangulation_cell_base_3<Kernel>>;
using Triangulation = CGAL::Delaunay_triangulation_3<Kernel, DataStructure>;

MesherSettings settings_of_cgal_delaunay(const InputPlc& /*input*/, const MeshOptions& /*options*/) {
  return {{"kernel", "Exact_predicates_inexact_constructions_kernel"}, {"order", "Hilbert curve (median)"}};
}

MesherRun run_cgal_delaunay(const InputPlc& input, const MeshOptions& options, const Progress& progress) {
  const InputPlc merged = merge_equal_vertices(input);
  std::vector<std::pair<Kernel::Point_3, std::uint32_t>> points;
  points.reserve(merged.vertices.size());
  for (const Point3& p : merged.vertices)
    points.emplace_back(Kernel::Point_3(p.x, p.y, p.z), static_cast<std::uint32_t>(points.size()));

  report(progress, "delaunay", 0, 0);
  const auto begin = std::chrono::steady_clock::now();
  Triangulation triangulation(points.begin(), points.end());  // sorts along a Hilbert curve itself
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();

  MesherRun run;
  run.result.costs[Stage::delaunay].seconds = run.result.costs.mesh_seconds = seconds;
  run.settings = settings_of_cgal_delaunay(input, options);
  run.notes = {"the Delaunay tetrahedralization of the vertices fills their convex hull and ignores facets"};
  TetMesh& mesh = run.result.mesh;
  mesh.vertices = merged.vertices;
  mesh.tetrahedra.reserve(triangulation.number_of_finite_cells());
  for (const auto cell : triangulation.finite_cell_handles())
    mesh.tetrahedra.push_back(
        {cell->vertex(0)->info(), cell->vertex(1)->info(), cell->vertex(2)->info(), cell->vertex(3)->info()});
  mesh.regions.assign(mesh.tetrahedra.size(), 0);
  if (mesh.tetrahedra.empty())
    throw MeshError("all vertices are in one plane, so there are no tetrahedra", io::place_in(input.name),
                    "give a solid");
  run.result.counts = count_elements(merged, mesh);
  return run;
}

}  // namespace

Mesher cgal_delaunay_mesher() {
  return {.name = "cgal-delaunay",
          .version = CGAL_VERSION_STR,
          .what = "CGAL Delaunay_triangulation_3 of the vertices alone (their convex hull)",
          .license = "GPL-3.0-or-later",
          .run = run_cgal_delaunay,
          .settings = settings_of_cgal_delaunay,
          .keeps_surface = false};
}

}  // namespace ccdt::baselines
