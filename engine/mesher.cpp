#include "engine/mesher.h"

#include <algorithm>

#include "engine/base/stopwatch.h"
#include "engine/delaunay/delaunay.h"
#include "engine/delaunay/wrap_delaunay.h"
#include "engine/facets/facet_mesh.h"
#include "engine/front/advance_front.h"
#include "engine/front/face_check.h"
#include "engine/improve/improve_mesh.h"
#include "engine/label/label_cells.h"
#include "engine/lattice/place_lattice_points.h"
#include "engine/mesh/assemble_mesh.h"
#include "engine/mesh/to_world.h"
#include "engine/plc/build_plc.h"
#include "engine/protection/insert_interior.h"
#include "engine/protection/protect_edges.h"

namespace ccdt {
namespace {

/// The state of one meshing, from the PLC to the mesh.
struct Work {
  const Plc& plc;
  const MeshOptions& options;
  const Progress& progress;
  std::vector<bool> must_be_chain;  ///< by segment
  Delaunay delaunay;
  SegmentChains chains;
  FacetMesh facets;
  MeshCounts& counts;
  StageSeconds& seconds;
};

/// Protection works on a tetrahedralization that grows by one vertex at a time, so this one is made by insertion
/// whatever the method is. With another method it is there for the sake of protection alone.
void tetrahedralize_input(Work& w) {
  const bool stays = w.options.delaunay == DelaunayMethod::insert;
  const Stopwatch watch(stays ? w.seconds.delaunay : w.seconds.protect);
  w.delaunay = build_delaunay(w.plc.vertices, w.progress);
}

void protect(Work& w) {
  const Stopwatch watch(w.seconds.protect);
  w.chains = bare_chains(w.plc);
  w.counts.steiner_vertices =
      protect_edges(w.plc, w.must_be_chain, w.options.protection, w.delaunay, w.chains, w.progress);
  w.counts.splits_by_level = count_splits_by_level(w.chains);
}

void triangulate(Work& w) {
  const Stopwatch watch(w.seconds.facets);
  w.facets = triangulate_facets(w.plc, w.chains, w.delaunay, w.progress);
}

BackgroundSizes in_grid_units(BackgroundSizes background, const DyadicGrid& grid) {
  for (Point3& p : background.vertices) p = (1 / grid.unit) * (p - grid.origin);
  for (double& size : background.sizes) size /= grid.unit;
  return background;
}

std::vector<Point3> points_of(const Delaunay& delaunay) {
  std::vector<Point3> points;
  points.reserve(delaunay.vertices.size());
  for (const DelaunayVertex& v : delaunay.vertices) points.push_back(v.point);
  return points;
}

/// The faces and subsegments that the lattice keeps away from.
std::vector<Point3> lattice_points(const Work& w) {
  std::vector<SurfaceTriangle> triangles;
  for (std::size_t i = 0; i < w.facets.triangles.size(); ++i) {
    const Facet& facet = w.plc.facets[w.facets.facet[i]];
    triangles.push_back({w.facets.triangles[i], w.plc.regions[facet.above].inside, w.plc.regions[facet.below].inside});
  }
  std::vector<std::array<VertexId, 2>> subsegments;
  for (const auto& chain : w.chains)
    for (std::size_t i = 0; i + 1 < chain.size(); ++i) subsegments.push_back({chain[i].vertex, chain[i + 1].vertex});
  const BackgroundSizes background = in_grid_units(w.options.background, w.plc.grid);
  const LatticeOptions options{w.options.lattice,   w.options.edge_length / w.plc.grid.unit,
                               w.options.grading,   w.options.sphere_factor,
                               w.options.clearance, &background};
  return place_lattice_points(points_of(w.delaunay), triangles, subsegments, options, w.progress);
}

void fill_inside(Work& w) {
  std::vector<Point3> points;
  if (w.options.lattice != Lattice::none) {
    const Stopwatch watch(w.seconds.lattice);
    points = lattice_points(w);
  }
  const Stopwatch watch(w.seconds.delaunay);
  w.counts.interior_vertices =
      w.options.delaunay == DelaunayMethod::insert
          ? insert_interior(points, w.must_be_chain, w.chains, w.delaunay, w.progress)
          : wrap_interior(points, w.must_be_chain, w.chains, w.options.grid_scale, w.delaunay, w.progress);
  w.counts.dropped_interior_vertices = points.size() - w.counts.interior_vertices;
}

/// The codes of the faces that are Delaunay; none of them is told apart when the check is off.
std::vector<std::uint32_t> check_faces(Work& w) {
  const Stopwatch watch(w.seconds.face_check);
  std::vector<std::uint32_t> codes = find_delaunay_faces(w.facets, w.delaunay);
  if (w.counts.interior_vertices > 0 && follow_interior_vertices(w.plc, w.chains, w.delaunay, codes, w.facets))
    codes = find_delaunay_faces(w.facets, w.delaunay);
  w.counts.faces = w.facets.triangles.size();
  w.counts.undelaunay_faces = static_cast<std::uint64_t>(std::ranges::count(codes, no_neighbor));
  if (!w.options.face_protection) std::ranges::fill(codes, no_neighbor);
  return codes;
}

/// Makes a whole mesh of the tetrahedra, and a good one.
TetMesh complete(Work& w, TetMesh mesh) {
  std::vector<std::uint32_t> facet_of_face;
  {
    const Stopwatch watch(w.seconds.finish);
    facet_of_face = finish_mesh(w.plc, w.chains, std::move(w.facets), w.delaunay, mesh);
  }
  std::vector<Point3> points = points_of(w.delaunay);
  if (w.options.improve.improvement != Improvement::none) {
    const Stopwatch watch(w.seconds.improve);
    const std::size_t first_interior = points.size() - w.counts.interior_vertices;
    w.counts.improve = improve_mesh(w.plc, w.chains, std::move(facet_of_face), first_interior, w.options.improve,
                                    points, mesh, w.progress);
    w.counts.interior_vertices = points.size() - first_interior;
  }
  const Stopwatch watch(w.seconds.finish);
  mesh.vertices = to_world(w.plc, points, mesh.tetrahedra);
  return mesh;
}

TetMesh constrain(Work& w) {
  const std::vector<std::uint32_t> codes = check_faces(w);
  FrontResult front;
  {
    const Stopwatch watch(w.seconds.front);
    front = advance_front(w.plc, w.facets, codes, w.options.face_protection, w.delaunay,
                          {w.options.locator, w.options.grid_scale}, w.progress);
    w.counts.front_tetrahedra = front.tetrahedra.size();
    w.counts.front_faces = front.undelaunay_faces;
  }
  TetMesh mesh;
  {
    const Stopwatch watch(w.seconds.label);
    const std::vector<RegionId> regions = label_cells(w.plc, w.delaunay, front.open, codes);
    mesh = collect_tetrahedra(w.plc, front, regions, w.delaunay);
  }
  return complete(w, std::move(mesh));
}

TetMesh mesh_with(Work& w) {
  tetrahedralize_input(w);
  protect(w);
  triangulate(w);
  fill_inside(w);
  return constrain(w);
}

}  // namespace

MeshResult mesh_plc(const InputPlc& input, const MeshOptions& options, const Progress& progress) {
  MeshResult result;
  StageSeconds& s = result.seconds;
  const auto attempt = [&](double flatness) {
    Plc plc;
    {
      const Stopwatch watch(s.plc);
      plc = build_plc(input, {flatness}, progress);
    }
    result.largest_rounding = plc.largest_rounding;
    Work work{plc, options, progress, grazeable_segments(plc), {}, {}, {}, result.counts, s};
    result.mesh = mesh_with(work);
  };
  try {
    attempt(options.flatness);
  } catch (const FrontStuck&) {
    // Only a facet that is flat within the tolerance, but not exactly, can do that: the theorem on protected edges
    // speaks of exact facets. Taken as it is, the surface costs more Steiner vertices, but then its tetrahedralization
    // exists.
    if (options.flatness == 0) throw;
    result.counts = {};
    attempt(0);
  }
  result.counts.vertices = result.mesh.vertices.size();
  result.counts.tetrahedra = result.mesh.tetrahedra.size();
  s.mesh =
      s.plc + s.protect + s.facets + s.lattice + s.delaunay + s.face_check + s.front + s.label + s.finish + s.improve;
  return result;
}

}  // namespace ccdt
