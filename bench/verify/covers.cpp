#include "bench/verify/covers.h"

#include <algorithm>
#include <cmath>

namespace ccdt::verification {

namespace {

/// The vertex of a piece that is farthest from the line ab.
Point3 farthest_from(const Surface& surface, std::uint32_t piece, const Point3& a, const Point3& axis) {
  Point3 farthest = a;
  double best = -1;
  for (std::uint32_t i = surface.piece_begin[piece]; i < surface.piece_begin[piece + 1]; ++i) {
    const Point3 p = surface.at(surface.directed[i][0]);
    const double distance = squared_length(cross(axis, p - a));
    if (distance <= best) continue;
    best = distance;
    farthest = p;
  }
  return farthest;
}

/// How far two pieces at an edge are from lying in one plane: the least altitude of the tetrahedron that they span,
/// which is small for needles whatever their normal.
double fold_width(const Surface& surface, std::uint32_t edge) {
  const Point3 a = surface.at(surface.edges[edge][0]), b = surface.at(surface.edges[edge][1]);
  const std::uint32_t* use = &surface.uses[surface.use_begin[edge]];
  const Point3 u = farthest_from(surface, surface.piece_of[use[0]], a, b - a) - a;
  const Point3 v = farthest_from(surface, surface.piece_of[use[1]], a, b - a) - a;
  const Point3 axis = b - a;
  const double base = std::max({squared_length(cross(axis, u)), squared_length(cross(axis, v)),
                                squared_length(cross(u, v)), squared_length(cross(u - axis, v - axis))});
  return base > 0 ? std::fabs(dot(axis, cross(u, v))) / std::sqrt(base) : 0;
}

/// Do two pieces lie on each other, as the two leaves of a closed book?
bool folds_back(const Surface& surface, std::uint32_t edge) {
  const std::uint32_t* use = &surface.uses[surface.use_begin[edge]];
  const double along =
      dot(surface.area_vector[surface.piece_of[use[0]]], surface.area_vector[surface.piece_of[use[1]]]);
  return (along < 0) == (surface.is_forward(use[0]) != surface.is_forward(use[1])) && along != 0;
}

}  // namespace

std::vector<bool> find_features(const Surface& surface) {
  std::vector<bool> features(surface.edges.size(), true);
  for (std::uint32_t e = 0; e < surface.edges.size(); ++e) {
    if (surface.use_count(e) != 2) continue;
    const std::uint32_t* use = &surface.uses[surface.use_begin[e]];
    features[e] = surface.marker[surface.piece_of[use[0]]] != surface.marker[surface.piece_of[use[1]]] ||
                  fold_width(surface, e) > surface.tolerances.flat;
    if (!features[e] && folds_back(surface, e)) {
      // Two leaves of one needle are as good as flat; two broad ones are a fold that the surface may not lose.
      const double length =
          std::sqrt(squared_length(surface.at(surface.edges[e][0]) - surface.at(surface.edges[e][1])));
      const auto broad = [&](std::uint32_t u) {
        return std::sqrt(squared_length(surface.area_vector[surface.piece_of[u]])) > surface.tolerances.flat * length;
      };
      features[e] = broad(use[0]) && broad(use[1]);
    }
  }
  return features;
}

Covers find_covers(const TetMesh& mesh, const Topology& topology, const Surface& surface, const Chains& chains,
                   const std::vector<bool>& features) {
  Covers covers;
  covers.found.assign(surface.pieces(), Found::nothing);
  covers.problem.resize(surface.pieces());
  covers.covers.assign(topology.faces.size(), false);
  cover_boundary(mesh, topology, surface, chains, covers);
  cover_interior(mesh, topology, surface, chains, features, covers);
  for (const CoverFace& f : covers.faces) covers.covers[f.face] = true;
  return covers;
}

}  // namespace ccdt::verification
