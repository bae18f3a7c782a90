#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/base/index.h"
#include "engine/plc/plc.h"

namespace ccdt::plc {

struct RepeatedSegment {
  std::uint32_t segment;
  bool turned;  ///< its second end repeats the first ends of those that are not
};

/// What repeats each other on opposite sides of a periodic PLC: one list for each place of the period. On an edge of
/// the box, four may repeat each other, and at a corner eight vertices.
struct Repeats {
  std::vector<std::vector<VertexId>> vertices;
  std::vector<std::vector<RepeatedSegment>> segments;
  std::vector<std::array<FacetId, 2>> facets;
};

/// \return  empty lists if the PLC is not periodic
/// \throw InputError  opposite sides differ on the grid; with a place
Repeats find_repeats(const Plc& plc);

}  // namespace ccdt::plc
