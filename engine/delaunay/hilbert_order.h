#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/point.h"

namespace ccdt::delaunay {

/// The order in which points are inserted: a few rounds of growing size (a biased randomized insertion order, Amenta,
/// Choi and Rote 2003), each along a Hilbert curve, so that a point is near the one before it.
///
/// \return  the indices of the points, each once; depends on the points alone
std::vector<std::uint32_t> hilbert_order(std::span<const Point3> points);

}  // namespace ccdt::delaunay
