#include "engine/plc/snap_vertices.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "engine/base/errors.h"

namespace ccdt {

namespace {

void refuse_infinite(const InputPlc& input) {
  for (std::size_t i = 0; i < input.vertices.size(); ++i) {
    const auto [x, y, z] = input.vertices[i];
    if (std::isfinite(x) && std::isfinite(y) && std::isfinite(z)) continue;
    Place place;
    place.file = input.name;
    throw InputError("vertex " + std::to_string(i) + " (counted from 0) has a coordinate that is not a finite number",
                     place, "export the model again, or correct or remove this vertex and the facets that use it");
  }
}

double largest_difference(const Point3& a, const Point3& b) {
  return std::max({std::fabs(a.x - b.x), std::fabs(a.y - b.y), std::fabs(a.z - b.z)});
}

}  // namespace

void snap_vertices(const InputPlc& input, Plc& plc) {
  refuse_infinite(input);
  plc.grid = make_grid(input.vertices);
  const auto count = static_cast<std::uint32_t>(input.vertices.size());
  std::vector<Point3> snapped(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    snapped[i] = plc.grid.snap(input.vertices[i]);
    plc.largest_rounding =
        std::max(plc.largest_rounding, largest_difference(plc.grid.to_world(snapped[i]), input.vertices[i]));
  }

  // Equal points become neighbours in sorted order; the first of them in the input stands for all.
  std::vector<std::uint32_t> order(count);
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t j) {
    const Point3 &a = snapped[i], &b = snapped[j];
    if (a.x != b.x) return a.x < b.x;
    if (a.y != b.y) return a.y < b.y;
    if (a.z != b.z) return a.z < b.z;
    return i < j;
  });
  std::vector<std::uint32_t> first_equal(count);
  for (std::uint32_t k = 0; k < count; ++k) {
    const bool same = k > 0 && snapped[order[k]] == snapped[order[k - 1]];
    first_equal[order[k]] = same ? first_equal[order[k - 1]] : order[k];
  }

  plc.vertex_of_input.resize(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    if (first_equal[i] != i) {
      plc.vertex_of_input[i] = plc.vertex_of_input[first_equal[i]];
      continue;
    }
    plc.vertex_of_input[i] = VertexId(plc.vertices.size());
    plc.vertices.push_back(snapped[i]);
    plc.world.push_back(input.vertices[i]);
  }
}

}  // namespace ccdt
