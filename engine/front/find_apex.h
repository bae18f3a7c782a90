#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "engine/delaunay/delaunay.h"
#include "engine/facets/facet_mesh.h"
#include "engine/front/near_vertices.h"

namespace ccdt::front {

/// An oriented face by its corners, the smallest first. The space above it is not filled yet.
struct OrientedFace {
  std::array<std::uint32_t, 3> corners;

  OrientedFace(std::uint32_t a, std::uint32_t b, std::uint32_t c)
      : corners(a < b && a < c ? std::array{a, b, c}
                : b < c        ? std::array{b, c, a}
                               : std::array{c, a, b}) {}

  OrientedFace reversed() const { return {corners[0], corners[2], corners[1]}; }
  // Inline; that of std::array calls memcmp.
  friend bool operator==(const OrientedFace& f, const OrientedFace& g) {
    return f.corners[0] == g.corners[0] && f.corners[1] == g.corners[1] && f.corners[2] == g.corners[2];
  }
};

/// Finds the vertex that makes the constrained Delaunay tetrahedron above a face (paper, section 5.1).
///
/// First the vertex with the emptiest sphere is found without regard to facets. If it is visible, which is nearly
/// always true, no other can be better, and one test of visibility suffices. Otherwise every vertex that would be the
/// best so far is tested.
///
/// \tparam Locator  `GridLocator` or `OctreeLocator`, of all vertices and faces that may be near
/// \param seen_before  a vertex above the face and visible from it, if one is known: only better ones are tested
/// \return  nothing if no vertex above the face can be seen from it
template <class Locator>
std::optional<std::uint32_t> find_apex(const Locator& locator, const facets::FacetMesh& facets,
                                       const delaunay::Delaunay& delaunay, const OrientedFace& face,
                                       std::optional<std::uint32_t> seen_before = {});

/// The same by the paper's method (sections 4 and 5.1): every candidate must be visible from the three edges of the
/// face. It finds the same vertex: the apex of the constrained Delaunay tetrahedron passes all these tests, and every
/// vertex in its sphere is hidden from the centroid.
template <class Locator>
std::optional<std::uint32_t> find_apex_as_in_paper(const Locator& locator, const facets::FacetMesh& facets,
                                                   const delaunay::Delaunay& delaunay, const OrientedFace& face);

/// The same among the vertices near the face, then those near the best so far, until none of these is better. The
/// sphere of a large face may contain thousands of hidden vertices, which this search skips. So the apex is nearly
/// always right, but not certainly.
///
/// \return  nothing if none of the vertices is above the face and visible from it
template <class Locator>
std::optional<std::uint32_t> find_near_apex(const Locator& locator, const facets::FacetMesh& facets,
                                            const delaunay::Delaunay& delaunay, const OrientedFace& face,
                                            NearVertices& near);

}  // namespace ccdt::front
