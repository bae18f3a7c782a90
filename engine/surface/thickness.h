#pragma once

#include <vector>

#include "engine/geometry/box_tree.h"
#include "engine/surface/original_surface.h"

namespace ccdt::surface {

/// The edge lengths for thin places: those where the original surface has another sheet opposite, through the solid or
/// a gap.
///
///     ------ x ------    the sheet that is measured
///            | distance
///     ------ * ------    the opposite one: nearly parallel, as the sides of a wedge are not
class Thickness {
 public:
  /// \param usual  the edge length wanted where no place needs less
  Thickness(const OriginalSurface& surface, double usual);

  /// The edge length that a point needs: at most `most` on a large triangle. A small triangle is measured once, at its
  /// center.
  double wanted_at(const Foot& foot, double most) const;

  /// No point needs less.
  double least_wanted() const;

 private:
  double measure(const Foot& foot, double most) const;
  double distance(const Foot& foot, const Point3& direction, double reach) const;

  const OriginalSurface& surface_;
  double usual_;
  BoxTree tree_;
  mutable std::vector<double> of_small_triangles_;  // at their centers; below 0: not computed yet
};

}  // namespace ccdt::surface
