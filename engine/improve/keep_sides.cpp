#include "engine/improve/keep_sides.h"

#include <cstddef>

#include "engine/plc/period.h"

namespace ccdt::improve {

void keep_faces_on_sides(const plc::Plc& plc, std::span<const Point3> points,
                         std::span<const std::array<std::uint32_t, 3>> faces,
                         std::vector<std::uint32_t>& facet_of_face) {
  if (plc.periodicity == plc::Periodicity::none) return;
  const plc::Period period = plc::period_of(plc.vertices, plc.periodicity);
  auto next_facet = static_cast<std::uint32_t>(plc.facets.size());
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const auto& [a, b, c] = faces[f];
    if (period.sides_of(std::array{points[a], points[b], points[c]}) != 0) facet_of_face[f] = next_facet++;
  }
}

void keep_vertices_on_sides(const plc::Plc& plc, const tets::CellComplex& complex, std::vector<Freedom>& freedom) {
  if (plc.periodicity == plc::Periodicity::none) return;
  const plc::Period period = plc::period_of(plc.vertices, plc.periodicity);
  for (std::uint32_t v = 0; v < freedom.size(); ++v)
    if (period.sides_of({&complex.point(v), 1}) != 0) freedom[v].dimensions = 0;
}

}  // namespace ccdt::improve
