#pragma once

#include "engine/planar/divide_and_conquer.h"
#include "engine/planar/sweep_order.h"
#include "engine/planar/topology.h"
#include "engine/planar/triangulation.h"

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
