#include "engine/plc/facet_triangles.h"

#include <utility>

#include "engine/plc/build_plc.h"

namespace ccdt::plc {

FacetTriangles facet_triangles(const InputPlc& input) {
  FacetTriangles all;
  if (!input.polygon_facets.empty()) {
    UncheckedPlc gathered = gather_plc(input);
    for (const VertexTriple& t : gathered.triangles.corners) all.corners.push_back(points_of(gathered.plc.world, t));
    all.numbers = std::move(gathered.triangles.numbers);
    return all;
  }
  for (std::uint32_t i = 0; i < input.triangles.size(); ++i) {
    const auto& [a, b, c] = input.triangles[i];
    all.corners.push_back({input.vertices[a], input.vertices[b], input.vertices[c]});
    all.numbers.push_back(input.triangle_numbers.empty() ? i : input.triangle_numbers[i]);
  }
  return all;
}

}  // namespace ccdt::plc
