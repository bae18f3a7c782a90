#pragma once

#include "engine/base/box.h"

namespace ccdt::sizes {

/// How much of a box a shape fills.
enum class Filling { none, part, all };

/// Calls add(cube) for cubes that cover the part of a shape within a cube. None of them is longer than `least`, unless
/// the shape fills it.
///
/// \param filling_of  filling_of(cube); may say `part` instead of one of the others
template <class FillingOf, class Add>
void cover(const Box& cube, double least, const FillingOf& filling_of, const Add& add) {
  const Filling filling = filling_of(cube);
  if (filling == Filling::none) return;
  if (filling == Filling::all || cube.high.x - cube.low.x <= least) return add(cube);
  const Point3 center = cube.center();
  for (unsigned i = 0; i < 8; ++i) {
    const Point3 corner{(i & 1) != 0 ? cube.high.x : cube.low.x, (i & 2) != 0 ? cube.high.y : cube.low.y,
                        (i & 4) != 0 ? cube.high.z : cube.low.z};
    cover({componentwise_min(center, corner), componentwise_max(center, corner)}, least, filling_of, add);
  }
}

/// The least cube with the same center that contains a box.
inline Box cube_around(const Box& box) {
  const Point3 size = box.high - box.low;
  const double half = 0.5 * std::max({size.x, size.y, size.z});
  return {box.center() - Point3{half, half, half}, box.center() + Point3{half, half, half}};
}

}  // namespace ccdt::sizes
