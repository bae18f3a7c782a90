#include "engine/label/label_cells.h"

namespace ccdt {
namespace {

/// Eight bits a cell: faces where the flood of a chamber starts or ends, and faces that it must not reach at all.
using FaceBits = std::vector<std::uint8_t>;

void set_open(FaceBits& bits, std::uint32_t code) {
  bits[cell_of(code)] |= static_cast<std::uint8_t>(1u << face_of(code));
}
void set_wall(FaceBits& bits, std::uint32_t code) {
  bits[cell_of(code)] |= static_cast<std::uint8_t>(0x10u << face_of(code));
}
bool is_open(std::uint8_t bits, std::uint32_t face) {
  return bits >> face & 1u;
}
bool is_wall(std::uint8_t bits, std::uint32_t face) {
  return bits >> face & 0x10u;
}

[[noreturn]] void fail(const Plc& plc, const Delaunay& d, std::uint32_t cell) {
  Place place;
  place.file = plc.name;
  for (const std::uint32_t v : d.cells[cell].vertices)
    if (v != ghost_vertex) place.points.push_back(as_array(plc.grid.to_world(d.point(v))));
  throw FrontStuck("the front does not separate the inside from the outside", place,
                   "the facets near these points are almost but not quite flat: try another --flatness");
}

FaceBits mark_faces(const Delaunay& d, const std::vector<FrontFace>& open,
                    const std::vector<std::uint32_t>& wall_codes) {
  FaceBits bits(d.cells.size(), 0);
  for (const std::uint32_t code : wall_codes) {
    if (code == no_neighbor) continue;
    set_wall(bits, code);
    set_wall(bits, d.cells[cell_of(code)].neighbors[face_of(code)]);
  }
  for (const FrontFace& face : open) set_open(bits, face.code);
  return bits;
}

}  // namespace

std::vector<ChamberId> label_cells(const Plc& plc, const Delaunay& d, const std::vector<FrontFace>& open,
                                   const std::vector<std::uint32_t>& wall_codes) {
  const FaceBits bits = mark_faces(d, open, wall_codes);
  std::vector<ChamberId> chamber(d.cells.size());
  std::vector<std::uint32_t> waiting(d.cells.size());  // a stack; every cell waits once at most
  std::size_t height = 0;
  const auto label = [&](std::uint32_t cell, ChamberId its) {
    if (chamber[cell] == its) return;
    if (!chamber[cell].is_none() || d.is_ghost(cell)) fail(plc, d, cell);
    chamber[cell] = its;
    waiting[height++] = cell;
  };
  for (const FrontFace& face : open) {
    label(cell_of(face.code), face.chamber);
    while (height > 0) {
      const std::uint32_t cell = waiting[--height];
      const Cell& its = d.cells[cell];
      for (std::uint32_t f = 0; f < 4; ++f) {
        if (is_open(bits[cell], f)) continue;
        if (is_wall(bits[cell], f)) fail(plc, d, cell);
        label(cell_of(its.neighbors[f]), face.chamber);
      }
    }
  }
  return chamber;
}

}  // namespace ccdt
