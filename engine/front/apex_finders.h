#pragma once

#include <cstdint>
#include <numeric>
#include <optional>
#include <vector>

#include "engine/front/find_apex.h"
#include "engine/locate/cavity_locator.h"
#include "engine/locate/grid_locator.h"
#include "engine/locate/octree_locator.h"

namespace ccdt {

/// The numbers of all faces of the PLC.
inline std::vector<std::uint32_t> all_triangles(const FacetMesh& facets) {
  std::vector<std::uint32_t> all(facets.triangles.size());
  std::iota(all.begin(), all.end(), 0u);
  return all;
}

/// What the front asks: which vertex makes the tetrahedron above a face. Here with a locator of the whole model, so
/// that there is but one cavity.
template <class Locator>
class WholeModelFinder {
 public:
  WholeModelFinder(const FacetMesh& facets, const Delaunay& delaunay, const Locator& locator)
      : facets_(facets), d_(delaunay), locator_(locator) {}

  /// \param cavity  of the tetrahedron below the face; becomes that of the one above it
  std::optional<std::uint32_t> find(const OrientedFace& face, std::uint32_t& /*cavity*/) const {
    return find_apex(locator_, facets_, d_, face);
  }

  std::uint32_t cavity_of_triangle(std::uint32_t /*triangle*/) const { return CavityLocator::no_cavity; }

  /// The triangles that the front can meet.
  std::vector<std::uint32_t> triangles() const { return all_triangles(facets_); }

 private:
  const FacetMesh& facets_;
  const Delaunay& d_;
  Locator locator_;
};

/// The same, cavity by cavity.
class CavityFinder {
 public:
  /// \param all_faces  may the front hold Delaunay faces, outside of the cavities too?
  CavityFinder(const FacetMesh& facets, const std::vector<std::uint32_t>& codes, bool all_faces,
               const Delaunay& delaunay, CellStar& star)
      : facets_(facets), d_(delaunay), star_(star), all_faces_(all_faces), locator_(facets, codes, delaunay, star) {}

  std::optional<std::uint32_t> find(const OrientedFace& face, std::uint32_t& cavity) {
    if (all_faces_) {
      const auto& [a, b, c] = face.corners;
      if (const std::uint32_t code = star_.find_face(a, b, c); code != no_neighbor) {
        cavity = locator_.cavity_of_cell(cell_of(code));
        if (cavity == CavityLocator::no_cavity) return apex_of_cell(code);
      }
    }
    if (cavity == CavityLocator::no_cavity) return std::nullopt;
    return find_apex(locator_.cavity(cavity), facets_, d_, face);
  }

  std::uint32_t cavity_of_triangle(std::uint32_t triangle) const { return locator_.cavity_of_triangle(triangle); }

  std::vector<std::uint32_t> triangles() const { return all_faces_ ? all_triangles(facets_) : locator_.triangles(); }

 private:
  std::optional<std::uint32_t> apex_of_cell(std::uint32_t code) const {
    if (d_.is_ghost(cell_of(code))) return std::nullopt;
    return d_.cells[cell_of(code)].vertices[face_of(code)];
  }

  const FacetMesh& facets_;
  const Delaunay& d_;
  CellStar& star_;
  bool all_faces_;
  CavityLocator locator_;
};

}  // namespace ccdt
