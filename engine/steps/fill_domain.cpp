#include "engine/steps/fill_domain.h"

#include <algorithm>
#include <utility>

#include "engine/front/advance_front.h"
#include "engine/front/count_segments.h"
#include "engine/label/label_cells.h"
#include "engine/mesh/assemble_mesh.h"
#include "engine/mesh/collect_tetrahedra.h"
#include "engine/steps/improve_mesh.h"

namespace ccdt::steps {
namespace {

void count_faces(const ProtectedDomain& domain, MeshCounts& counts) {
  counts.faces = domain.facets.triangles.size();
  counts.undelaunay_faces = static_cast<std::size_t>(std::ranges::count(domain.codes, delaunay::no_neighbor));
  counts.segments = front::count_segments(domain.plc, domain.chains, domain.facets, domain.codes, domain.delaunay);
}

front::FrontResult advance_front(const ProtectedDomain& domain, Run& run) {
  const MeshOptions& options = run.options;
  const front::FrontOptions strategy{options.locator, options.grid_scale, options.face_protection, options.visibility};
  front::FrontResult front = run.measured(Stage::front, [&] {
    return front::advance_front({domain.plc, domain.facets, domain.codes, domain.delaunay}, strategy, run.progress);
  });
  run.counts.front_tetrahedra = front.tetrahedra.size();
  run.counts.front_faces = front.undelaunay_faces;
  return front;
}

}  // namespace

Tetrahedralization fill_domain(ProtectedDomain& domain, Run& run) {
  auto& [plc, chains, delaunay, facets, codes, first_interior] = domain;
  count_faces(domain, run.counts);  // only for the report, so it does not count as work of a stage
  if (!run.options.face_protection) std::ranges::fill(codes, delaunay::no_neighbor);
  front::FrontResult front = advance_front(domain, run);
  RawVector<RegionId> regions =
      run.measured(Stage::label, [&] { return label::label_cells(plc, delaunay, front.open, codes); });
  Tetrahedralization t{.points = points_of(delaunay)};
  // The next steps need the most memory.
  release(delaunay.vertices), release(delaunay.cell_at), release(codes);
  mesh::CollectedMesh collected = run.measured(Stage::label, [&] {
    return mesh::collect_tetrahedra(plc, front, std::move(regions), delaunay.cells, t.points.size());
  });
  front = {};
  run.measured(Stage::finish, [&] {
    mesh::check_volume(plc, facets, t.points, collected.mesh);
    t.facet_of_face = mesh::finish_mesh(plc, chains, t.points, std::move(facets), collected);
  });
  if (improves(domain, run))
    t.cells = run.measured(Stage::improve, [&] {
      return mesh::join_tetrahedra(collected.mesh, std::move(collected.sources), std::move(delaunay.cells));
    });
  t.mesh = std::move(collected.mesh);
  return t;
}

}  // namespace ccdt::steps
