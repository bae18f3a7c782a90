#include "engine/io/vtk_values.h"

#include <cmath>
#include <utility>

#include "engine/base/parallel.h"

namespace ccdt::io {

std::vector<Point3> read_vtk_points(const VtkArrays& arrays) {
  const auto array = arrays.required("Points", "");
  const StoredNumbers<double> xyz = arrays.read<double>(array);
  arrays.check_size(array, xyz.size(), 3 * arrays.claimed("NumberOfPoints"));
  std::vector<Point3> points(xyz.size() / 3);
  const auto read_bad = [&](std::size_t i) {
    std::array<double, 3> at;
    xyz.read(3 * i, 3 * i + 3, at.data());
    points[i] = {at[0], at[1], at[2]};
    return !std::ranges::all_of(at, [](double x) { return std::isfinite(x); });
  };
  if (const auto bad = parallel_select(points.size(), vtk_range_length, read_bad); !bad.empty())
    arrays.fail(arrays.begin_of(array),
                "vertex " + std::to_string(bad[0]) + ": a coordinate is not a finite number (NaN or infinite)",
                "repair this vertex, or export the file again");
  return points;
}

StoredNumbers<std::int64_t> read_vtk_attributes(const VtkArrays& arrays, const char* name, std::size_t count) {
  const auto array = arrays.find("CellData", name);
  if (!array) return {};
  auto values = arrays.read<std::int64_t>(array);
  arrays.check_size(array, values.size(), count);
  const auto find_large = [&](std::size_t range_begin, std::size_t range_end, std::vector<std::size_t>& large) {
    Few some;
    for_few(range_begin, range_end, [&](std::size_t begin, std::size_t end) {
      values.read(begin, end, some.data());
      for (std::size_t i = begin; i < end; ++i)
        if (!std::in_range<int>(some[i - begin])) large.push_back(i);
    });
  };
  if (const auto large = parallel_collect<std::size_t>(count, vtk_range_length, find_large); !large.empty())
    arrays.fail(arrays.begin_of(array),
                "cell " + std::to_string(large[0]) + ": its " + name + " does not fit in 32 bits",
                "use smaller numbers");
  return values;
}

}  // namespace ccdt::io
