#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "engine/delaunay/delaunay.h"
#include "engine/facets/facet_mesh.h"
#include "engine/front/front_faces.h"
#include "engine/locate/grid_locator.h"

namespace ccdt {

/// Finds the vertex that makes the constrained Delaunay tetrahedron above a face (paper, section 5.1).
class ApexFinder {
 public:
  ApexFinder(const FacetMesh& facets, const Delaunay& delaunay);

  /// Nothing if no vertex above the face can be seen from it.
  std::optional<std::uint32_t> find(const OrientedFace& face);

 private:
  bool is_better(std::uint32_t v) const;
  bool is_in_sphere(std::uint32_t v) const;
  bool is_visible(std::uint32_t v) const;

  const FacetMesh& facets_;
  const Delaunay& d_;
  GridLocator locator_;
  // The face at hand and the best vertex for it so far.
  std::array<std::uint32_t, 3> face_{};
  std::uint32_t best_ = ghost_vertex;
};

}  // namespace ccdt
