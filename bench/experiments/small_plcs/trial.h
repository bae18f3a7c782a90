#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "bench/experiments/small_plcs/small_plc.h"

namespace ccdt::small_plcs {

using Tetrahedron = std::array<Vertex, 4>;  ///< in increasing order

inline std::array<Point, 4> points_of(const std::vector<Point>& vertices, const Tetrahedron& t) {
  return {vertices[t[0]], vertices[t[1]], vertices[t[2]], vertices[t[3]]};
}
inline Triangle face_opposite(const Tetrahedron& t, unsigned i) {
  return triangle_of(t[(i + 1) % 4], t[(i + 2) % 4], t[(i + 3) % 4]);
}

/// Is no vertex strictly inside the circumsphere of a tetrahedron?
bool is_delaunay(const std::vector<Point>& vertices, const Tetrahedron& tetrahedron);

/// The tetrahedra that are possible on their own in a tetrahedralization of a PLC: not flat, in the domain, without
/// other vertices, crossed by no facet or segment.
std::vector<Tetrahedron> possible_tetrahedra(const SmallPlc& plc);

/// Do the possible tetrahedra that are Delaunay fill the domain and have all segments as edges? Then they are the DT of
/// the paper's Theorem 1. \pre generic, so that Delaunay tetrahedra do not overlap
bool has_delaunay_tetrahedralization(const SmallPlc& plc);

/// The result of an exhaustive search for constrained Delaunay tetrahedralizations.
struct SearchResult {
  std::size_t constrained_delaunay = 0;  ///< how many there are; a generic PLC has at most one
  bool some_is_delaunay = false;         ///< there is one whose tetrahedra are all Delaunay
  std::vector<Tetrahedron> first = {};   ///< one of them, sorted
};

/// Tries all ways to fill the domain with possible tetrahedra such that all segments are edges, all vertices are used,
/// and each face that is on no facet is locally Delaunay; these are the constrained Delaunay tetrahedralizations
/// (Shewchuk 2008, the Delaunay lemma). The search does not rely on the fact that the tetrahedra of a DT are Delaunay.
SearchResult search_constrained_delaunay(const SmallPlc& plc);

/// The parts of the premise of the paper's Theorem 1 (section 5.2), and a fact that explains a violation.
struct ProtectionState {
  bool edges = false;             ///< every grazeable segment is strongly Delaunay
  bool faces = false;             ///< every facet is filled by strongly Delaunay triangles of its corners
  bool missing_is_loose = false;  ///< every grazeable segment that is not strongly Delaunay is the edge of no facet
  bool premise() const { return edges && faces; }
};
ProtectionState protection_of(const SmallPlc& plc);

/// The segments with a sector of the domain of 180 degrees or more around them (Shewchuk 2002).
std::vector<Edge> grazeable_segments(const SmallPlc& plc);

/// Is there a sphere through both vertices with all others strictly outside? The centers of spheres through both form a
/// plane, in which each other vertex allows a half-plane. So there is such a sphere if there is one for any three of
/// the others (Helly 1923); for three, signs decide.
bool is_strongly_delaunay(const std::vector<Point>& vertices, const Edge& edge);

/// Is there a sphere through the three vertices with all others strictly outside? Here there is one degree of freedom,
/// and any two of the others decide.
bool is_strongly_delaunay(const std::vector<Point>& vertices, const Triangle& triangle);

/// Do the strongly Delaunay triangles of the corners of a facet fill it?
bool is_protected(const SmallPlc& plc, const Polygon& facet);

/// The result of the engine for a small PLC, without a lattice and without improvement.
struct EngineAnswer {
  bool is_protected = false;  ///< no Steiner vertex, and no face that is not Delaunay
  bool has_steiner_vertices = false;
  std::vector<Tetrahedron> tetrahedra = {};  ///< sorted; only without Steiner vertices
  std::string failure = {};                  ///< why there is no answer
};
EngineAnswer ask_engine(const SmallPlc& plc);

/// All results for one PLC.
struct Trial {
  SmallPlc plc;
  ProtectionState protection = {};
  bool has_dt = false;  ///< the theorem's conclusion: there is a constrained Delaunay tetrahedralization of Delaunay
                        ///< tetrahedra
  SearchResult search = {};
  EngineAnswer engine = {};
  /// A disagreement between our own methods, which would make the trial worthless; empty: none.
  std::string disagreement = {};
};
Trial try_plc(SmallPlc plc, bool is_cospherical);

/// The effect of one interior point on small random PLCs of a family that have a constrained Delaunay
/// tetrahedralization.
struct ExistenceTrials {
  std::string family;
  std::uint64_t cases = 0;
  std::uint64_t lost = 0;        ///< that have none with the point
  SmallPlc counterexample = {};  ///< of these the first with the fewest vertices; the point is its last vertex
};

/// The PLC with a point inside, strictly and in general position; empty if none is found.
/// \param seed  of the draws
SmallPlc with_interior_point(const SmallPlc& plc, std::uint64_t seed);

/// Tests existence by exhaustive search, without and with the point, for this many PLCs of each family in general
/// position.
std::vector<ExistenceTrials> try_interior_points(std::uint64_t cases_per_family);

}  // namespace ccdt::small_plcs
