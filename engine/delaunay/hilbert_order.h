#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/point.h"

namespace ccdt::delaunay {

/// The order in which points are inserted: a few rounds of growing size, each along a Hilbert curve, so that a point is
/// near the one before it. It is a biased randomized insertion order (Amenta, Choi and Rote 2003), except that nothing
/// is random: each round takes its points evenly along the curve. So its points are spread better than random ones, and
/// destroy and make fewer cells.
///
/// \param later_rounds  by point: how many rounds follow its own, if the caller knows rounds that are spread even
///                      better; more than 15 count as 15. Empty: each round has three times as many points as all
///                      before it
/// \return  the indices of the points, each once; depends on the arguments alone
std::vector<std::uint32_t> hilbert_order(std::span<const Point3> points,
                                         std::span<const std::uint8_t> later_rounds = {});

}  // namespace ccdt::delaunay
