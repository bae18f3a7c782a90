#include "bench/experiments/surfaces.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "engine/io/plc_files.h"
#include "models/solids.h"

namespace ccdt {

SurfaceFile write_solid(const ExperimentOptions& options, const std::string& experiment, const std::string& name,
                        double edge_length) {
  const auto solid = std::ranges::find(solids(), name, &Solid::name);
  const double scaled = std::clamp(edge_factor(options) * edge_length, solid->finest, solid->coarsest);
  std::ostringstream file;
  file << experiment << "-" << name << "-" << scaled << ".poly";
  SurfaceFile surface{name, options.folder / "models" / file.str(), scaled};
  write_plc(make_solid(name, scaled), surface.file);
  return surface;
}

std::vector<SurfaceFile> input_files(const ExperimentOptions& options) {
  std::vector<SurfaceFile> files;
  for (const auto& input : options.inputs) files.push_back({input.filename().string(), input});
  return files;
}

double edge_ratio(const InputPlc& plc) {
  double shortest = std::numeric_limits<double>::infinity(), longest = 0;
  const auto add_loop = [&](const auto& loop) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const double length = squared_length(plc.vertices[loop[(i + 1) % loop.size()]] - plc.vertices[loop[i]]);
      if (length <= 0) continue;
      shortest = std::min(shortest, length);
      longest = std::max(longest, length);
    }
  };
  for (const auto& triangle : plc.triangles) add_loop(triangle);
  for (const PolygonFacet& facet : plc.polygon_facets)
    for (const auto& polygon : facet.polygons) add_loop(polygon);
  for (const auto& segment : plc.segments) add_loop(segment);
  return longest > 0 ? std::sqrt(longest / shortest) : 1;
}

}  // namespace ccdt
