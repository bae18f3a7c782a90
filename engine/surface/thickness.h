#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/box_tree.h"
#include "engine/surface/original_surface.h"

namespace ccdt::surface {

/// The edge lengths that thin places ask for: those where the original surface has another sheet opposite of it,
/// through the solid or through a gap.
///
///     ------ x ------    the sheet that is asked
///            | distance
///     ------ * ------    the opposite one: nearly parallel, as the sides of a wedge are not
class Thickness {
 public:
  /// \param usual  the edge length that is wanted where no place asks for less
  Thickness(const OriginalSurface& surface, double usual);

  /// The edge length that a point asks for. A large triangle asks for no more than `most`; a small one is measured
  /// once, at its center.
  double wanted_at(const Foot& foot, double most) const;

  /// No point asks for less.
  double least_wanted() const;

 private:
  double measure(const Foot& foot, double most) const;
  double distance(const Foot& foot, const Point3& direction, double reach) const;

  const OriginalSurface& surface_;
  double usual_;
  BoxTree tree_;
  mutable std::vector<double> of_small_triangles_;  // at their centers; less than 0 before it is asked for
};

}  // namespace ccdt::surface
