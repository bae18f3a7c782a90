#pragma once

#include "bench/verify/chains.h"

namespace ccdt::verification {

/// Sets of pieces that the mesh may triangulate as it likes, because their common edges are not in the mesh or need not
/// be.
struct Patches {
  std::vector<std::uint32_t> of_piece;
  std::vector<bool> flipped;                       ///< of each piece: is it against the orientation of its patch?
  std::vector<std::uint32_t> piece_begin, pieces;  ///< pieces of each patch
  std::vector<std::uint32_t> link_begin;           ///< links of each patch, see `links`
  std::vector<std::array<std::uint32_t, 2>>
      links;                           ///< directed mesh edges that bound the patch, which is to their left; sorted
  std::vector<bool> open;              ///< the mesh does not have all edges that bound the patch
  std::vector<Point3> normal, centre;  ///< of the plane of each patch
  std::vector<double> area, perimeter, thickness;  ///< projected area; greatest distance of a site from the plane

  std::uint32_t count() const { return static_cast<std::uint32_t>(open.size()); }
  std::span<const std::uint32_t> pieces_of(std::uint32_t patch) const {
    return std::span(pieces).subspan(piece_begin[patch], piece_begin[patch + 1] - piece_begin[patch]);
  }
  std::span<const std::array<std::uint32_t, 2>> links_of(std::uint32_t patch) const {
    return std::span(links).subspan(link_begin[patch], link_begin[patch + 1] - link_begin[patch]);
  }
};

/// Joins the two pieces at each edge that `joined` names.
/// \pre those edges have two pieces
Patches group_pieces(const Surface& surface, const Chains& chains, const std::vector<bool>& joined);

/// Is what the mesh has in place of a patch as good as the patch?
///
/// The faces must have been found to have the patch's directed links as their only open edges. Then, if no face is
/// turned over in the projection to the patch's plane, each point of the projected patch is covered once, and the areas
/// are equal. So this looks at: the patch being flat, all vertices near its plane, no face turned over, equal areas,
/// and all sites of the patch being vertices.
///
/// \param faces  oriented like the patch
/// \return       what is wrong; empty if nothing is
std::string compare_with_patch(const TetMesh& mesh, const Surface& surface, const Patches& patches, std::uint32_t patch,
                               std::span<const std::array<std::uint32_t, 3>> faces);

}  // namespace ccdt::verification
