#pragma once

#include <span>
#include <string>

#include "bench/verify/surface.h"

namespace ccdt::verify {

/// Must a mesh contain the edge, because it is not between two facets in one plane with one marker?
std::vector<bool> find_features(const Surface& surface);

/// For each of a list of straight edges between sites, the vertices of the chain of mesh edges along it, both ends
/// included; none if the mesh has no such chain.
struct Chains : IndexLists {
  bool missing(std::size_t edge) const { return of(edge).empty(); }
};

/// A vertex is on an edge if it is within `tolerances.place` of it.
Chains find_chains(const Topology& topology, const Surface& surface, std::span<const Edge> edges);

/// Sets of pieces that the mesh may triangulate freely, because their common edges are missing or not required.
struct Patches {
  std::vector<std::uint32_t> of_piece;
  std::vector<bool> flipped;            ///< of each piece: is it against the orientation of its patch?
  IndexLists pieces;                    ///< of each patch
  std::vector<std::size_t> first_link;  ///< of each patch, in `links`; then how many there are
  RawVector<Edge> links;                ///< directed mesh edges around the patches, which are to their left; sorted
  std::vector<std::uint8_t> open;       ///< the mesh does not have all edges that bound the patch
  std::vector<Point3> normal, center;   ///< of the plane of each patch
  std::vector<double> area, perimeter, thickness;  ///< projected area; greatest distance of a site from the plane

  std::uint32_t count() const { return static_cast<std::uint32_t>(open.size()); }
  std::span<const Edge> links_of(std::uint32_t patch) const {
    return {links.data() + first_link[patch], links.data() + first_link[patch + 1]};
  }
  double height(std::uint32_t patch, const Point3& p) const { return dot(normal[patch], p - center[patch]); }
};

/// Joins the two pieces at each edge that `joined` names.
/// \param chains  of the surface's edges
/// \pre           those edges have two pieces
Patches group_pieces(const Surface& surface, const Chains& chains, const std::vector<bool>& joined);

/// The same without a mesh, so without links.
Patches group_pieces(const Surface& surface, const std::vector<bool>& joined);

/// Are faces of the mesh equivalent to a patch?
///
/// The faces must have been found to have the patch's directed links as their only open edges. Then, if no face is
/// turned over in the projection to the patch's plane, each point of the projected patch is covered once, and the areas
/// are equal. So it checks that the patch is flat, all vertices are near its plane, no face is turned over, the areas
/// are equal, and all sites of the patch are vertices.
///
/// \param faces  oriented like the patch
/// \return       the error; empty if there is none
std::string compare_with_patch(const mesh::TetMesh& mesh, const Surface& surface, const Patches& patches,
                               std::uint32_t patch, std::span<const Face> faces);

}  // namespace ccdt::verify
