#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/tets/cell_complex.h"
#include "engine/tets/fill_polyhedron.h"

namespace ccdt::steiner {

using tets::CellComplex, tets::CellMarks, tets::Change, tets::PolyhedronFiller;

/// How to remove a vertex, in the order of the effort.
enum class RemovalEffort {
  collapse,  ///< move it onto a neighbor on the segment
  fill       ///< search for other tetrahedra in place of those around it
};

/// Plans to remove vertices that split segments.
///
/// The facets at a segment are like the pages of a book: they divide the star of a vertex on the segment into sectors.
/// Without the vertex, the faces around it on each page are replaced by a triangulation of their polygon. Then each
/// sector is a polyhedron to be filled.
class VertexRemoval {
 public:
  explicit VertexRemoval(const CellComplex& complex) : x_(complex), filler_(complex) {}

  /// Plans to remove a vertex inside a segment, with `neighbors` before and after it on the segment. All cells around
  /// it are replaced, and on each facet the faces around it. The new cells are exactly positive.
  ///
  /// The domain must not touch itself along the segment (`plc::Segment::touching`).
  ///
  /// \return is there a plan?
  bool plan(std::uint32_t vertex, const std::array<std::uint32_t, 2>& neighbors, RemovalEffort effort, Change& change);

 private:
  using Triangle = std::array<std::uint32_t, 3>;

  /// A face around the vertex, on a facet.
  struct FaceAtVertex {
    std::uint32_t face;      ///< its number
    std::uint32_t from, to;  ///< its other corners, in the orientation of the facet
  };

  /// The faces around the vertex on one facet, from one neighbor to the other.
  struct Page {
    std::vector<std::uint32_t> faces;
    std::vector<std::uint32_t> polygon;  ///< without the vertex; the first and the last are the neighbors
    std::uint32_t facet;
    std::vector<Triangle> triangles;  ///< instead of the faces
  };

  /// The space around the vertex between two pages.
  struct Sector {
    int region;
    std::vector<Triangle> hull;  ///< its faces except on pages, the inside above
    struct Side {
      std::uint32_t page;
      bool is_above;  ///< is the sector above the page?
      bool operator==(const Side&) const = default;
    };
    std::vector<Side> pages;
  };

  bool find_pages();
  bool follow_page(std::size_t first, Page& page) const;
  void find_sectors();
  void add_pages(std::uint32_t cell, Sector& sector) const;
  bool find_fan(Page& page, std::size_t from);
  bool plan_better_collapse(Change& change);
  bool plan_collapse(std::size_t end, Change& change);
  bool plan_fill(Change& change);
  bool fill_sectors(std::size_t page, Change& change);
  bool fill_sector(const Sector& sector, Change& change);
  bool is_on_hull(const Triangle& triangle) const;
  void replace_star(Change& change) const;

  const CellComplex& x_;
  PolyhedronFiller filler_;
  std::uint32_t vertex_ = 0;
  std::array<std::uint32_t, 2> neighbors_{};

  // Working memory.
  CellMarks marks_;
  std::vector<std::uint32_t> star_;
  std::vector<FaceAtVertex> faces_;
  std::vector<Page> pages_;
  std::vector<Sector> sectors_;
  std::vector<std::uint32_t> connected_;
  std::vector<Triangle> hull_;
  Change other_;
};

}  // namespace ccdt::steiner
