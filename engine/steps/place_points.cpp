#include "engine/steps/place_points.h"

#include <utility>
#include <vector>

#include "engine/base/parallel.h"
#include "engine/base/raw_vector.h"
#include "engine/cores/lattice_core.h"
#include "engine/lattice/place_circumcenters.h"
#include "engine/plc/edge_length_bounds.h"
#include "engine/protection/make_room.h"

namespace ccdt::steps {
namespace {

/// The points of the lattice, or of Delaunay refinement.
lattice::LatticePoints place_any(const plc::Plc& plc, const protection::ProtectedDelaunay& surface,
                                 const facets::FacetMesh& facets, const Run& run) {
  const MeshOptions& options = run.options;
  RawVector<lattice::SurfaceTriangle> triangles(facets.triangles.size());
  parallel_for(triangles.size(), 4096, [&](std::size_t i) {
    const plc::Facet& facet = plc.facets[facets.facet[i]];
    triangles[i] = {facets.triangles[i], plc.regions[facet.above].inside, plc.regions[facet.below].inside};
  });
  const std::vector<std::array<VertexId, 2>> subsegments = surface.chains.pieces();
  const lattice::LatticeOptions lattice{options.lattice,
                                        options.edge_length / plc.grid.unit,
                                        options.grading,
                                        options.sphere_factor,
                                        options.clearance,
                                        options.radius_edge,
                                        options.surface_factor,
                                        options.most_tetrahedra,
                                        &run.wanted};
  const std::vector<Point3> vertices = points_of(surface.delaunay);
  const lattice::DomainSurface domain{vertices, triangles, subsegments};
  if (options.lattice == Lattice::refinement)
    return lattice::place_circumcenters(domain, surface.delaunay, lattice, run.progress);
  return lattice::place_lattice_points(domain, lattice, run.progress);
}

/// An interior vertex has about 24 tetrahedra in a good mesh, one on the surface fewer than half of them.
///
/// \throw LimitError  the estimate exceeds the option by more than it is usually wrong
void check_number_of_tetrahedra(std::size_t on_surface, std::size_t inside, const Run& run) {
  constexpr double per_inner_vertex = 6.2, per_outer_vertex = 2.8, largest_error = 1.15;
  const double estimate =
      per_inner_vertex * static_cast<double>(inside) + per_outer_vertex * static_cast<double>(on_surface);
  report(run.progress, "estimate", static_cast<std::uint64_t>(estimate), 0);
  const double most = run.options.most_tetrahedra;
  if (most > 0 && estimate > largest_error * most) plc::throw_too_many_tetrahedra(estimate);
}

}  // namespace

lattice::LatticePoints place_points(const plc::Plc& plc, const facets::FacetMesh& facets,
                                    protection::ProtectedDelaunay& surface, Run& run) {
  const MeshOptions& options = run.options;
  if (options.lattice == Lattice::none) return {};
  return run.measured(Stage::lattice, [&] {
    lattice::LatticePoints lattice = place_any(plc, surface, facets, run);
    run.counts.dropped_interior_vertices = lattice.points.size();
    const auto avoided =
        options.sphere_factor >= 1 ? protection::Avoided::smallest_spheres : protection::Avoided::nothing;
    keep_only(protection::make_room(lattice.points, plc, options.protection, surface, avoided, run.progress), lattice);
    run.counts.dropped_interior_vertices -= lattice.points.size();
    check_number_of_tetrahedra(surface.delaunay.vertices.size(), lattice.points.size(), run);
    return lattice;
  });
}

delaunay::Delaunay add_points(lattice::LatticePoints points, delaunay::Delaunay surface, Run& run) {
  const MeshOptions& options = run.options;
  return run.measured(Stage::delaunay, [&] {
    if (options.delaunay == DelaunayMethod::wrap) {
      append_vertices(surface, points.points, points.later_rounds);
      return delaunay::wrap_delaunay(std::move(surface.vertices), options.grid_scale, run.progress);
    }
    const bool is_lattice = options.lattice != Lattice::refinement;
    if (is_lattice && options.delaunay == DelaunayMethod::core && points.share_in_one_level >= options.least_core)
      run.counts.core_tetrahedra = cores::insert_points(points, surface, run.progress);
    else
      insert_points(surface, points.points, points.later_rounds, run.progress);
    const lattice::LatticePoints freed = std::move(points);
    return std::move(surface);
  });
}

}  // namespace ccdt::steps
