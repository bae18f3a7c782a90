#include "engine/planar/divide_and_conquer.h"

namespace ccdt::planar {

EdgeRings::Edge EdgeRings::add(VertexId from, VertexId to) {
  const auto e = static_cast<Edge>(origins.size());
  for (Edge side : {e, reverse(e)}) {
    origins.push_back(side == e ? from : to);
    next_around.push_back(side);
    previous_around.push_back(side);
  }
  removed.push_back(false);
  return e;
}

void EdgeRings::splice(Edge a, Edge b) {
  const Edge after_a = next_around[a], after_b = next_around[b];
  next_around[a] = after_b;
  previous_around[after_b] = a;
  next_around[b] = after_a;
  previous_around[after_a] = b;
}

EdgeRings::Edge EdgeRings::connect(Edge a, Edge b) {
  const Edge e = add(target(a), origin(b));
  splice(e, next_left(a));
  splice(reverse(e), b);
  return e;
}

void EdgeRings::remove(Edge e) {
  splice(e, previous_around[e]);
  splice(reverse(e), previous_around[reverse(e)]);
  removed[e / 2] = true;
}

}  // namespace ccdt::planar
