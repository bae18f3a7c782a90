#pragma once

#include <vector>

#include "engine/base/point.h"
#include "engine/geometry/box_tree.h"
#include "engine/plc/plc.h"
#include "engine/refine/refine_plc.h"
#include "engine/refine/thin_places.h"

namespace ccdt::refine {

/// The wanted edge length of the surface at a point: at most that of the options, less at thin places
/// (`find_thin_places`). From there it grows by the distance times the grading.
class SurfaceSizes {
 public:
  SurfaceSizes(const plc::Plc& plc, const RefineOptions& options);

  double at(const Point3& p);

  /// Raises the wanted lengths of thin places to at least this.
  void limit_from_below(double least);

  /// The limit that leaves about this share of the vertices at thin places; `largest` if none does.
  double least_for(double share) const;

 private:
  double largest_, grading_, least_ = 0;
  Point3 last_;  ///< where the length was asked for last, and what it was
  double last_size_;
  std::vector<SizedPoint> found_;  ///< all thin places
  BoxTree places_;                 ///< those that are left at the limit
};

}  // namespace ccdt::refine
