#pragma once

#include "engine/facets/planar_divide_and_conquer.h"
#include "engine/facets/planar_sweep_order.h"
#include "engine/facets/planar_topology.h"
#include "engine/facets/planar_triangulation.h"

namespace ccdt {

template <PlanarPredicates P>
PlanarTriangulationResult planar_delaunay(std::span<const VertexId> vertices, const P& predicates) {
  PlanarTriangulationResult result;
  const planar::SweepOrder order = planar::sweep_order(vertices, predicates);
  result.status = order.status;
  result.duplicates = order.duplicates;
  if (!result) return result;
  const auto triangles = planar::DivideAndConquer<P>(order.swept, predicates).triangles_with_pole(order.pole);
  result.triangulation = planar_from_triangles(triangles);
  planar_legalize(result.triangulation, predicates);
  return result;
}

}  // namespace ccdt
