#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "engine/base/point.h"
#include "engine/io/vtk_arrays.h"

namespace ccdt::io {

/// The length of the ranges of points and cells that one thread reads at a time.
inline constexpr std::size_t vtk_range_length = 16384;

/// Calls visit(begin, end) for short ranges that cover a range. Their numbers are converted before they are used.
inline constexpr std::size_t few = 512;
template <class Visit>
void for_few(std::size_t begin, std::size_t end, const Visit& visit) {
  for (; begin < end; begin += few) visit(begin, std::min(end, begin + few));
}
using Few = std::array<std::int64_t, few>;

/// The points of a file. \throw InputError  a coordinate is not finite
std::vector<Point3> read_vtk_points(const VtkArrays& arrays);

/// The attribute of cells with this name; none if there is no such array.
///
/// \throw InputError  it has not one whole number of 32 bits per cell
StoredNumbers<std::int64_t> read_vtk_attributes(const VtkArrays& arrays, const char* name, std::size_t count);

}  // namespace ccdt::io
