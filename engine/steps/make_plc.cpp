#include "engine/steps/make_plc.h"

#include <algorithm>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "engine/base/errors.h"
#include "engine/folds/divide_facets.h"
#include "engine/front/find_delaunay_faces.h"
#include "engine/plc/build_plc.h"
#include "engine/plc/edge_length_bounds.h"
#include "engine/plc/gather_parts.h"
#include "engine/refine/refine_plc.h"
#include "engine/sizes/wanted_places.h"
#include "engine/steps/tetrahedralize_vertices.h"

namespace ccdt::steps {
namespace {

/// Adds the vertices of refinement to the PLC.
///
/// \return  all points: those of the PLC, then those on segments
std::vector<Point3> refine_surface(TetrahedralizedPlc& result, Run& run) {
  const std::size_t vertices_before = result.plc.vertices.size();
  const refine::RefineOptions options{.edge_length = run.options.edge_length / result.plc.grid.unit,
                                      .grading = run.options.grading,
                                      .most_tetrahedra = run.options.thin_tetrahedra,
                                      .wanted = run.wanted};
  refine::RefinedPlc refined =
      run.measured(Stage::refine, [&] { return refine::refine_plc(result.plc, options, run.progress); });
  result.plc = std::move(refined.plc);
  result.chains = std::move(refined.chains);
  run.counts.refined_in_facets = result.plc.vertices.size() - vertices_before;
  run.counts.refined_on_segments = refined.on_segments.size();
  std::vector<Point3> points = result.plc.vertices;
  points.insert(points.end(), refined.on_segments.begin(), refined.on_segments.end());
  return points;
}

/// Finds out where the options and the regions want shorter edges, in grid units.
void find_wanted_sizes(const InputPlc& input, plc::Plc& plc, Run& run) {
  const MeshOptions& options = run.options;
  sizes::set_volumes(options.local, plc);
  if (options.lattice == Lattice::none && options.surface != SurfaceRule::refine)
    for (plc::Region& region : plc.regions) region.largest_volume = 0;  // nothing is added inside
  const auto has_limit = [](const plc::Region& region) { return region.largest_volume > 0; };
  if (options.local.empty() && options.background.empty() && std::ranges::none_of(plc.regions, has_limit)) return;
  const double usual = (options.edge_length > 0 ? options.edge_length : plc::longest_edge(input)) / plc.grid.unit;
  run.wanted = {sizes::wanted_places(input, plc, options.local, usual, to_radians(options.sharp_angle)),
                sizes::in_grid_units(options.background, plc.grid)};
}

plc::Plc flattened(const plc::Plc& plc, const Run& run) {
  folds::FacetDivider divider(plc, delaunay::build_delaunay(plc.vertices),
                              plc::tolerance_of(plc, run.options.flatness));
  divider.follow_input();
  return divider.divided();
}

}  // namespace

TetrahedralizedPlc make_plc(const InputPlc& input, bool flattens, Run& run) {
  const plc::PlcOptions flat{run.options.flatness, run.options.periodic};
  const bool refines = run.options.surface == SurfaceRule::refine;
  plc::UncheckedPlc gathered = run.measured(Stage::plc, [&] { return plc::gather_plc(input, flat, run.progress); });
  // Refinement adds vertices, and all ranks depend on them. So a tetrahedralization would be used only for this check.
  std::optional<delaunay::Delaunay> delaunay;
  if (!refines) delaunay = tetrahedralize_vertices(gathered.plc.vertices, run);
  static_assert(plc::no_face == delaunay::no_neighbor);
  TetrahedralizedPlc result = run.measured(Stage::plc, [&]() -> TetrahedralizedPlc {
    if (delaunay) gathered.triangles.faces = front::find_delaunay_faces(gathered.triangles.corners, *delaunay);
    return {plc::check_plc(input, std::move(gathered), flat, run.progress)};
  });
  if (flattens) result.plc = run.measured(Stage::plc, [&] { return flattened(result.plc, run); });
  run.measured(Stage::plc, [&] { find_wanted_sizes(input, result.plc, run); });
  if (refines) delaunay = tetrahedralize_vertices(refine_surface(result, run), run);
  if (!delaunay) delaunay::refuse_flat_points();
  result.delaunay = *std::move(delaunay);
  return result;
}

}  // namespace ccdt::steps
