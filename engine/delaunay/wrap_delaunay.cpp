#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include "engine/base/count_work.h"
#include "engine/base/hash_table.h"
#include "engine/base/simplex_map.h"
#include "engine/delaunay/delaunay.h"
#include "engine/delaunay/fourth_vertex.h"
#include "engine/geometry/predicates.h"

namespace ccdt::delaunay {
namespace {

using FaceCorners = std::array<std::uint32_t, 3>;

// ---- The first face

// A point straight up, about as far away as points can be, so that the predicates' filters work as usual.
constexpr Point3 upward = {0, 0, 0x1p51};

/// Finds a face of the Delaunay tetrahedralization from which it can be built face by face. The face is on the convex
/// hull, and is found by wrapping a plane around the points: first a vertex, then an edge, the plane of a hull face,
/// and a Delaunay triangle in that plane. Each step is one exact pass over the vertices.
class HullWrapping {
 public:
  explicit HullWrapping(std::span<const GridVertex> vertices) : v_(vertices) {}

  /// \return  the corners of the face, the outside of the hull above them; nothing if all vertices are in one plane
  std::optional<FaceCorners> face() const {
    if (v_.size() < 4) return {};
    const std::uint32_t a = lowest();
    const std::uint32_t b = beside(a);
    if (b == none) return {};
    std::uint32_t c = on_upright_plane(a, b);
    if (c == none) c = around(a, b);
    if (c == none) return {};
    const std::uint32_t inner = off_plane(a, b, c);
    if (inner == none) return {};
    std::vector<std::uint32_t> plane;
    for (std::uint32_t e = 0; e < v_.size(); ++e)
      if (orient3d(at(a), at(b), at(c), at(e)) == 0) plane.push_back(e);
    const std::uint32_t q = along_boundary(plane, a, inner);
    return std::array{a, q, above_edge(plane, a, q, inner)};
  }

 private:
  const Point3& at(std::uint32_t v) const { return v_[v].point; }

  /// The vertex with the smallest x, then y, then z: a vertex of the hull.
  std::uint32_t lowest() const {
    const auto lower = [](const GridVertex& p, const GridVertex& q) { return as_array(p.point) < as_array(q.point); };
    return static_cast<std::uint32_t>(std::min_element(v_.begin(), v_.end(), lower) - v_.begin());
  }

  /// A vertex not straight above a; the upright plane through both has no vertices on its outer side.
  std::uint32_t beside(std::uint32_t a) const {
    const Point3 up = at(a) + upward;
    std::uint32_t b = none;
    for (std::uint32_t e = 0; e < v_.size(); ++e) {
      if (at(e).x == at(a).x && at(e).y == at(a).y) continue;
      if (b == none || orient3d(at(a), up, at(b), at(e)) > 0) b = e;
    }
    return b;
  }

  /// A vertex of the upright plane through a and b that is not on the line of a and b.
  std::uint32_t on_upright_plane(std::uint32_t a, std::uint32_t b) const {
    const Point3 up = at(a) + upward;
    for (std::uint32_t e = 0; e < v_.size(); ++e)
      if (orient3d(at(a), up, at(b), at(e)) == 0 && !collinear(at(a), at(b), at(e))) return e;
    return none;
  }

  /// The vertex that a plane turning around the line of a and b meets first.
  std::uint32_t around(std::uint32_t a, std::uint32_t b) const {
    std::uint32_t c = none;
    for (std::uint32_t e = 0; e < v_.size(); ++e)
      if (c == none ? !collinear(at(a), at(b), at(e)) : orient3d(at(a), at(b), at(c), at(e)) > 0) c = e;
    return c;
  }

  std::uint32_t off_plane(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    for (std::uint32_t e = 0; e < v_.size(); ++e)
      if (orient3d(at(a), at(b), at(c), at(e)) != 0) return e;
    return none;
  }

  /// The vertex next to a on the boundary of the vertices of a hull plane, counterclockwise as seen from outside.
  std::uint32_t along_boundary(std::span<const std::uint32_t> plane, std::uint32_t a, std::uint32_t inner) const {
    std::uint32_t q = none;
    for (const std::uint32_t e : plane) {
      if (e == a) continue;
      if (q == none || orient3d(at(a), at(q), at(e), at(inner)) > 0 ||
          (collinear(at(a), at(q), at(e)) && is_nearer(at(e) - at(a), at(q) - at(a))))
        q = e;
    }
    return q;
  }

  /// For two multiples of one vector.
  static bool is_nearer(const Point3& p, const Point3& q) {
    return std::array{std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)} <
           std::array{std::fabs(q.x), std::fabs(q.y), std::fabs(q.z)};
  }

