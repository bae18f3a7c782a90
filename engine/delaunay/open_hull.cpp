#include "engine/delaunay/open_hull.h"

#include <algorithm>

#include "engine/base/simplex_map.h"
#include "engine/delaunay/open_faces.h"
#include "engine/numbers/predicates.h"

namespace ccdt {
namespace {

/// An edge of an open face.
struct Side {
  std::uint64_t edge;
  std::uint32_t face;      ///< its place among the open faces
  std::uint32_t opposite;  ///< place among its outward corners of the one that is not on the edge
};

/// The sides of all faces, those of one edge next to each other.
std::vector<Side> sides_by_edge(const std::vector<std::array<std::uint32_t, 3>>& corners) {
  std::vector<Side> sides;
  sides.reserve(3 * corners.size());
  for (std::uint32_t f = 0; f < corners.size(); ++f)
    for (std::uint32_t k = 0; k < 3; ++k)
      sides.push_back({edge_key(corners[f][(k + 1) % 3], corners[f][(k + 2) % 3]), f, k});
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) { return a.edge < b.edge; });
  return sides;
}

std::vector<std::array<std::uint32_t, 3>> corners_of(const std::vector<Cell>& cells,
                                                     std::span<const std::uint32_t> faces) {
  std::vector<std::array<std::uint32_t, 3>> corners(faces.size());
  for (std::size_t f = 0; f < faces.size(); ++f) corners[f] = outward_corners(cells, faces[f]);
  return corners;
}

/// Is the vertex in front of one of the faces from outside?
bool sees(std::span<const GridVertex> v, const std::array<std::uint32_t, 3>& face, std::uint32_t vertex) {
  return orient3d(v[face[0]].point, v[face[1]].point, v[face[2]].point, v[vertex].point) > 0;
}

void add_faces_seen_by_lone_vertices(const std::vector<Cell>& cells, std::span<const GridVertex> vertices,
                                     std::span<const std::uint32_t> faces,
                                     const std::vector<std::array<std::uint32_t, 3>>& corners,
                                     std::vector<Unfinished>& result) {
  std::vector<bool> has_cell(vertices.size(), false);
  for (const Cell& cell : cells)
    for (const std::uint32_t v : cell.vertices) has_cell[v] = true;
  for (std::uint32_t v = 0; v < vertices.size(); ++v) {
    if (has_cell[v]) continue;
    for (std::size_t f = 0; f < faces.size(); ++f)
      if (sees(vertices, corners[f], v)) result.push_back({faces[f], v});
    if (!result.empty()) return;
  }
}

}  // namespace

std::vector<Unfinished> find_unfinished(const std::vector<Cell>& cells, std::span<const GridVertex> vertices,
                                        std::span<const std::uint32_t> faces) {
  const auto corners = corners_of(cells, faces);
  const auto sides = sides_by_edge(corners);
  std::vector<Unfinished> result;
  for (std::size_t i = 0, next; i < sides.size(); i = next) {
    for (next = i + 1; next < sides.size() && sides[next].edge == sides[i].edge;) ++next;
    // Where the body touches itself at an edge, that edge is inside the hull.
    if (next - i != 2) {
      for (std::size_t k = i; k < next; ++k) result.push_back({faces[sides[k].face], ghost_vertex});
      continue;
    }
    const Side &s = sides[i], &t = sides[i + 1];
    const std::uint32_t over_s = corners[t.face][t.opposite], over_t = corners[s.face][s.opposite];
    if (!sees(vertices, corners[s.face], over_s)) continue;
    result.push_back({faces[s.face], over_s});
    result.push_back({faces[t.face], over_t});
  }
  if (result.empty()) add_faces_seen_by_lone_vertices(cells, vertices, faces, corners, result);
  return result;
}

void add_ghosts(std::vector<Cell>& cells, std::span<const std::uint32_t> faces) {
  const auto corners = corners_of(cells, faces);
  const auto first = static_cast<std::uint32_t>(cells.size());
  cells.resize(cells.size() + faces.size());
  for (std::uint32_t f = 0; f < faces.size(); ++f) {
    Cell& ghost = cells[first + f];
    ghost.vertices = {corners[f][0], corners[f][1], corners[f][2], ghost_vertex};
    ghost.neighbors[3] = faces[f];
    cells[cell_of(faces[f])].neighbors[face_of(faces[f])] = face_code(first + f, 3);
  }
  const auto sides = sides_by_edge(corners);
  for (std::size_t i = 0; i + 1 < sides.size(); i += 2) {
    const std::uint32_t s = face_code(first + sides[i].face, sides[i].opposite);
    const std::uint32_t t = face_code(first + sides[i + 1].face, sides[i + 1].opposite);
    cells[cell_of(s)].neighbors[face_of(s)] = t;
    cells[cell_of(t)].neighbors[face_of(t)] = s;
  }
}

}  // namespace ccdt
