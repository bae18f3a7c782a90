#include "engine/mesh/check_sides.h"

#include <algorithm>
#include <cstddef>
#include <tuple>
#include <vector>

#include "engine/base/errors.h"
#include "engine/plc/period.h"

namespace ccdt::mesh {
namespace {

struct FaceOnSide {
  unsigned sides;
  std::array<std::array<double, 3>, 3> corners;  // where they repeat, sorted
  Point3 corner;                                 // where one of them is

  bool operator<(const FaceOnSide& o) const { return std::tie(sides, corners) < std::tie(o.sides, o.corners); }
  bool repeats(const FaceOnSide& o) const { return std::tie(sides, corners) == std::tie(o.sides, o.corners); }
};

std::vector<FaceOnSide> find_faces_on_sides(const plc::Plc& plc, std::span<const Point3> points,
                                            std::span<const std::array<std::uint32_t, 3>> faces) {
  const plc::Period period = plc::period_of(plc.vertices, plc.periodicity);
  std::vector<FaceOnSide> on_sides;
  for (const auto& [a, b, c] : faces) {
    const std::array<Point3, 3> corners = {points[a], points[b], points[c]};
    const unsigned sides = period.sides_of(corners);
    if (sides == 0) continue;
    on_sides.push_back({sides, {}, corners[0]});
    for (std::size_t i = 0; i < 3; ++i) on_sides.back().corners[i] = as_array(period.folded(corners[i]));
    std::ranges::sort(on_sides.back().corners);
  }
  return on_sides;
}

}  // namespace

void check_sides(const plc::Plc& plc, std::span<const Point3> points,
                 std::span<const std::array<std::uint32_t, 3>> faces) {
  if (plc.periodicity == plc::Periodicity::none) return;
  std::vector<FaceOnSide> all = find_faces_on_sides(plc, points, faces);
  std::sort(all.begin(), all.end());
  for (std::size_t i = 0; i < all.size(); i += 2) {
    if (i + 1 < all.size() && all[i].repeats(all[i + 1])) continue;
    const Point3 place = plc.grid.to_world(all[i].corner);
    throw MeshError("opposite sides of the mesh differ", {.file = plc.name, .points = {as_array(place)}},
                    "--surface refine may help, or finer sides of the input");
  }
}

}  // namespace ccdt::mesh
