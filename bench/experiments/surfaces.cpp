#include "bench/experiments/surfaces.h"

#include <algorithm>
#include <sstream>
#include <system_error>
#include <utility>
#include <vector>

#include "engine/io/plc_files.h"
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
    if (!is_chosen(options, solid.name)) continue;
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

std::vector<SurfaceFile> parts_that_come_along(const ExperimentOptions& options) {
  std::vector<SurfaceFile> files;
  if (!options.models.empty()) return files;
  // Beside the program in a build, beside its folder after installation.
  for (const auto& base : {options.program.parent_path(), options.program.parent_path().parent_path()}) {
    std::error_code missing;
    for (const auto& entry : std::filesystem::directory_iterator(base / "share" / "ccdt" / "parts", missing))
      files.push_back({entry.path().filename().string(), entry.path()});
    if (!files.empty()) break;
  }
  std::ranges::sort(files, {}, &SurfaceFile::name);
  return files;
}

std::vector<SurfaceFile> input_files(const ExperimentOptions& options) {
  std::vector<SurfaceFile> files;
  for (const auto& input : options.inputs) files.push_back({input.filename().string(), input});
  return files;
}

}  // namespace ccdt::experiments
