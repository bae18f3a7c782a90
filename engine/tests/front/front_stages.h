#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "engine/front/advance_front.h"
#include "engine/front/find_delaunay_faces.h"
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
  plc::Plc plc;
  delaunay::Delaunay delaunay;
  protection::SegmentChains chains;
  facets::FacetMesh facets;
  std::vector<std::uint32_t> codes;

  explicit Stages(const plc::InputPlc& input)
      : plc(plc::build_plc(input)), delaunay(delaunay::build_delaunay(plc.vertices)) {
    protection::ProtectedDelaunay surface = protection::protect_edges(
        plc, protection::unprotected(plc, std::move(delaunay)), protection::Protection::shell);
    delaunay = std::move(surface.delaunay);
    chains = std::move(surface.chains);
    facets = facets::triangulate_facets(plc, chains, delaunay);
    codes = front::find_delaunay_faces(facets.triangles, delaunay);
  }

  std::size_t undelaunay() const { return std::count(codes.begin(), codes.end(), delaunay::no_neighbor); }
  front::FrontResult advance(const front::FrontOptions& options = {}) const {
    return front::advance_front({plc, facets, codes, delaunay}, options);
  }
  /// Every face goes through the front.
  front::FrontResult advance_all(front::FrontOptions options = {}) const {
    options.face_protection = false;
    return front::advance_front(
        {plc, facets, std::vector<std::uint32_t>(codes.size(), delaunay::no_neighbor), delaunay}, options);
  }
};

}  // namespace ccdt::mesh_test
