#pragma once

#include "engine/base/flatness.h"
#include "engine/plc/periodicity.h"

namespace ccdt::plc {

struct PlcOptions {
  double flatness = usual_flatness;  ///< how far the vertices of a patch may be from one plane, so that it is one
                                     ///< facet; as a fraction of the box. See `flatness_for`
  Periodicity periodicity = Periodicity::none;  ///< opposite sides must be equal on the grid
};

}  // namespace ccdt::plc
