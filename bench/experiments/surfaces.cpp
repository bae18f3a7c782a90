#include "bench/experiments/surfaces.h"

#include <algorithm>
#include <sstream>
#include <vector>

#include "engine/io/plc_files.h"
#include "engine/plc/build_plc.h"
#include "engine/surface/remesh_surface.h"
#include "models/solids.h"

namespace ccdt::experiments {

std::vector<std::string> names_of_paper_models() {
  std::vector<std::string> names;
  for (const PaperModel& model : paper_models) names.emplace_back(model.name);
  return names;
}

SurfaceFile write_solid(const ExperimentOptions& options, const std::string& experiment, const std::string& name,
                        double edge_length) {
  const auto solid = std::ranges::find(models::solids(), name, &models::Solid::name);
  const double scaled = std::clamp(edge_factor(options) * edge_length, solid->finest, solid->coarsest);
  std::ostringstream file;
  file << experiment << "-" << name << "-" << scaled << ".poly";
  SurfaceFile surface{name, options.folder / "models" / file.str(), scaled};
  io::write_plc(models::make_solid(name, scaled), surface.file);
  return surface;
}

std::vector<SurfaceFile> write_solids(const ExperimentOptions& options, const std::string& experiment,
                                      std::span<const double> coarsenings) {
  std::vector<SurfaceFile> files;
  for (const models::Solid& solid : models::solids()) {
    if (!is_asked_for(options, solid.name)) continue;
    std::vector<Point3> before;
    for (const double coarsening : coarsenings) {
      const SurfaceFile surface =
          write_solid(options, experiment, std::string(solid.name), coarsening * solid.default_edge_length);
      std::vector<Point3> vertices = io::read_plc(surface.file).vertices;
      if (vertices == before) continue;
      files.push_back(surface);
      before = std::move(vertices);
    }
  }
  return files;
}

std::vector<SurfaceFile> input_files(const ExperimentOptions& options) {
  std::vector<SurfaceFile> files;
  for (const auto& input : options.inputs) files.push_back({input.filename().string(), input});
  return files;
}

SurfaceSource solid_source(const std::string& name) {
  const auto solid = std::ranges::find(models::solids(), name, &models::Solid::name);
  SurfaceSource source{name, true, solid->finest, solid->coarsest, 0, {}};
  source.volume = bench::enclosed_volume(plc::build_plc(models::make_solid(name, solid->default_edge_length)));
  return source;
}

SurfaceSource file_source(const std::filesystem::path& file) {
  SurfaceSource source;
  source.name = file.string();
  source.input = io::read_plc(file);
  source.volume = bench::enclosed_volume(plc::build_plc(source.input));
  return source;
}

EvenSurface make_even_surface(const SurfaceSource& source, double edge_length, const std::filesystem::path& file) {
  EvenSurface surface;
  surface.file = file;
  surface.edge_length = edge_length;
  plc::InputPlc input = source.is_solid ? models::make_solid(source.name, edge_length) : source.input;
  surface.remeshed = !bench::has_even_triangles(plc::build_plc(input), edge_length);
  if (surface.remeshed) input = surface::remesh_surface(input, {.edge_length = edge_length});
  const plc::Plc plc = plc::build_plc(input);
  surface.angles = bench::smallest_angles(plc);
  surface.vertices = plc.vertices.size();
  for (const plc::Facet& facet : plc.facets) surface.triangles += facet.triangles.size();
  io::write_plc(input, file);
  return surface;
}

}  // namespace ccdt::experiments
