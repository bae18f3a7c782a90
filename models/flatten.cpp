#include "models/flatten.h"

namespace ccdt::models {

void flatten(plc::InputPlc& plc, double factor) {
  const auto press = [&](Point3& p) { p.z *= factor; };
  for (Point3& p : plc.vertices) press(p);
  for (Point3& p : plc.holes) press(p);
  for (auto& region : plc.regions) press(region.seed);
  for (auto& facet : plc.polygon_facets)
    for (Point3& p : facet.holes) press(p);
}

}  // namespace ccdt::models
