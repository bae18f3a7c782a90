#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "engine/base/index_lists.h"
#include "engine/delaunay/delaunay.h"
#include "engine/facets/facet_mesh.h"
#include "engine/front/advance_front.h"
#include "engine/front/find_apex.h"
#include "engine/front/near_vertices.h"
#include "engine/locate/cavity_locator.h"

namespace ccdt::front {

/// The candidates for an apex: the vertices near the face, or all.
enum class Search { near, full };

/// Finds the apex above a face with a locator of the whole model, so there is only one cavity.
template <class Locator>
class WholeModelFinder {
 public:
  WholeModelFinder(const facets::FacetMesh& facets, const delaunay::Delaunay& delaunay, Visibility visibility,
                   Locator locator)
      : facets_(facets), d_(delaunay), visibility_(visibility), locator_(std::move(locator)) {}

  /// \param region  above the face
  /// \param cavity  of the tetrahedron below the face; becomes the one of the tetrahedron above
  std::optional<std::uint32_t> find(const OrientedFace& face, RegionId /*region*/, Search /*all*/,
                                    std::uint32_t& /*cavity*/) const {
    return visibility_ == Visibility::faces ? find_apex_as_in_paper(locator_, facets_, d_, face)
                                            : find_apex(locator_, facets_, d_, face);
  }

  Search first_search() const { return Search::full; }
  std::uint32_t cavity_of_triangle(std::uint32_t /*triangle*/) const { return none; }
  std::size_t bytes() const { return locator_.bytes(); }

  /// The triangles that the front can meet.
  std::vector<std::uint32_t> triangles() const { return all_indices(facets_.triangles.size()); }

 private:
  const facets::FacetMesh& facets_;
  const delaunay::Delaunay& d_;
  Visibility visibility_;
  Locator locator_;
};

/// The same, cavity by cavity and region by region.
class CavityFinder {
 public:
  CavityFinder(const FrontInput& input, const FrontOptions& options, NearVertices& near)
      : facets_(input.facets),
        d_(input.delaunay),
        near_(near),
        all_faces_(!options.face_protection),
        visibility_(options.visibility),
        small_chamber_(options.small_chamber),
        locator_(input.plc, input.facets, input.codes, input.delaunay) {}

  std::optional<std::uint32_t> find(const OrientedFace& face, RegionId region, Search search, std::uint32_t& cavity) {
    if (all_faces_) {
      const auto& [a, b, c] = face.corners;
      if (const std::uint32_t code = delaunay::find_face(d_, a, b, c); code != no_neighbor) {
        cavity = locator_.cavity_of_cell(cell_of(code));
        if (cavity == none && d_.is_ghost(cell_of(code))) return std::nullopt;
        if (cavity == none) return d_.cells[cell_of(code)].vertices[face_of(code)];
      }
    }
    if (cavity == none) return std::nullopt;
    const locate::OctreeLocator* const chamber = locator_.chamber(cavity, region);
    if (chamber == nullptr) return std::nullopt;
    if (visibility_ == Visibility::faces) return find_apex_as_in_paper(*chamber, facets_, d_, face);
    if (chamber->vertex_count() <= small_chamber_) return find_apex(*chamber, facets_, d_, face);
    const auto near = find_near_apex(*chamber, facets_, d_, face, near_);
    return search == Search::near ? near : find_apex(*chamber, facets_, d_, face, near);
  }

  Search first_search() const { return Search::near; }
  std::uint32_t cavity_of_triangle(std::uint32_t triangle) const { return locator_.cavity_of_triangle(triangle); }
  std::size_t bytes() const { return locator_.bytes() + near_.bytes(); }

  std::vector<std::uint32_t> triangles() const {
    return all_faces_ ? all_indices(facets_.triangles.size()) : locator_.triangles();
  }

 private:
  const facets::FacetMesh& facets_;
  const delaunay::Delaunay& d_;
  NearVertices& near_;
  bool all_faces_;  // may the front hold Delaunay faces, outside the cavities too?
  Visibility visibility_;
  std::size_t small_chamber_;
  locate::CavityLocator locator_;
};

}  // namespace ccdt::front
