#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "engine/front/advance_front.h"
#include "engine/front/face_check.h"
#include "engine/plc/build_plc.h"
#include "engine/protection/protect_edges.h"

namespace ccdt::mesh_test {

using Cells = std::vector<std::array<std::uint32_t, 4>>;

/// Sorted lists of sorted vertices.
inline Cells sorted(Cells cells) {
  for (auto& cell : cells) std::sort(cell.begin(), cell.end());
  std::sort(cells.begin(), cells.end());
  return cells;
}

/// All that the front works on, without interior points.
struct Stages {
  Plc plc;
  Delaunay delaunay;
  SegmentChains chains;
  FacetMesh facets;
  std::vector<std::uint32_t> codes;

  explicit Stages(const InputPlc& input) : plc(build_plc(input)), delaunay(build_delaunay(plc.vertices)) {
    ProtectedDelaunay surface = protect_edges(plc, unprotected(plc, std::move(delaunay)), Protection::shell);
    delaunay = std::move(surface.delaunay);
    chains = std::move(surface.chains);
    facets = triangulate_facets(plc, chains, delaunay);
    codes = find_delaunay_faces(facets, delaunay);
  }

  std::size_t undelaunay() const { return std::count(codes.begin(), codes.end(), no_neighbor); }
  FrontResult advance(const FrontOptions& options = {}) const {
    return advance_front({plc, facets, codes, delaunay}, options);
  }
  /// Every face goes through the front.
  FrontResult advance_all(FrontOptions options = {}) const {
    options.face_protection = false;
    return advance_front({plc, facets, std::vector<std::uint32_t>(codes.size(), no_neighbor), delaunay}, options);
  }
};

}  // namespace ccdt::mesh_test
