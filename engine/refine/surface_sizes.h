#pragma once

#include "engine/base/point.h"
#include "engine/lattice/size_field.h"
#include "engine/plc/plc.h"
#include "engine/refine/refine_plc.h"

namespace ccdt::refine {

/// The wanted edge length of the surface at a place: at most that of the options, less at thin places
/// (`find_thin_places`). From there it grows by the distance times the grading.
class SurfaceSizes {
 public:
  SurfaceSizes(const plc::Plc& plc, const RefineOptions& options);

  double at(const Point3& p) const;

 private:
  double largest_, grading_;
  lattice::SizeTree places_;
};

}  // namespace ccdt::refine
