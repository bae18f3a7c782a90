#pragma once

#include <unordered_map>

#include "bench/verify/covers.h"
#include "bench/verify/verify.h"

namespace ccdt::verification {

/// The region of each tetrahedron, `none` for those that no facet bounds.
struct Rooms {
  std::vector<std::uint32_t> region;
  std::vector<std::uint32_t> conflicts;  ///< tetrahedra that are reached from two regions without crossing a facet
  /// Of each tetrahedron that lies within an interior facet, since that is flat only within the tolerance: the region
  /// on the other side of the facet. It could as well be there.
  std::unordered_map<std::uint32_t, std::uint32_t> beyond;
};

/// Floods the mesh from the faces that stand for facets.
/// \param flat  how far from its plane an interior facet reaches
Rooms find_rooms(const TetMesh& mesh, const Topology& topology, const Regions& regions, const Covers& covers,
                 double flat);

/// Decides the regions of which the input does not tell whether they are inside, by whether the mesh fills them.
void resolve_unknown(const Rooms& rooms, Regions& regions);

/// Every tetrahedron is in one region, and that is inside.
Check check_rooms(const TetMesh& mesh, const Regions& regions, const Rooms& rooms);

/// A tetrahedron has the attribute of the region seed in its region; without a seed, the same as all in the region.
/// One that lies within an interior facet may have the attribute of either side.
Check check_regions(const TetMesh& mesh, const Regions& regions, const Rooms& rooms);

/// No tetrahedron is in a region with a hole's point.
Check check_holes(const InputPlc& input, const Regions& regions, const Rooms& rooms);

double mesh_volume(const TetMesh& mesh);
double input_volume(const Surface& surface, const Regions& regions);

/// The volumes are equal to 1e-9, and what moving the surface within the tolerance can change.
Check check_volume(const Surface& surface, const Regions& regions, double of_mesh, double of_input);

}  // namespace ccdt::verification
