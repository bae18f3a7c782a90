#include "engine/steps/improve_mesh.h"

#include <algorithm>
#include <utility>

#include "engine/improve/improve_mesh.h"
#include "engine/protection/protect_edges.h"

namespace ccdt::steps {
namespace {

std::size_t first_steiner_vertex(const ProtectedDomain& domain, const Run& run) {
  return domain.plc.vertices.size() + run.counts.refined_on_segments;
}

}  // namespace

bool improves(const ProtectedDomain& domain, const Run& run) {
  const bool removes =
      run.options.improve.steiner == SteinerRule::remove && first_steiner_vertex(domain, run) < domain.first_interior;
  return removes || improvement_of(run.options) != Improvement::none ||
         std::ranges::any_of(domain.plc.regions, [](const plc::Region& r) { return r.largest_volume > 0; });
}

void improve_mesh(ProtectedDomain& domain, Tetrahedralization& t, Run& run) {
  if (!improves(domain, run)) return;
  ImproveOptions options = run.options.improve;
  options.improvement = improvement_of(run.options);
  if (domain.plc.periodicity != plc::Periodicity::none)
    options.steiner = SteinerRule::keep;  // none goes on one side alone
  MeshCounts& counts = run.counts;
  improve::ImproveInput input{domain.plc,
                              domain.chains,
                              std::move(t.cells),
                              std::move(t.facet_of_face),
                              first_steiner_vertex(domain, run),
                              domain.first_interior};
  input.first_sliding = domain.plc.vertices.size() - counts.refined_in_facets;
  const std::size_t faces_before = t.mesh.faces.size();
  counts.improve = run.measured(
      Stage::improve, [&] { return improve::improve_mesh(std::move(input), options, t.points, t.mesh, run.progress); });
  const std::uint64_t removed = counts.improve.removed_steiner_vertices;
  counts.steiner_vertices -= removed;
  counts.faces -= faces_before - t.mesh.faces.size();
  counts.interior_vertices = t.points.size() - (domain.first_interior - removed);
  counts.splits_by_level = protection::count_splits_by_level(domain.chains);
  counts.segments->restored = counts.segments->split - protection::count_split(domain.chains);
}

}  // namespace ccdt::steps