  /// The vertex that makes a Delaunay triangle with the edge from a to q, in their plane.
  std::uint32_t above_edge(std::span<const std::uint32_t> plane, std::uint32_t a, std::uint32_t q,
                           std::uint32_t inner) const {
    std::uint32_t r = none;
    for (const std::uint32_t e : plane) {
      if (orient3d(at(q), at(a), at(e), at(inner)) <= 0) continue;
      if (r == none || incircle_perturbed(at(q), at(a), at(r), at(inner), at(e),
                                          {v_[q].rank, v_[a].rank, v_[r].rank, v_[e].rank}) > 0)
        r = e;
    }
    return r;
  }

  std::span<const GridVertex> v_;
};

// ---- The hull

/// The corners of a face, in an order with the opposite vertex below them.
FaceCorners outward_corners(const LargeVector<Cell>& cells, std::uint32_t code) {
  const auto [a, b, c] = corners_of_face(cells[cell_of(code)].vertices, face_of(code));
  return {a, c, b};
}

/// An open face, and a vertex strictly above it as seen from outside (`ghost_vertex`: one is to be searched for).
struct UnfinishedFace {
  std::uint32_t face;
  std::uint32_t candidate;
};

/// An edge of an open face.
struct Side {
  std::uint64_t edge;
  std::uint32_t face;      ///< its place among the open faces
  std::uint32_t opposite;  ///< which of its outward corners is not on the edge
};

/// The sides of all faces, those of one edge next to each other.
std::vector<Side> sides_by_edge(const std::vector<FaceCorners>& corners) {
  std::vector<Side> sides;
  sides.reserve(3 * corners.size());
  for (std::uint32_t f = 0; f < corners.size(); ++f)
    for (std::uint32_t k = 0; k < 3; ++k)
      sides.push_back({edge_key(corners[f][(k + 1) % 3], corners[f][(k + 2) % 3]), f, k});
  std::sort(sides.begin(), sides.end(),
            [](const Side& a, const Side& b) { return a.edge != b.edge ? a.edge < b.edge : a.face < b.face; });
  return sides;
}

std::vector<FaceCorners> corners_of(const LargeVector<Cell>& cells, std::span<const std::uint32_t> faces) {
  std::vector<FaceCorners> corners(faces.size());
  for (std::size_t f = 0; f < faces.size(); ++f) corners[f] = outward_corners(cells, faces[f]);
  return corners;
}

/// Is the vertex outside one of the faces?
bool sees(std::span<const GridVertex> v, const FaceCorners& face, std::uint32_t vertex) {
  return orient3d(v[face[0]].point, v[face[1]].point, v[face[2]].point, v[vertex].point) > 0;
}

void add_faces_seen_by_lone_vertices(const LargeVector<Cell>& cells, std::span<const GridVertex> vertices,
                                     std::span<const std::uint32_t> faces, const std::vector<FaceCorners>& corners,
                                     std::vector<UnfinishedFace>& result) {
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

/// Are the open faces the convex hull? They are the border of a body of Delaunay cells connected by faces. They are the
/// hull if the body is convex, which holds if it is convex at each edge, and contains all vertices. So it is not
/// necessary to search everything above a face of the hull.
///
/// \param faces  codes of the open faces
/// \return  faces that are not on the hull: those at edges that are not convex or, if there are none, those that see a
///          vertex that no cell has
std::vector<UnfinishedFace> find_unfinished(const LargeVector<Cell>& cells, std::span<const GridVertex> vertices,
                                            std::span<const std::uint32_t> faces) {
  const auto corners = corners_of(cells, faces);
  const auto sides = sides_by_edge(corners);
  std::vector<UnfinishedFace> result;
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

/// Adds a ghost for each of the open faces, which form the hull, and makes the ghosts neighbors.
void add_ghosts(LargeVector<Cell>& cells, std::span<const std::uint32_t> faces) {
  const auto corners = corners_of(cells, faces);
  const auto first = static_cast<std::uint32_t>(cells.size());
  cells.resize(cells.size() + faces.size());
  for (std::uint32_t f = 0; f < faces.size(); ++f) {
    Cell& ghost = cells[first + f];
    ghost.vertices = {corners[f][0], corners[f][1], corners[f][2], ghost_vertex};
    join_faces(cells, face_code(first + f, 3), faces[f]);
  }
  const auto sides = sides_by_edge(corners);
  for (std::size_t i = 0; i + 1 < sides.size(); i += 2) {
    join_faces(cells, face_code(first + sides[i].face, sides[i].opposite),
               face_code(first + sides[i + 1].face, sides[i + 1].opposite));
  }
}

// ---- The construction

/// The construction. Until it is done, cells name vertices by their places in the grid's order, and the open faces of a
/// cell have no neighbor.
class Wrap {
 public:
  Wrap(const VertexGrid& grid, const Progress& progress) : grid_(grid), search_(grid), progress_(progress) {
    cells_.reserve(7 * grid.vertices.size() + 64);
  }

  /// \param hull_face  the outside above it
  LargeVector<Cell> run(const FaceCorners& hull_face) {
    const FaceCorners inward = {hull_face[0], hull_face[2], hull_face[1]};
    add_cell(inward, search_.find(inward, ghost_vertex, Reach::everywhere));
    advance();
    for (auto rest = unfinished(); !rest.empty(); rest = unfinished()) {
      for (const UnfinishedFace& u : rest)
        if (is_open(u.face)) add_cell_at(u.face, u.candidate, Reach::everywhere);
      advance();
    }
    add_ghosts(cells_, postponed_);
    work_done.cells_created += cells_.size();
    note_bytes(bytes_of(grid_.vertices, grid_.first, grid_.blocks, cells_, postponed_) + open_.bytes());
    return std::move(cells_);
  }

 private:
  bool is_open(std::uint32_t code) const { return cells_[cell_of(code)].neighbors[face_of(code)] == no_neighbor; }

  /// Adds the cell above each open face if a local search finds one; postpones the other faces.
  void advance() {
    std::vector<std::uint32_t> faces;
    while (!front_.empty()) {
      faces.swap(front_);
      for (const std::uint32_t code : faces)
        if (is_open(code) && !add_cell_at(code, ghost_vertex, Reach::near)) postponed_.push_back(code);
      faces.clear();
    }
  }

  std::vector<UnfinishedFace> unfinished() {
    std::erase_if(postponed_, [&](std::uint32_t code) { return !is_open(code); });
    return find_unfinished(cells_, grid_.vertices, postponed_);
  }

  bool add_cell_at(std::uint32_t code, std::uint32_t candidate, Reach reach) {
    const auto face = outward_corners(cells_, code);
    const std::uint32_t apex = search_.find(face, candidate, reach);
    if (apex == ghost_vertex) return false;
    add_cell(face, apex);
    return true;
  }

  /// Adds the cell with the apex above the face.
  void add_cell(const FaceCorners& face, std::uint32_t apex) {
    const auto cell = static_cast<std::uint32_t>(cells_.size());
    cells_.push_back({{face[0], face[1], face[2], apex}, {no_neighbor, no_neighbor, no_neighbor, no_neighbor}});
    for (std::uint32_t f = 4; f-- > 0;)
      if (!close_or_open(face_code(cell, f))) front_.push_back(face_code(cell, f));
    if ((cell & 0x3FFFF) == 0x3FFFF) report(progress_, "delaunay", cell, 0);
  }

  /// Closes the face with the open one that has the same corners, and makes their cells neighbors; if there is none,
  /// the face stays open. \return was it closed?
  bool close_or_open(std::uint32_t code) {
    const auto [a, b, c] = corners_of_face(cells_[cell_of(code)].vertices, face_of(code));
    const auto [other, is_new] = open_.insert(face_key(a, b, c), code);
    if (is_new) return false;
    join_faces(cells_, code, *other);
    open_.erase(other);
    return true;
  }

  const VertexGrid& grid_;
  FourthVertexSearch search_;
  const Progress& progress_;
  LargeVector<Cell> cells_;
  HashTable<FaceKey, std::uint32_t> open_;  ///< faces that have a cell on one side only: the codes by the corners
  std::vector<std::uint32_t> front_;        ///< faces to process next; some may be closed already
  std::vector<std::uint32_t> postponed_;    ///< open faces without a vertex nearby: on the hull, or at a wide gap
};

}  // namespace

Delaunay wrap_delaunay(DelaunayVertices vertices, double grid_scale, const Progress& progress) {
  const VertexGrid grid = make_vertex_grid(vertices, grid_scale);
  const auto hull_face = HullWrapping(grid.vertices).face();
  if (!hull_face) refuse_flat_points();
  Delaunay d;
  d.vertices = std::move(vertices);
  d.cell_at.resize(d.vertices.size(), none);
  d.cells = Wrap(grid, progress).run(*hull_face);
  for (std::uint32_t c = 0; c < d.cells.size(); ++c) {
    for (std::uint32_t& v : d.cells[c].vertices) {
      if (v == ghost_vertex) continue;
      v = grid.vertices[v].id;
      d.cell_at[v] = c;
    }
  }
  return d;
}

}  // namespace ccdt::delaunay
