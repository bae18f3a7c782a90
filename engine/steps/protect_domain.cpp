#include "engine/steps/protect_domain.h"

#include <utility>

#include "engine/front/find_facet_faces.h"
#include "engine/steps/place_points.h"
#include "engine/steps/repeat_splits.h"

namespace ccdt::steps {
namespace {

/// Makes the vertices of the mesh and their Delaunay tetrahedralization.
void add_vertices(folds::SurfaceProtector& protector, ProtectedDomain& domain, Run& run) {
  protection::ProtectedDelaunay surface = run.measured(Stage::protect, [&] { return protector.protect(run.progress); });
  const auto triangulate_facets = [&] {
    domain.first_interior = surface.delaunay.vertices.size();
    domain.facets = run.measured(Stage::facets, [&] {
      return facets::triangulate_facets(domain.plc, surface.chains, surface.delaunay, run.progress);
    });
  };
  triangulate_facets();
  lattice::LatticePoints points = place_points(domain.plc, domain.facets, surface, run);
  if (domain.first_interior < surface.delaunay.vertices.size()) triangulate_facets();
  domain.chains = std::move(surface.chains);
  domain.delaunay = add_points(std::move(points), std::move(surface.delaunay), run);
}

/// Nearly flat facets take the faces that the tetrahedralization has there.
void find_faces(ProtectedDomain& domain) {
  auto& [plc, chains, delaunay, facets, codes, first_interior] = domain;
  codes = front::find_facet_faces(plc, facets, delaunay);
  if (first_interior < delaunay.vertices.size() &&
      facets::follow_interior_vertices(plc, chains, delaunay, codes, facets))
    codes = front::find_facet_faces(plc, facets, delaunay);
}

void count_vertices(const ProtectedDomain& domain, MeshCounts& counts) {
  counts.steiner_vertices = domain.first_interior - domain.plc.vertices.size() - counts.refined_on_segments;
  counts.interior_vertices = domain.delaunay.vertices.size() - domain.first_interior;
  counts.splits_by_level = protection::count_splits_by_level(domain.chains);
}

}  // namespace

void protect_domain(folds::SurfaceProtector& protector, ProtectedDomain& domain, Run& run) {
  bool is_protected = false;
  while (!is_protected) {
    add_vertices(protector, domain, run);
    is_protected = run.measured(Stage::face_check, [&] {
      find_faces(domain);
      return protector.is_protected(domain.delaunay, domain.chains, domain.facets, domain.codes);
    });
    if (is_protected) is_protected = !repeat_splits(domain.chains, protector, run);
  }
  count_vertices(domain, run.counts);
}

}  // namespace ccdt::steps
