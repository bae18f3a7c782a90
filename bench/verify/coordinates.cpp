#include "bench/verify/coordinates.h"

#include <array>
#include <map>

#include "engine/geometry/grid.h"

namespace ccdt::verify {

namespace {

/// Replaces the points of an input that are no vertices.
template <class Move>
void move_seeds(const Move& moved, plc::InputPlc& input) {
  for (Point3& p : input.holes) p = moved(p);
  for (auto& region : input.regions) region.seed = moved(region.seed);
  for (plc::PolygonFacet& facet : input.polygon_facets)
    for (Point3& p : facet.holes) p = moved(p);
}

}  // namespace

InputAndMesh put_on_grid(const plc::InputPlc& input, const mesh::TetMesh& mesh) {
  InputAndMesh result{input, mesh};
  const DyadicGrid grid = make_grid(input.vertices);
  std::map<std::array<double, 3>, Point3> rounded;
  for (Point3& p : result.input.vertices) p = rounded.try_emplace(as_array(p), grid.unit * grid.snap(p)).first->second;
  for (Point3& p : result.mesh.vertices) {
    const auto found = rounded.find(as_array(p));
    p = found != rounded.end() ? found->second : p - grid.origin;
  }
  move_seeds([&](const Point3& p) { return p - grid.origin; }, result.input);
  return result;
}

InputAndMesh scale_by(double factor, const plc::InputPlc& input, const mesh::TetMesh& mesh) {
  InputAndMesh result{input, mesh};
  for (Point3& p : result.input.vertices) p = factor * p;
  for (Point3& p : result.mesh.vertices) p = factor * p;
  move_seeds([&](const Point3& p) { return factor * p; }, result.input);
  return result;
}

}  // namespace ccdt::verify
