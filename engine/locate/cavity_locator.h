#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/hash_table.h"
#include "engine/delaunay/delaunay.h"
#include "engine/facets/facet_mesh.h"
#include "engine/locate/octree_locator.h"

namespace ccdt::locate {

/// The Delaunay cells that missing faces go through, in parts that are connected through their faces.
struct PiercedCells {
  std::vector<std::uint32_t> part_of_face;          ///< of each missing face
  std::vector<std::vector<std::uint32_t>> cells;    ///< of each part
  HashTable<std::uint32_t, std::uint32_t> part_of;  ///< by cell
};

/// Finds vertices near a face and PLC faces near an edge within the *cavity* of the face alone: a connected part of the
/// Delaunay cells that missing faces go through. All other cells of the domain are constrained Delaunay already. So all
/// new cells are inside the cavities, and the cost depends on these, not on the model.
///
/// Why a cavity is enough. Let t be the constrained Delaunay cell above a face f in a cavity, and p a vertex in the
/// sphere of t. Follow the straight line from f to p. Each face that it passes before it meets a facet is locally
/// Delaunay. So if p is in the sphere of the cell in front of such a face, it is also in the sphere of the cell behind
/// it, or a corner of that cell (beyond the face, the power to the second sphere is smaller). If the line left the
/// cavity before it met a facet, it would be in an outside cell that is truly Delaunay, whose sphere is empty, and
/// could not reach p: a contradiction. So p is hidden, and by a face that is missing in this cavity or is a face of its
/// cells. Vertices outside the sphere of t do no harm, whether hidden or not; and the apex of t is itself a corner of
/// the cavity, since t is within it. Unneeded cells do no harm either.
///
/// Nothing of other regions is needed either: a line of sight leaves its region only through a face on the region's
/// boundary. So a cavity has *chambers*, one for each region of the domain in it. Between thin plates, most vertices in
/// the sphere of a face belong to other regions.
class CavityLocator {
 public:
  /// \param facets  of the PLC
  /// \param codes   the Delaunay faces by their codes in the cell above; `no_neighbor` entries are searched again
  CavityLocator(const plc::Plc& plc, const facets::FacetMesh& facets, std::span<const std::uint32_t> codes,
                const delaunay::Delaunay& delaunay);

  /// The vertices and faces of a cavity that belong to a region of the domain. `nullptr` if there are none: only a
  /// front that is stuck elsewhere gets there.
  const OctreeLocator* chamber(std::uint32_t cavity, RegionId region) const;
  std::size_t cavity_count() const { return cavities_.size(); }

  std::size_t bytes() const {
    std::size_t bytes = bytes_of(missing_, triangles_, pierced_.part_of_face) + pierced_.part_of.bytes();
    for (const auto& chambers : cavities_)
      for (const Chamber& chamber : chambers) bytes += chamber.locator.bytes();
    for (const auto& cells : pierced_.cells) bytes += bytes_of(cells);
    return bytes;
  }

  /// The cavity that a Delaunay cell is in, if any.
  std::uint32_t cavity_of_cell(std::uint32_t cell) const;
  /// The cavity that a missing face of the PLC is in; none for Delaunay faces.
  std::uint32_t cavity_of_triangle(std::uint32_t triangle) const;

  /// The triangles that a front within the cavities can meet: the missing ones, and the faces of the cavities' cells.
  const std::vector<std::uint32_t>& triangles() const { return triangles_; }

 private:
  struct Chamber {
    RegionId region;
    OctreeLocator locator;
  };

  std::vector<std::uint32_t> missing_;  // ascending
  PiercedCells pierced_;
  std::vector<std::uint32_t> triangles_;
  std::vector<std::vector<Chamber>> cavities_;
};

}  // namespace ccdt::locate
