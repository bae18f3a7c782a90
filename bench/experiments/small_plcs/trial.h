#pragma once

#include <string>
#include <vector>

#include "bench/experiments/small_plcs/small_plc.h"
#include "bench/experiments/small_plcs/tetrahedralization.h"

namespace ccdt::small_plcs {

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

/// What the engine made of a small PLC, without a lattice and without improvement.
struct EngineAnswer {
  bool is_protected = false;  ///< no Steiner vertex, and no face that is not Delaunay
  bool has_steiner_vertices = false;
  std::vector<Tetrahedron> tetrahedra = {};  ///< sorted; only without Steiner vertices
  std::string failure = {};                  ///< why there is no answer
};
EngineAnswer ask_engine(const SmallPlc& plc);

/// One PLC, seen from all sides.
struct Trial {
  SmallPlc plc;
  ProtectionState protection = {};
  bool has_dt = false;  ///< the theorem's conclusion: there is a constrained Delaunay tetrahedralization of Delaunay
                        ///< tetrahedra
  SearchResult search = {};
  EngineAnswer engine = {};
  /// What our own parts disagree about among themselves, which would make the trial worthless; empty: nothing.
  std::string disagreement = {};
};
Trial try_plc(SmallPlc plc, bool is_cospherical);

}  // namespace ccdt::small_plcs
