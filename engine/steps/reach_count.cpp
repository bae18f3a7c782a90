#include "engine/steps/reach_count.h"

namespace ccdt::steps {

MeshOptions scaled(MeshOptions options, double factor) {
  options.edge_length *= factor;
  options.surface_factor *= factor;
  for (double& size : options.background.sizes) size *= factor;
  for (LocalSize& size : options.local.sizes) size.edge_length *= factor;
  options.local.curvature_angle = std::min(180.0, options.local.curvature_angle * factor);
  options.local.elements_through /= factor;
  if (options.local.function)
    options.local.function = [original = options.local.function, factor](std::span<const Point3> points,
                                                                         std::span<double> lengths) {
      original(points, lengths);
      for (double& one : lengths) one *= factor;
    };
  return options;
}

}  // namespace ccdt::steps
