#include "engine/label/label_cells.h"

namespace ccdt {
namespace {

/// Four bits a cell, one a face.
using FaceBits = std::vector<std::uint8_t>;

void set(FaceBits& bits, std::uint32_t code) {
  bits[cell_of(code)] |= static_cast<std::uint8_t>(1u << face_of(code));
}
bool has(const FaceBits& bits, std::uint32_t cell, std::uint32_t face) {
  return bits[cell] >> face & 1u;
}

[[noreturn]] void fail(const Plc& plc, const Delaunay& d, std::uint32_t cell) {
  Place place;
  place.file = plc.name;
  for (const std::uint32_t v : d.cells[cell].vertices)
    if (v != ghost_vertex) place.points.push_back(as_array(plc.grid.to_world(d.point(v))));
  throw FrontStuck("the front does not separate the inside from the outside", place,
                   "the facets near these points are almost but not quite flat: try another --flatness");
}

}  // namespace

std::vector<ChamberId> label_cells(const Plc& plc, const Delaunay& d, const std::vector<FrontFace>& open,
                                   const std::vector<std::uint32_t>& wall_codes) {
  FaceBits is_open(d.cells.size(), 0), is_wall(d.cells.size(), 0);
  for (const std::uint32_t code : wall_codes) {
    if (code == no_neighbor) continue;
    set(is_wall, code);
    set(is_wall, d.cells[cell_of(code)].neighbors[face_of(code)]);
  }
  std::vector<ChamberId> chamber(d.cells.size());
  std::vector<std::uint32_t> stack;
  const auto label = [&](std::uint32_t cell, ChamberId its) {
    if (d.is_ghost(cell)) fail(plc, d, cell);
    if (!chamber[cell].is_none()) {
      if (chamber[cell] != its) fail(plc, d, cell);
      return;
    }
    chamber[cell] = its;
    stack.push_back(cell);
  };
  for (const FrontFace& face : open) set(is_open, face.code);
  for (const FrontFace& face : open) {
    label(cell_of(face.code), face.chamber);
    while (!stack.empty()) {
      const std::uint32_t cell = stack.back();
      stack.pop_back();
      for (std::uint32_t f = 0; f < 4; ++f) {
        if (has(is_open, cell, f)) continue;
        if (has(is_wall, cell, f)) fail(plc, d, cell);
        label(cell_of(d.cells[cell].neighbors[f]), face.chamber);
      }
    }
  }
  return chamber;
}

}  // namespace ccdt
