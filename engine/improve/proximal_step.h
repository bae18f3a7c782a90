#pragma once

#include "engine/improve/star_functions.h"

namespace ccdt {

/// A step and what it promises.
struct ProximalStep {
  Point3 step = {};
  double least = 0;  ///< of the models, after the step
};

/// The step s that makes the least of the models as great as possible, less s^2 / (2 `length`): a proximal point. The
/// step is `length` times a convex combination of gradients, found by its dual: where only models of one value matter,
/// their combination of least norm, the direction of steepest ascent.
///
/// \param models  at least one
ProximalStep proximal_step(const LinearModels& models, double length);

}  // namespace ccdt
