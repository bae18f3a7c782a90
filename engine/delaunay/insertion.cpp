#include "engine/delaunay/insertion.h"

#include <algorithm>

#include "engine/numbers/filters.h"
#include "engine/numbers/predicates.h"

namespace ccdt {
namespace {

constexpr std::uint8_t no_local = 0xFF;

}  // namespace

Insertion::Insertion(Delaunay& delaunay) : d_(delaunay), table_(table_side * table_side) {}

CCDT_WIDE_LANES bool Insertion::dig(std::uint32_t v, std::uint32_t start) {
  v_ = v;
  p_ = d_.point(v);
  mark_.resize(d_.cells.size(), Mark::unknown);
  if (local_.size() < d_.vertices.size() + 1) local_.resize(d_.vertices.capacity() + 1, no_local);
  const std::uint32_t first = walk(p_, start);
  for (const std::uint32_t corner : d_.cells[first].vertices) {
    if (corner != ghost_vertex && d_.point(corner) == p_) {
      twin_ = corner;
      return false;
    }
  }
  cavity_.assign(1, first);
  mark_[first] = Mark::conflict;
  for (std::size_t i = 0; i < cavity_.size(); ++i) {
    const Cell cell = d_.cells[cavity_[i]];
    for (std::uint32_t f = 0; f < 4; ++f) {
      const std::uint32_t code = cell.neighbors[f], next = cell_of(code);
      if (mark_[next] == Mark::unknown) {
        if (conflicts(d_.cells[next])) {
          mark_[next] = Mark::conflict;
          cavity_.push_back(next);
        } else {
          mark_[next] = Mark::outside;
          outside_.push_back(next);
        }
      }
      if (mark_[next] == Mark::outside) {
        const auto& corner = face_corners[f];
        border_.push_back({{cell.vertices[corner[0]], cell.vertices[corner[1]], cell.vertices[corner[2]]}, code});
      }
    }
  }
  return true;
}

void Insertion::abandon() {
  for (const std::uint32_t c : cavity_) mark_[c] = Mark::unknown;
  for (const std::uint32_t c : outside_) mark_[c] = Mark::unknown;
  cavity_.clear();
  outside_.clear();
  border_.clear();
}

std::uint32_t Insertion::fill() {
  place_new_cells();
  if (border_vertices_.size() <= table_side)
    connect_by_table();
  else
    connect_by_search();
  const std::uint32_t some = places_[0];
  d_.vertices[v_].cell = some;
  for (const std::uint32_t u : border_vertices_) local_[u + 1] = no_local;
  border_vertices_.clear();
  for (const std::uint32_t c : cavity_) mark_[c] = Mark::unknown;
  for (std::size_t i = border_.size(); i < cavity_.size(); ++i) {
    d_.cells[cavity_[i]].neighbors[0] = no_neighbor;
    d_.free_cells.push_back(cavity_[i]);
  }
  abandon();
  return some;
}

/// The visibility walk; ends in the cell that holds p, or in a ghost whose hull face p is above. The face that is tried
/// first changes from step to step, so that the walk does not favour a side.
std::uint32_t Insertion::walk(const Point3& p, std::uint32_t start) {
  std::uint32_t here = d_.is_ghost(start) ? cell_of(d_.cells[start].neighbors[3]) : start;
  std::uint32_t from = no_neighbor;
  while (true) {
    const Cell& cell = d_.cells[here];
    if (cell.vertices[3] == ghost_vertex) return here;
    std::uint32_t exit = 4;
    ++turn_;
    for (std::uint32_t k = 0; k < 4 && exit == 4; ++k) {
      const std::uint32_t f = (turn_ + k) & 3;
      if (cell.neighbors[f] == from) continue;
      const auto& corner = face_corners[f];
      if (orient3d(d_.point(cell.vertices[corner[0]]), d_.point(cell.vertices[corner[1]]),
                   d_.point(cell.vertices[corner[2]]), p) < 0)
        exit = f;
    }
    if (exit == 4) return here;
    from = face_code(here, exit);
    here = cell_of(cell.neighbors[exit]);
  }
}

CCDT_ALWAYS_INLINE bool Insertion::conflicts(const Cell& cell) const {
  if (cell.vertices[3] == ghost_vertex) return ghost_conflicts(cell);
  const auto& v = cell.vertices;
  const Sign sign = insphere_filter(d_.point(v[0]), d_.point(v[1]), d_.point(v[2]), d_.point(v[3]), p_);
  if (sign == Sign::plus || sign == Sign::minus) return sign == Sign::plus;
  return sign == Sign::zero ? tie_conflicts(cell) : conflicts_exactly(cell);
}

bool Insertion::conflicts_exactly(const Cell& cell) const {
  const auto& v = cell.vertices;
  const int sign = insphere(d_.point(v[0]), d_.point(v[1]), d_.point(v[2]), d_.point(v[3]), p_);
  return sign != 0 ? sign > 0 : tie_conflicts(cell);
}

bool Insertion::tie_conflicts(const Cell& cell) const {
  const auto vertex = [&](int i) -> const DelaunayVertex& { return d_.vertices[cell.vertices[i]]; };
  return tie_of_insphere(vertex(0).point, vertex(1).point, vertex(2).point, vertex(3).point, p_,
                         {vertex(0).id, vertex(1).id, vertex(2).id, vertex(3).id, d_.vertices[v_].id}) > 0;
}

/// A ghost's sphere is the outer half-space of its hull face and, in the plane of the face, the circumcircle.
bool Insertion::ghost_conflicts(const Cell& ghost) const {
  const DelaunayVertex &a = d_.vertices[ghost.vertices[0]], &b = d_.vertices[ghost.vertices[1]],
                       &c = d_.vertices[ghost.vertices[2]];
  const int side = orient3d(a.point, b.point, c.point, p_);
  if (side != 0) return side > 0;
  const std::uint32_t inner = ghost.neighbors[3];
  const Point3& apex = d_.point(d_.cells[cell_of(inner)].vertices[face_of(inner)]);
  // The apex is below the ghost's triangle: seen from it the triangle is a, c, b.
  return incircle_perturbed(a.point, c.point, b.point, apex, p_, {a.id, c.id, b.id, d_.vertices[v_].id}) > 0;
}

void Insertion::place_new_cells() {
  places_.assign(cavity_.begin(), cavity_.begin() + std::min(cavity_.size(), border_.size()));
  while (places_.size() < border_.size() && !d_.free_cells.empty()) {
    places_.push_back(d_.free_cells.back());
    d_.free_cells.pop_back();
  }
  if (places_.size() < border_.size()) {
    const std::size_t old = d_.cells.size(), more = border_.size() - places_.size();
    d_.cells.resize(old + more);
    mark_.resize(old + more, Mark::unknown);
    for (std::size_t i = 0; i < more; ++i) places_.push_back(static_cast<std::uint32_t>(old + i));
  }
  for (std::size_t i = 0; i < border_.size(); ++i) {
    CavityFace& face = border_[i];
    const std::uint32_t place = places_[i];
    Cell& cell = d_.cells[place];
    // The ghost is always vertex 3: exchanging two pairs of vertices keeps the orientation.
    auto& f = face.vertices;
    if (f[0] == ghost_vertex)
      cell.vertices = {f[2], f[1], v_, f[0]};
    else if (f[1] == ghost_vertex)
      cell.vertices = {f[0], f[2], v_, f[1]};
    else if (f[2] == ghost_vertex)
      cell.vertices = {f[1], f[0], v_, f[2]};
    else
      cell.vertices = {f[0], f[1], f[2], v_};
    const std::uint32_t apex = cell.vertices[3] == ghost_vertex ? 2 : 3;
    cell.neighbors[apex] = face.outside;
    d_.cells[cell_of(face.outside)].neighbors[face_of(face.outside)] = face_code(place, apex);
    for (const std::uint32_t u : f) {
      if (local_[u + 1] == no_local) {
        if (border_vertices_.size() < no_local) local_[u + 1] = static_cast<std::uint8_t>(border_vertices_.size());
        border_vertices_.push_back(u);
        if (u != ghost_vertex) d_.vertices[u].cell = place;
      }
    }
  }
}

namespace {

/// The face of a new cell that is opposite to the k-th vertex of its border face, by where the ghost was among them (3:
/// nowhere); see the order of vertices in `place_new_cells`.
constexpr std::uint8_t opposite[4][3] = {{3, 1, 0}, {0, 3, 1}, {1, 0, 3}, {0, 1, 2}};

std::uint32_t ghost_position(const std::array<std::uint32_t, 3>& f) {
  return f[0] == ghost_vertex ? 0 : f[1] == ghost_vertex ? 1 : f[2] == ghost_vertex ? 2 : 3;
}

}  // namespace

/// Two new cells are neighbors across the face of the new vertex and an edge of the border, which their border faces
/// pass in opposite directions. All edges are written before any is read, so the table need not be cleared.
void Insertion::connect_by_table() {
  for (std::size_t i = 0; i < border_.size(); ++i) {
    const auto& f = border_[i].vertices;
    const std::uint32_t local[3] = {local_[f[0] + 1], local_[f[1] + 1], local_[f[2] + 1]};
    const auto& face = opposite[ghost_position(f)];
    table_[local[1] * table_side + local[2]] = face_code(places_[i], face[0]);
    table_[local[2] * table_side + local[0]] = face_code(places_[i], face[1]);
    table_[local[0] * table_side + local[1]] = face_code(places_[i], face[2]);
  }
  for (std::size_t i = 0; i < border_.size(); ++i) {
    const auto& f = border_[i].vertices;
    const std::uint32_t local[3] = {local_[f[0] + 1], local_[f[1] + 1], local_[f[2] + 1]};
    const auto& face = opposite[ghost_position(f)];
    auto& neighbors = d_.cells[places_[i]].neighbors;
    neighbors[face[0]] = table_[local[2] * table_side + local[1]];
    neighbors[face[1]] = table_[local[0] * table_side + local[2]];
    neighbors[face[2]] = table_[local[1] * table_side + local[0]];
  }
}

/// The same for a cavity with more vertices than the table has rows: edges are paired by sorting.
void Insertion::connect_by_search() {
  struct Edge {
    std::uint64_t key;
    std::uint32_t code;
  };
  std::vector<Edge> edges;
  edges.reserve(3 * border_.size());
  for (std::size_t i = 0; i < border_.size(); ++i) {
    const auto& f = border_[i].vertices;
    const auto& face = opposite[ghost_position(f)];
    for (int k = 0; k < 3; ++k) {
      const std::uint64_t a = f[(k + 1) % 3], b = f[(k + 2) % 3];
      edges.push_back({std::min(a, b) << 32 | std::max(a, b), face_code(places_[i], face[k])});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) { return a.key < b.key; });
  for (std::size_t i = 0; i + 1 < edges.size(); i += 2) {
    const std::uint32_t a = edges[i].code, b = edges[i + 1].code;
    d_.cells[cell_of(a)].neighbors[face_of(a)] = b;
    d_.cells[cell_of(b)].neighbors[face_of(b)] = a;
  }
}

}  // namespace ccdt
