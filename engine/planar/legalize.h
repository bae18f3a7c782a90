#pragma once

#include <algorithm>

#include "engine/planar/local_steps.h"
#include "engine/planar/topology.h"
#include "engine/planar/triangulation.h"

namespace ccdt {

template <PlanarPredicates P>
std::size_t planar_legalize(PlanarTriangulation& t, const P& predicates) {
  std::vector<std::uint32_t> stack;
  for (std::uint32_t packed = 0; packed < 3 * t.triangles.size(); ++packed) {
    const PlanarSide s = planar::unpack(packed);
    const std::uint32_t other = planar::neighbor(t, s);
    if (other != planar::none && s.triangle < other) stack.push_back(packed);
  }
  return planar::legalize_from(t, stack, predicates);
}

template <PlanarPredicates P>
bool planar_split_edge(PlanarTriangulation& t, VertexId a, VertexId b, VertexId v, const P& predicates) {
  const std::optional<PlanarSide> side = planar_find_edge(t, a, b);
  if (!side) return false;
  planar::split_side(t, *side, v, predicates);
  return true;
}

template <PlanarPredicates P>
PlanarInsertion planar_insert_vertex(PlanarTriangulation& t, VertexId v, const P& predicates, VertexId near) {
  if (planar_has_vertex(t, v)) return PlanarInsertion::on_vertex;
  if (t.triangles.empty()) return PlanarInsertion::outside;
  const std::uint32_t hint = t.triangle_of_vertex.get(planar::vertex_key(near));
  const std::uint32_t triangle = planar::locate(t, v, hint == planar::none ? 0 : hint, predicates);
  if (triangle == planar::none) return PlanarInsertion::outside;
  const std::array<int, 3> signs = planar::signs_at_edges(t, triangle, v, predicates);
  const auto zeros = std::count(signs.begin(), signs.end(), 0);
  if (zeros == 2) return PlanarInsertion::on_vertex;
  if (zeros == 0) {
    planar::split_triangle(t, triangle, v, predicates);
  } else {
    const auto corner = static_cast<std::uint32_t>(std::find(signs.begin(), signs.end(), 0) - signs.begin());
    planar::split_side(t, {triangle, corner}, v, predicates);
  }
  return PlanarInsertion::inserted;
}

}  // namespace ccdt
