#include "engine/improve/change_cells.h"

#include <limits>

namespace ccdt {
namespace {

/// A face that waits for the cell on its other side.
struct OpenFace {
  FaceKey key;
  std::uint32_t code;  ///< of the cell that is there; `no_neighbor`: none, the face is on the boundary
  bool is_wall;
  bool is_old;  ///< on the hull of the old cells
};

/// The memory of `apply_change`.
struct Room {
  std::vector<OpenFace> open;
  std::vector<std::uint32_t> places;
};

FaceKey key_of_face(const std::array<std::uint32_t, 4>& v, std::uint32_t f) {
  const auto& corner = face_corners[f];
  return face_key(v[corner[0]], v[corner[1]], v[corner[2]]);
}

void open_hull(CellComplex& x, const Change& change, std::vector<OpenFace>& open) {
  open.clear();
  ++x.questions;
  for (const std::uint32_t c : change.old_cells) x.marks[c] = x.questions;
  for (const std::uint32_t c : change.old_cells) {
    const Cell& cell = x.cells[c];
    for (std::uint32_t f = 0; f < 4; ++f) {
      const std::uint32_t beyond = cell.neighbors[f];
      if (beyond != no_neighbor && x.marks[cell_of(beyond)] == x.questions) continue;
      open.push_back({key_of_face(cell.vertices, f), beyond, (x.walls[c] >> f & 1) != 0, true});
    }
  }
}

void free_old_cells(CellComplex& x, const Change& change) {
  for (const std::uint32_t c : change.old_cells) {
    for (const std::uint32_t v : x.cells[c].vertices) x.cell_of_vertex[v] = no_neighbor;
    x.cells[c].vertices[0] = ghost_vertex;
    ++x.generations[c];
    x.free_cells.push_back(c);
  }
}

std::uint32_t take_place(CellComplex& x) {
  if (!x.free_cells.empty()) {
    const std::uint32_t place = x.free_cells.back();
    x.free_cells.pop_back();
    return place;
  }
  const auto place = static_cast<std::uint32_t>(x.cells.size());
  x.cells.emplace_back();
  x.walls.push_back(0);
  x.regions.push_back(0);
  x.worths.push_back(0);
  x.generations.push_back(0);
  x.marks.push_back(0);
  return place;
}

void add_wall(CellComplex& x, std::uint32_t code) {
  x.walls[cell_of(code)] = static_cast<std::uint8_t>(x.walls[cell_of(code)] | 1u << face_of(code));
}

bool is_new_wall(const std::vector<FacetFlip>& flips, const FaceKey& key) {
  for (const FacetFlip& f : flips)
    if (key == face_key(f.a, f.c, f.d) || key == face_key(f.b, f.c, f.d)) return true;
  return false;
}

/// Joins a face of a new cell to what waits for it, or lets it wait.
void connect(CellComplex& x, std::uint32_t code, const FaceKey& key, const std::vector<FacetFlip>& flips,
             std::vector<OpenFace>& open) {
  const bool is_wall = !flips.empty() && is_new_wall(flips, key);
  for (OpenFace& face : open) {
    if (face.key != key) continue;
    x.cells[cell_of(code)].neighbors[face_of(code)] = face.code;
    if (face.code != no_neighbor) x.cells[cell_of(face.code)].neighbors[face_of(face.code)] = code;
    if (face.is_wall || is_wall) add_wall(x, code);
    face = open.back();
    open.pop_back();
    return;
  }
  x.cells[cell_of(code)].neighbors[face_of(code)] = no_neighbor;
  if (is_wall) add_wall(x, code);
  open.push_back({key, code, is_wall, false});
}

void flip_walls(CellComplex& x, const FacetFlip& flip) {
  const auto exchange = [&](std::uint32_t kept, std::uint32_t apex, std::uint32_t from, std::uint32_t to) {
    const std::uint32_t* const place = x.wall_faces.find(face_key(kept, from, apex));
    const std::uint32_t f = *place;
    x.wall_faces.erase(place);
    std::ranges::replace(x.faces[f], from, to);
    return f;
  };
  const std::uint32_t first = exchange(flip.a, flip.c, flip.b, flip.d);
  const std::uint32_t second = exchange(flip.b, flip.d, flip.a, flip.c);
  x.wall_faces.insert(face_key(flip.a, flip.c, flip.d), first);
  x.wall_faces.insert(face_key(flip.b, flip.c, flip.d), second);
}

}  // namespace

double worst_of(const CellComplex& x, const std::vector<std::uint32_t>& cells) {
  double worst = std::numeric_limits<double>::infinity();
  for (const std::uint32_t c : cells) worst = std::min(worst, x.worths[c]);
  return worst;
}

double worst_of(const std::vector<NewCell>& cells) {
  double worst = std::numeric_limits<double>::infinity();
  for (const NewCell& cell : cells) worst = std::min(worst, cell.worth);
  return worst;
}

bool all_positive(const CellComplex& x, const Change& change) {
  return std::ranges::all_of(change.new_cells, [&](const NewCell& cell) { return is_positive(x, cell.vertices); });
}

const std::vector<std::uint32_t>& apply_change(CellComplex& x, const Change& change) {
  thread_local Room room;
  open_hull(x, change, room.open);
  free_old_cells(x, change);
  room.places.clear();
  for (const NewCell& made : change.new_cells) {
    const std::uint32_t c = take_place(x);
    room.places.push_back(c);
    x.cells[c].vertices = made.vertices;
    x.walls[c] = 0;
    x.regions[c] = made.region;
    x.worths[c] = made.worth;
    for (std::uint32_t f = 0; f < 4; ++f)
      connect(x, face_code(c, f), key_of_face(made.vertices, f), change.flips, room.open);
    for (const std::uint32_t v : made.vertices) x.cell_of_vertex[v] = c;
  }
  // What a flip has left open on a boundary facet: its two old triangles are gone, the two new ones are walls already.
  for (const FacetFlip& flip : change.flips) flip_walls(x, flip);
  ++x.changes;
  for (const NewCell& made : change.new_cells)
    for (const std::uint32_t v : made.vertices) x.changed_at[v] = x.changes;
  return room.places;
}

void note_change(CellComplex& x, const std::array<std::uint32_t, 4>& vertices) {
  for (const std::uint32_t v : vertices) x.changed_at[v] = x.changes;
}

}  // namespace ccdt
