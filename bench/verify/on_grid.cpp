#include "bench/verify/on_grid.h"

#include <array>
#include <map>

#include "engine/geometry/grid.h"

namespace ccdt::verify {

OnGrid put_on_grid(const plc::InputPlc& input, const mesh::TetMesh& mesh) {
  OnGrid result{input, mesh};
  const DyadicGrid grid = make_grid(input.vertices);
  std::map<std::array<double, 3>, Point3> rounded;
  for (Point3& p : result.input.vertices) p = rounded.try_emplace(as_array(p), grid.unit * grid.snap(p)).first->second;
  for (Point3& p : result.mesh.vertices) {
    const auto found = rounded.find(as_array(p));
    p = found != rounded.end() ? found->second : p - grid.origin;
  }
  for (Point3& p : result.input.holes) p = p - grid.origin;
  for (auto& region : result.input.regions) region.seed = region.seed - grid.origin;
  for (plc::PolygonFacet& facet : result.input.polygon_facets)
    for (Point3& p : facet.holes) p = p - grid.origin;
  return result;
}

}  // namespace ccdt::verify
