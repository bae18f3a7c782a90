#include "bench/experiments/even_surface.h"

#include <algorithm>

#include "engine/io/plc_files.h"
#include "engine/plc/build_plc.h"
#include "engine/surface/remesh_surface.h"
#include "models/solids.h"

namespace ccdt {

SurfaceSource solid_source(const std::string& name) {
  const auto solid = std::ranges::find(solids(), name, &Solid::name);
  SurfaceSource source{name, true, solid->finest, solid->coarsest, 0, {}};
  source.volume = enclosed_volume(build_plc(make_solid(name, solid->default_edge_length)));
  return source;
}

SurfaceSource file_source(const std::filesystem::path& file) {
  SurfaceSource source;
  source.name = file.string();
  source.input = read_plc(file);
  source.volume = enclosed_volume(build_plc(source.input));
  return source;
}

EvenSurface make_even_surface(const SurfaceSource& source, double edge_length, const std::filesystem::path& file) {
  EvenSurface surface;
  surface.file = file;
  surface.edge_length = edge_length;
  InputPlc input = source.is_solid ? make_solid(source.name, edge_length) : source.input;
  surface.remeshed = !has_even_triangles(build_plc(input), edge_length);
  if (surface.remeshed) input = remesh_surface(input, {.edge_length = edge_length});
  const Plc plc = build_plc(input);
  surface.angles = smallest_angles(plc);
  surface.vertices = plc.vertices.size();
  for (const Facet& facet : plc.facets) surface.triangles += facet.triangles.size();
  write_plc(input, file);
  return surface;
}

}  // namespace ccdt
