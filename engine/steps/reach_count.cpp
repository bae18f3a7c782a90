#include "engine/steps/reach_count.h"

#include <algorithm>
#include <span>

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

bool FactorSearch::note(double excess) {
  constexpr int most_tries = 14;
  constexpr double farthest_step = 1.5, farthest = 6, least_gap = 1e-3;
  const Try now{current_, excess};
  (excess > 0 ? more_ : less_) = now;
  if (more_ && less_) {
    const double share = ++tries_ % 2 == 0 ? 0.5 : more_->excess / (more_->excess - less_->excess);
    current_ = more_->scale + share * (less_->scale - more_->scale);
  } else {
    // Volumes have slope -3, surfaces -2; a kept surface stops all growth.
    const double slope = last_ ? std::clamp((excess - last_->excess) / (now.scale - last_->scale), -4.0, -0.5) : -3;
    current_ -= std::clamp(excess / slope, -farthest_step, farthest_step);
    ++tries_;
  }
  last_ = now;
  const bool is_narrow = more_ && less_ && std::fabs(more_->scale - less_->scale) < least_gap;
  return tries_ < most_tries && std::fabs(current_) < farthest && !is_narrow;
}

}  // namespace ccdt::steps
