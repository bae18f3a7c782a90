#include "engine/delaunay/insertion.h"

#include <algorithm>
#include <array>
#include <bit>

#include "engine/base/count_work.h"
#include "engine/base/platform.h"
#include "engine/geometry/predicates.h"

namespace ccdt::delaunay {
namespace {

/// The face of a new cell opposite the k-th vertex of its border face, by the ghost's position in the border face (3:
/// none); see the order of vertices in `make_cell`.
constexpr std::uint8_t opposite[4][3] = {{3, 1, 0}, {0, 3, 1}, {1, 0, 3}, {0, 1, 2}};

/// The corners after and before the k-th one of a triangle.
constexpr std::size_t after[3] = {1, 2, 0}, before[3] = {2, 0, 1};

constexpr std::uint8_t no_local = InsertionMarks::no_local;

}  // namespace

Insertion::Insertion(Delaunay& delaunay) : Insertion(delaunay, own_marks_) {}

Insertion::Insertion(Delaunay& delaunay, InsertionMarks& marks)
    : d_(delaunay), marks_(marks), table_(table_side * table_side) {}

Insertion::Insertion(Delaunay& delaunay, InsertionMarks& marks, const InsertionParts& parts, CellPool& pool,
                     std::span<const std::uint32_t> free)
    : d_(delaunay),
      marks_(marks),
      parts_(parts),
      pool_(&pool),
      free_places_(free.begin(), free.end()),
      table_(table_side * table_side) {}

/// The visibility walk; ends in the cell that holds p, in a ghost whose hull face p is above, or in a shared cell from
/// which it would enter another part. The first face to try changes from step to step, so that the walk does not favor
/// a side. Faces whose plane may contain p are tried last.
///
/// \tparam in_part  may there be shared cells? A cell that is not shared is in this part.
template <bool in_part>
CCDT_ALWAYS_INLINE std::uint32_t Insertion::walk(std::uint32_t start) {
  Lanes a, b, c, d, p;
  load(d_.vertices[v_], p);
  std::uint32_t here = d_.is_ghost(start) ? cell_of(d_.cells[start].neighbors[3]) : start;
  bool is_shared = in_part && parts_.is_shared(d_.cells[here]);
  unsigned allowed = 15;  // all but the face that the walk came through
  while (true) {
    const Cell& cell = d_.cells[here];
    const auto& v = cell.vertices;
    if (v[3] == ghost_vertex) return here;
    load(d_.vertices[v[0]], a), load(d_.vertices[v[1]], b), load(d_.vertices[v[2]], c), load(d_.vertices[v[3]], d);
    auto [beyond, unknown] = faces_around_filter(a, b, c, d, p);
    unknown &= allowed;
    if (is_shared) {
      const unsigned crossed = faces_to_cross(cell);
      beyond &= crossed, unknown &= crossed;
    }
    ++turn_;
    while (beyond == 0 && unknown != 0) {
      const unsigned face = first_face(unknown);
      const auto [x, y, z] = corners_of_face(v, face);
      if (orient3d(d_.point(x), d_.point(y), d_.point(z), p_) < 0) beyond = 1u << face;
      unknown &= ~(1u << face);
    }
    if (beyond == 0) return here;
    const std::uint32_t code = cell.neighbors[first_face(beyond)];
    here = cell_of(code);
    allowed = 15 & ~(1u << face_of(code));
    if constexpr (in_part)
      is_shared = is_shared ? parts_.is_shared(d_.cells[here]) : parts_.is_shared_behind_own(d_.cells[here], code);
  }
}

/// The first of these faces, starting from the one whose turn it is.
inline unsigned Insertion::first_face(unsigned faces) const {
  const unsigned turned = (faces | faces << 4) >> (turn_ & 3);
  return (turn_ + static_cast<unsigned>(std::countr_zero(turned))) & 3;
}

/// The faces of a shared cell that may be crossed, as bits.
unsigned Insertion::faces_to_cross(const Cell& cell) const {
  unsigned faces = 0;
  for (std::uint32_t f = 0; f < 4; ++f) {
    const auto [a, b, c] = corners_of_face(cell.vertices, f);
    if (parts_.may_cross(a, b, c)) faces |= 1u << f;
  }
  return faces;
}

/// The neighbors of a cell whose spheres the new vertex is in, as bits by face.
///
/// \param open  the neighbors that are not in the cavity yet
CCDT_ALWAYS_INLINE unsigned Insertion::conflicting_neighbors(const Cell& cell, unsigned open) const {
  const Cell* const cells = d_.cells.data();
  const auto neighbor = [&](unsigned f) -> const Cell& { return cells[cell_of(cell.neighbors[f])]; };
  // Adds those of some faces, one by one.
  const auto add = [&](unsigned faces, const auto& conflicts, unsigned& inside) {
    for (; faces != 0; faces &= faces - 1) {
      const auto f = static_cast<unsigned>(std::countr_zero(faces));
      if (conflicts(neighbor(f))) inside |= 1u << f;
    }
  };
  unsigned inside = 0;
  if (cell.vertices[3] == ghost_vertex) {
    add(
        open, [&](const Cell& next) { return conflicts(next); }, inside);
    return inside;
  }
  std::array<std::uint32_t, 4> apex;
  unsigned ghosts = 0;
  for (unsigned f = 0; f < 4; ++f) {
    apex[f] = neighbor(f).vertices[face_of(cell.neighbors[f])];
    ghosts |= unsigned{apex[f] == ghost_vertex} << f;
    apex[f] = apex[f] == ghost_vertex ? v_ : apex[f];
  }
  const auto& v = cell.vertices;
  Lanes a, b, c, d, oa, ob, oc, od, p;
  load(d_.vertices[v[0]], a), load(d_.vertices[v[1]], b), load(d_.vertices[v[2]], c), load(d_.vertices[v[3]], d);
  load(d_.vertices[apex[0]], oa), load(d_.vertices[apex[1]], ob);
  load(d_.vertices[apex[2]], oc), load(d_.vertices[apex[3]], od);
  load(d_.vertices[v_], p);
  const SpheresAround spheres = spheres_around_filter(a, b, c, d, oa, ob, oc, od, p, open & ~ghosts);
  inside = spheres.inside;
  if (ties_ != Ties::greatest_rank)
    add(
        spheres.on, [&](const Cell& next) { return conflicts_in_doubt(next, Sign::zero); }, inside);
  add(
      spheres.unknown, [&](const Cell& next) { return conflicts_in_doubt(next, Sign::unknown); }, inside);
  add(
      ghosts & open, [&](const Cell& next) { return ghost_conflicts(next); }, inside);
  return inside;
}

/// Grows the cavity from its first cell across all faces to cells whose sphere contains the new vertex.
///
/// \tparam in_part  may there be shared cells? These are not marked, since other threads see them, too.
/// \return false if a shared cell is in the cavity
template <bool in_part>
CCDT_ALWAYS_INLINE bool Insertion::grow_cavity(std::uint32_t first) {
  const Cell* const cells = d_.cells.data();
  std::uint8_t* const in_cavity = marks_.in_cavity.data();
  std::size_t size = 1, faces = 0;
  bool is_own = true;
  cavity_.slots[0] = first;
  in_cavity[first] = 1;
  for (std::size_t i = 0; i < size && is_own; ++i) {
    make_room(cavity_.slots, size + 4), make_room(border_.slots, faces + 4);
    // They exist by the time they are needed.
    if (i + 1 < size)
      for (const std::uint32_t code : cells[cavity_.slots[i + 1]].neighbors) prefetch(cells + cell_of(code));
    const Cell cell = cells[cavity_.slots[i]];
    unsigned open = 0;
    for (unsigned f = 0; f < 4; ++f) open |= unsigned{in_cavity[cell_of(cell.neighbors[f])] == 0} << f;
    if (open == 0) continue;
    const unsigned inside = conflicting_neighbors(cell, open);
    // Which ones are inside is unpredictable, so there is no branch.
    for (unsigned f = 0; f < 4; ++f) {
      const std::uint32_t code = cell.neighbors[f], next = cell_of(code);
      const bool is_open = (open >> f & 1) != 0, is_inside = (inside >> f & 1) != 0;
      const bool is_shared = in_part && is_open && parts_.is_shared_behind_own(cells[next], code);
      if (is_shared && is_inside) {
        is_own = false;
        break;
      }
      if (!is_shared) in_cavity[next] = static_cast<std::uint8_t>(!is_open | is_inside);
      cavity_.slots[size] = next;
      size += is_inside;
      border_.slots[faces] = {corners_of_face(cell.vertices, f), code};
      faces += is_open & !is_inside;
    }
  }
  cavity_.size = size, border_.size = faces;
  return is_own;
}

CCDT_WIDE_LANES bool Insertion::find_cavity(std::uint32_t v, std::uint32_t start, Ties ties) {
  v_ = v;
  ties_ = ties;
  p_ = d_.point(v);
  twin_ = ghost_vertex;
  if (pool_ == nullptr) {
    marks_.in_cavity.resize(d_.cells.size(), 0);
    if (marks_.local.size() < d_.vertices.size()) marks_.local.resize(d_.vertices.capacity(), no_local);
  }
  const unsigned turn = turn_;
  const std::uint32_t first = reached_ = pool_ == nullptr ? walk<false>(start) : walk<true>(start);
  work_done.walk_steps += turn_ - turn;
  if (is_shared(first)) return false;
  for (const std::uint32_t corner : d_.cells[first].vertices) {
    if (corner != ghost_vertex && d_.point(corner) == p_) {
      twin_ = corner;
      return false;
    }
  }
  if (!(pool_ == nullptr ? grow_cavity<false>(first) : grow_cavity<true>(first))) return false;
  // Each cell of the cavity except the first was tested once, and the cells around it at each face.
  work_done.cells_tested += cavity_.size + border_.size - 1;
  work_done.largest_cavity = std::max<std::uint64_t>(work_done.largest_cavity, cavity_.size);
  ++work_done.insertions;
  return true;
}

std::uint32_t Insertion::cell_near(std::uint32_t v, std::uint32_t other) const {
  if (v == 0 || (pool_ != nullptr && parts_.of_vertex[v - 1] != parts_.own)) return other;
  const std::uint32_t cell = d_.cell_at[v - 1];
  return cell == none ? other : cell;
}

void Insertion::discard_cavity() {
  for (const std::uint32_t c : cavity_.items()) marks_.in_cavity[c] = 0;
  cavity_.size = border_.size = 0;
}

std::uint32_t Insertion::fill_cavity() {
  choose_places();
  // By Euler's formula, the border, a triangulated sphere, has half as many vertices as faces and two more.
  const std::size_t vertices = border_.size / 2 + 2;
  if (vertices <= table_side) {
    connect_by_table<table_side>(table_);
  } else if (vertices <= large_table_side) {
    large_table_.resize(large_table_side * large_table_side);
    connect_by_table<large_table_side>(large_table_);
    ++work_done.large_cavities;
  } else {
    connect_by_search();
    ++work_done.large_cavities;
  }
  work_done.cells_created += border_.size;
  work_done.cells_destroyed += cavity_.size;
  const std::uint32_t some = places_[0];
  d_.cell_at[v_] = some;
  for (std::size_t i = border_.size; i < cavity_.size; ++i) {
    d_.cells[cavity_.slots[i]].neighbors[0] = no_neighbor;
    free_cells().push_back(cavity_.slots[i]);
  }
  discard_cavity();
  return some;
}

bool Insertion::conflicts(const Cell& cell) const {
  const auto& v = cell.vertices;
  if (v[3] == ghost_vertex) return ghost_conflicts(cell);
  const Sign sign = insphere_filter(d_.point(v[0]), d_.point(v[1]), d_.point(v[2]), d_.point(v[3]), p_);
  if (sign == Sign::plus || sign == Sign::minus) return sign == Sign::plus;
  return conflicts_in_doubt(cell, sign);
}

/// A new vertex with the greatest rank is outside a sphere that it lies on.
///
/// \param sign  zero or unknown
bool Insertion::conflicts_in_doubt(const Cell& cell, Sign sign) const {
  const auto& v = cell.vertices;
  const Point3 &a = d_.point(v[0]), &b = d_.point(v[1]), &c = d_.point(v[2]), &d = d_.point(v[3]);
  const int exact = sign == Sign::zero ? 0 : insphere_exactly(a, b, c, d, p_);
  if (exact != 0 || ties_ == Ties::greatest_rank) return exact > 0;
  const auto rank = [&](std::uint32_t u) { return d_.vertices[u].rank; };
  const std::array ranks = {rank(v[0]), rank(v[1]), rank(v[2]), rank(v[3]), rank(v_)};
  if (*std::ranges::max_element(ranks) == ranks[4]) return false;
  return insphere_tie(a, b, c, d, p_, ranks) > 0;
}

/// A ghost's sphere is the outer half-space of its hull face and, in the plane of the face, the circumcircle.
bool Insertion::ghost_conflicts(const Cell& ghost) const {
  const Point3 &a = d_.point(ghost.vertices[0]), &b = d_.point(ghost.vertices[1]), &c = d_.point(ghost.vertices[2]);
  const int side = orient3d(a, b, c, p_);
  if (side != 0) return side > 0;
  if (ties_ == Ties::greatest_rank) return incircle(a, b, c, p_) > 0;
  const std::uint32_t inner = ghost.neighbors[3];
  const Point3& apex = d_.point(d_.cells[cell_of(inner)].vertices[face_of(inner)]);
  const auto rank = [&](std::uint32_t u) { return d_.vertices[u].rank; };
  // The apex is below the ghost's triangle: seen from it the triangle is a, c, b.
  return incircle_perturbed(a, c, b, apex, p_,
                            {rank(ghost.vertices[0]), rank(ghost.vertices[2]), rank(ghost.vertices[1]), rank(v_)}) > 0;
}

bool Insertion::has_room() {
  if (pool_ == nullptr) return true;
  while (cavity_.size + free_places_.size() < border_.size) {
    const std::uint32_t first = pool_->next.fetch_add(pool_->chunk, std::memory_order_relaxed);
    if (first + pool_->chunk > pool_->end) return false;
    for (std::uint32_t i = pool_->chunk; i-- > 0;) free_places_.push_back(first + i);
  }
  return true;
}

/// New cells take the places of the cavity's cells; further places come from dead cells and from the end.
void Insertion::choose_places() {
  const auto cavity = cavity_.items();
  places_.assign(cavity.begin(), cavity.begin() + static_cast<std::ptrdiff_t>(std::min(cavity.size(), border_.size)));
  std::vector<std::uint32_t>& free = free_cells();
  while (places_.size() < border_.size && !free.empty()) {
    places_.push_back(free.back());
    free.pop_back();
  }
  const std::size_t old = d_.cells.size(), more = border_.size - places_.size();
  if (more == 0) return;
  d_.cells.resize(old + more);
  marks_.in_cavity.resize(old + more, 0);
  for (std::size_t i = 0; i < more; ++i) places_.push_back(static_cast<std::uint32_t>(old + i));
}

/// Joins a face of the border to the new vertex.
/// \return the position of the ghost among the face's vertices; 3 if it is not there
inline std::uint32_t Insertion::make_cell(const CavityFace& face, std::uint32_t place) const {
  Cell& cell = d_.cells[place];
  const auto& f = face.vertices;
  std::uint32_t ghost = 3, apex = 3;
  if (f[0] != ghost_vertex && f[1] != ghost_vertex && f[2] != ghost_vertex) {
    cell.vertices = {f[0], f[1], f[2], v_};
  } else {
    // The ghost is always vertex 3: exchanging two pairs of vertices keeps the orientation.
    ghost = f[0] == ghost_vertex ? 0 : f[1] == ghost_vertex ? 1 : 2;
    apex = 2;
    if (ghost == 0)
      cell.vertices = {f[2], f[1], v_, f[0]};
    else if (ghost == 1)
      cell.vertices = {f[0], f[2], v_, f[1]};
    else
      cell.vertices = {f[1], f[0], v_, f[2]};
  }
  cell.neighbors[apex] = face.outside;
  d_.cells[cell_of(face.outside)].neighbors[face_of(face.outside)] = face_code(place, apex);
  return ghost;
}

/// Two new cells share the face between the new vertex and an edge of the border. Their border faces run along this
/// edge in opposite directions: each cell leaves its code in the table, then each finds that of the other. (No branch
/// depends on which vertices and edges were met before, since that is unpredictable.)
template <std::size_t side>
void Insertion::connect_by_table(RawVector<std::uint32_t>& codes) {
  struct Corners {
    std::array<std::uint8_t, 3> local;
    std::uint8_t ghost;  ///< its position; 3: it is none of them
  };
  std::array<Corners, 2 * side> corners;
  std::array<std::uint32_t, side + 1> vertices;  // the last place is for vertices already numbered
  std::size_t numbered = 0;
  std::uint32_t* const table = codes.data();
  for (std::size_t i = 0; i < border_.size; ++i) {
    const CavityFace& face = border_.slots[i];
    const std::uint32_t place = places_[i];
    corners[i].ghost = static_cast<std::uint8_t>(make_cell(face, place));
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t u = face.vertices[k];
      std::uint8_t& local = local_of(u);
      vertices[numbered] = u;
      // `no_local` is greater than any number, and a vertex that has a number has one less than the next.
      corners[i].local[k] = local = static_cast<std::uint8_t>(std::min<std::size_t>(local, numbered));
      numbered += local == numbered;
      if (u != ghost_vertex) d_.cell_at[u] = place;
    }
    for (std::size_t k = 0; k < 3; ++k)
      table[corners[i].local[after[k]] * side + corners[i].local[before[k]]] =
          face_code(place, opposite[corners[i].ghost][k]);
  }
  for (std::size_t i = 0; i < border_.size; ++i) {
    auto& neighbors = d_.cells[places_[i]].neighbors;
    const auto& [local, ghost] = corners[i];
    for (std::size_t k = 0; k < 3; ++k)
      neighbors[opposite[ghost][k]] = table[local[before[k]] * side + local[after[k]]];
  }
  for (std::size_t i = 0; i < numbered; ++i) local_of(vertices[i]) = no_local;
}

/// The same for a cavity with more vertices than a table has rows.
void Insertion::connect_by_search() {
  const auto key = [](std::uint32_t from, std::uint32_t to) { return std::uint64_t{from} << 32 | to; };
  for (std::size_t i = 0; i < border_.size; ++i) {
    const auto& v = border_.slots[i].vertices;
    const auto& opposite_faces = opposite[make_cell(border_.slots[i], places_[i])];
    for (std::uint32_t k = 0; k < 3; ++k) {
      if (v[k] != ghost_vertex) d_.cell_at[v[k]] = places_[i];
      const std::uint32_t from = v[after[k]], to = v[before[k]];
      const std::uint32_t here = face_code(places_[i], opposite_faces[k]);
      if (const std::uint32_t* other = waiting_.find(key(to, from))) {
        join_faces(d_.cells, here, *other);
        waiting_.erase(other);
      } else {
        waiting_.insert(key(from, to), here);
      }
    }
  }
}

}  // namespace ccdt::delaunay
