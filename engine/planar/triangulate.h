#pragma once

#include <algorithm>
#include <stdexcept>

#include "engine/planar/local_steps.h"
#include "engine/planar/topology.h"
#include "engine/planar/triangulation.h"

namespace ccdt {
namespace planar {

/// An edge of the triangulation and the number of the edge of the input that it is a part of.
struct NumberedPart {
  PlanarEdge edge;
  std::size_t number;
};

inline std::size_t number_of_part(const std::vector<NumberedPart>& parts, PlanarEdge edge) {
  const PlanarEdge reversed{edge[1], edge[0]};
  for (const NumberedPart& part : parts) {
    if (part.edge == edge || part.edge == reversed) return part.number;
  }
  throw std::logic_error("a constrained edge that comes from no edge of the input");
}

/// Inserts all edges; on a crossing the result says so and has no triangulation.
template <PlanarPredicates P>
void insert_edges(PlanarTriangulationResult& result, std::span<const PlanarEdge> edges, const P& predicates) {
  std::vector<NumberedPart> parts;
  for (std::size_t number = 0; number < edges.size(); ++number) {
    const auto& [a, b] = edges[number];
    if (!planar_has_vertex(result.triangulation, a) || !planar_has_vertex(result.triangulation, b)) {
      throw std::invalid_argument("an edge to be triangulated ends in a vertex that is not among the vertices");
    }
    const PlanarConstraintResult inserted = planar_insert_constraint(result.triangulation, a, b, predicates);
    if (!inserted) {
      result.status = PlanarTriangulationResult::Status::crossing;
      result.crossing = {number_of_part(parts, inserted.obstacle), number};
      result.triangulation = {};
      return;
    }
    for (const PlanarEdge& part : inserted.parts) parts.push_back({part, number});
  }
}

}  // namespace planar

template <PlanarPredicates P>
PlanarTriangulationResult planar_triangulate(std::span<const VertexId> vertices, std::span<const PlanarEdge> edges,
                                             const P& predicates, const PlanarCarving& carving) {
  PlanarTriangulationResult result = planar_delaunay(vertices, predicates);
  if (!result) return result;
  planar::insert_edges(result, edges, predicates);
  if (!result) return result;

  PlanarTriangulation& t = result.triangulation;
  std::vector<bool> keep = planar::choose_inside(t, carving.outside);
  for (VertexId seed : carving.hole_seeds) {
    const std::uint32_t triangle = planar::locate(t, seed, 0, predicates);
    if (triangle == planar::none) {
      result.lost_seeds.push_back(seed);
    } else {
      planar::flood_hole(t, triangle, keep);
    }
  }
  if (std::find(keep.begin(), keep.end(), false) != keep.end()) t = planar::keep_triangles(t, keep);
  for (VertexId v : vertices) {
    if (!planar_has_vertex(t, v)) result.unused.push_back(v);
  }
  return result;
}

}  // namespace ccdt
