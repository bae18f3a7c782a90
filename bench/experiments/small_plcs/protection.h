#pragma once

#include <vector>

#include "bench/experiments/small_plcs/small_plc.h"

namespace ccdt::small {

/// The premise of the paper's Theorem 1 (section 5.2), part by part, and what explains it.
struct ProtectionState {
  bool edges = false;             ///< every grazeable segment is strongly Delaunay
  bool all_segments = false;      ///< every segment is
  bool faces = false;             ///< every facet is filled by strongly Delaunay triangles of its corners
  bool missing_is_loose = false;  ///< every grazeable segment that is not strongly Delaunay is the edge of no facet
  bool premise() const { return edges && faces; }
};
ProtectionState protection_of(const SmallPlc& plc);

/// The segments with a sector of the domain of 180 degrees or more around them (Shewchuk 2002).
std::vector<Edge> grazeable_segments(const SmallPlc& plc);

/// Is there a sphere through both vertices with all others strictly outside? Such spheres have two degrees of freedom
/// and each other vertex allows half a plane of them, so there is one if there is one for any three of the others
/// (Helly 1923); and for three it is a matter of signs.
bool is_strongly_delaunay(const std::vector<Point>& vertices, const Edge& edge);

/// Is there a sphere through the three vertices with all others strictly outside? Here there is one degree of freedom,
/// and any two of the others decide.
bool is_strongly_delaunay(const std::vector<Point>& vertices, const Triangle& triangle);

/// Do the strongly Delaunay triangles of the corners of a facet fill it?
bool is_protected(const SmallPlc& plc, const Polygon& facet);

}  // namespace ccdt::small
