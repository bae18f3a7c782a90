#pragma once

#include <optional>
#include <vector>

#include "engine/base/point.h"
#include "engine/plc/plc.h"
#include "engine/protection/segment_chains.h"

namespace ccdt::protection {

struct RepeatedChains {
  SegmentChains chains;
  std::vector<Point3> points;  ///< of the vertices inside segments, whose ids follow those of the PLC
};

/// Gives segments that repeat each other on opposite sides of a periodic PLC the vertices of all of them.
///
/// \param chains  of the segments of `plc`, and perhaps of others, which are left out
/// \return        nothing if they have the same vertices already
std::optional<RepeatedChains> repeat_chains(const plc::Plc& plc, const SegmentChains& chains);

}  // namespace ccdt::protection
