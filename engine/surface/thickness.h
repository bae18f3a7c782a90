#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/box_tree.h"
#include "engine/surface/original_surface.h"

namespace ccdt::surface {

/// The edge lengths for thin places: those where the original surface has another sheet opposite, through the solid or
/// a gap.
///
///     ------ x ------    the sheet that is asked
///            | distance
///     ------ * ------    the opposite one: nearly parallel, as the sides of a wedge are not
class Thickness {
 public:
  /// \param usual  the edge length wanted where no place needs less
  Thickness(const OriginalSurface& surface, double usual);

  /// The edge length that a point needs. A large triangle needs at most `most`; a small one is measured once, at its
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
  mutable std::vector<double> of_small_triangles_;  // at their centers; less than 0: not computed yet
};

}  // namespace ccdt::surface
