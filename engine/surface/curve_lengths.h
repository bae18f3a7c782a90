#pragma once

#include <cstdint>
#include <vector>

#include "engine/surface/feature_curves.h"

namespace ccdt {

/// The longest edges that feature curves allow: short curves between corners stay single edges, and a bent curve needs
/// edges that stay near to it (`most_deviation`).
class CurveLengths {
 public:
  /// \param usual  the edge length that is wanted where the curve does not ask for less
  CurveLengths(const FeatureCurves& features, double usual);

  double at(std::uint32_t curve, double arc) const;

 private:
  const FeatureCurves& features_;
  std::vector<std::vector<double>> lengths_;  // by curve, at each of its points
};

}  // namespace ccdt
