#include "engine/label/label_cells.h"

#include <numeric>

namespace ccdt::label {
namespace {

/// Eight bits a cell: the faces that separate, set on both sides, and above them those that are open on this side.
using FaceBits = std::vector<std::uint8_t>;

CellLabels stuck_at(const plc::Plc& plc, const delaunay::Delaunay& d, std::uint32_t cell) {
  Place place;
  place.file = plc.name;
  for (const std::uint32_t v : d.cells[cell].vertices)
    if (v != delaunay::ghost_vertex) place.points.push_back(as_array(plc.grid.to_world(d.point(v))));
  return {{},
          MeshError("the front does not separate the inside from the outside", place,
                    "the facets near these points are almost but not quite flat: try another --flatness")};
}

std::uint32_t across(const delaunay::Delaunay& d, std::uint32_t code) {
  return d.cells[delaunay::cell_of(code)].neighbors[delaunay::face_of(code)];
}

FaceBits mark_walls(const delaunay::Delaunay& d, const std::vector<front::FrontFace>& open,
                    const std::vector<std::uint32_t>& wall_codes) {
  FaceBits bits(d.cells.size(), 0);
  const auto mark = [&](std::uint32_t code, unsigned what) {
    bits[delaunay::cell_of(code)] |= static_cast<std::uint8_t>(what << delaunay::face_of(code));
  };
  for (const std::uint32_t code : wall_codes) {
    if (code == delaunay::no_neighbor) continue;
    mark(code, 0x01);
    mark(across(d, code), 0x01);
  }
  for (const front::FrontFace& face : open) {
    mark(face.code, 0x11);
    mark(across(d, face.code), 0x01);
  }
  return bits;
}

/// The parts of the tetrahedralization between the walls: for every cell the first one of its part. A disjoint-set
/// forest in which parents have smaller numbers than their children, grown in the order of the cells, which follows
/// the memory; a flood would jump about in it.
std::vector<std::uint32_t> join_cells(const delaunay::Delaunay& d, const FaceBits& bits) {
  std::vector<std::uint32_t> parent(d.cells.size());
  std::iota(parent.begin(), parent.end(), 0u);
  const auto first_of = [&](std::uint32_t cell) {
    while (parent[cell] != cell) cell = parent[cell] = parent[parent[cell]];
    return cell;
  };
  for (std::uint32_t cell = 0; cell < d.cells.size(); ++cell) {
    if (d.is_dead(cell)) continue;
    const delaunay::Cell& its = d.cells[cell];
    std::uint32_t first = cell;
    for (std::uint32_t f = 0; f < 4; ++f) {
      const std::uint32_t neighbor = delaunay::cell_of(its.neighbors[f]);
      if (neighbor >= cell || (bits[cell] >> f & 1u)) continue;
      const std::uint32_t other = first_of(neighbor);
      if (other < first)
        first = parent[first] = other;
      else
        parent[other] = first;
    }
    parent[cell] = first;
  }
  for (std::uint32_t& its_parent : parent) its_parent = parent[its_parent];
  return parent;
}

/// A face of the PLC whose side towards a labeled cell was not open: the front has filled that side, so the labeled
/// part leaks into what the front has replaced.
/// \return a cell where this happens; `no_neighbor` if there is none
std::uint32_t find_leak(const delaunay::Delaunay& d, const FaceBits& bits, const std::vector<std::uint32_t>& wall_codes,
                        const std::vector<RegionId>& region) {
  for (const std::uint32_t code : wall_codes) {
    if (code == delaunay::no_neighbor) continue;
    for (const std::uint32_t side : {code, across(d, code)}) {
      const std::uint32_t cell = delaunay::cell_of(side);
      if (!region[cell].is_none() && !(bits[cell] >> delaunay::face_of(side) & 0x10u)) return cell;
    }
  }
  return delaunay::no_neighbor;
}

}  // namespace

CellLabels label_cells(const plc::Plc& plc, const delaunay::Delaunay& d, const std::vector<front::FrontFace>& open,
                       const std::vector<std::uint32_t>& wall_codes) {
  const FaceBits bits = mark_walls(d, open, wall_codes);
  const std::vector<std::uint32_t> first = join_cells(d, bits);
  std::vector<RegionId> region(d.cells.size());
  for (const front::FrontFace& face : open) {
    RegionId& its = region[first[delaunay::cell_of(face.code)]];
    if (!its.is_none() && its != face.region) return stuck_at(plc, d, delaunay::cell_of(face.code));
    its = face.region;
  }
  for (std::uint32_t cell = 0; cell < d.cells.size(); ++cell) {
    region[cell] = region[first[cell]];
    if (!region[cell].is_none() && d.is_ghost(cell)) return stuck_at(plc, d, cell);
  }
  const std::uint32_t leak = find_leak(d, bits, wall_codes, region);
  if (leak != delaunay::no_neighbor) return stuck_at(plc, d, leak);
  return {std::move(region)};
}

}  // namespace ccdt::label
