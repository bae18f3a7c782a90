#pragma once

#include <unordered_map>

#include "bench/verify/match_facets.h"
#include "bench/verify/regions.h"
#include "bench/verify/verify.h"

namespace ccdt::verify {

/// The region of the input of each tetrahedron.
struct RegionsOfTetrahedra {
  std::vector<std::uint32_t> region;     ///< by tetrahedron; `none` for those that no facet bounds
  std::vector<std::uint32_t> conflicts;  ///< tetrahedra that are reached from two regions without crossing a facet
  /// For each tetrahedron within an interior facet that is flat only within the tolerance: the region on the other side
  /// of the facet, to which it could belong as well.
  std::unordered_map<std::uint32_t, std::uint32_t> other_region;
};

/// Flood fills the mesh from the faces on facets.
/// \param flat  how far from its plane an interior facet reaches
RegionsOfTetrahedra assign_regions(const Topology& topology, const Regions& regions, const FacetMatches& matches,
                                   double flat);

/// Decides undetermined regions: they are inside if the mesh fills them.
void resolve_unknown(const RegionsOfTetrahedra& assigned, Regions& regions);

/// The name of the check that compares the regions of tetrahedra with those of the input.
inline constexpr const char* regions_check = "regions";

double mesh_volume(const mesh::TetMesh& mesh);
/// \pre  the sides of the facets are in regions
double input_volume(const Surface& surface, const Regions& regions);

/// Checks that the mesh fills the domain and its regions, and adds the checks and both volumes to the result.
void check_domain(const plc::InputPlc& input, const mesh::TetMesh& mesh, const Surface& surface, const Regions& regions,
                  const RegionsOfTetrahedra& assigned, Verification& result);

}  // namespace ccdt::verify
