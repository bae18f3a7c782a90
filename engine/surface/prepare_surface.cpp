#include "engine/surface/prepare_surface.h"

#include <algorithm>

#include "engine/base/stage_scope.h"
#include "engine/plc/edge_length_bounds.h"
#include "engine/plc/warped_facets.h"
#include "engine/surface/remesh_surface.h"

namespace ccdt::surface {
namespace {

/// Does the input give all its regions a largest volume, which then is the only size?
bool has_volumes_alone(const plc::InputPlc& input) {
  return !input.regions.empty() &&
         std::ranges::all_of(input.regions, [](const auto& region) { return region.max_volume > 0; });
}

}  // namespace

PreparedSurface prepare_surface(const plc::InputPlc& input, SurfaceRule rule, RemeshOptions options,
                                const Progress& progress) {
  PreparedSurface surface;
  {
    const StageScope scope(surface.costs[Stage::plc]);
    surface.changed = plc::triangulate_warped_facets(input);
  }
  const plc::InputPlc& flat = surface.changed ? *surface.changed : input;
  surface.facets = flat.facet_count();
  const double longest = plc::longest_edge(flat);
  const bool has_usual_length = rule == SurfaceRule::refine || rule == SurfaceRule::automatic ||
                                (rule == SurfaceRule::remesh && options.has_sizes());
  if (options.edge_length == 0 && has_usual_length)
    options.edge_length = options.usual_factor * (has_volumes_alone(flat) ? longest : longest / 40);
  options.edge_length = std::min(options.edge_length, longest);
  surface.edge_length = options.edge_length;
  if (rule != SurfaceRule::keep && options.edge_length > 0)
    plc::check_edges_of_surface(flat, options.edge_length, options.most_tetrahedra);
  if (rule == SurfaceRule::automatic && options.deviation == 0) options.deviation = usual_deviation * longest;
  if (makes_new_surface(rule)) {
    const StageScope scope(surface.costs[Stage::remesh]);
    surface.changed = remesh_surface(flat, options, progress);
  }
  return surface;
}

}  // namespace ccdt::surface
