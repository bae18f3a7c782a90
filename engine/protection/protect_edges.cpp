#include "engine/protection/protect_edges.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "engine/base/count_work.h"
#include "engine/base/hash_table.h"
#include "engine/base/simplex_map.h"
#include "engine/cores/lattice_core.h"
#include "engine/delaunay/delaunay.h"
#include "engine/delaunay/insertion.h"
#include "engine/protection/split_edges.h"

namespace ccdt::protection {
namespace {

constexpr std::uint32_t whole = whole_segment;
constexpr std::uint32_t no_cell = 0;  // of vertices that are to be inserted

/// So often the core is tried before all points are inserted.
constexpr int most_attempts = 3;

/// Splits pieces of segments until all that have to be are Delaunay edges. A stack holds those that may not be: all at
/// first, then those of cells that a split has destroyed. It takes fewer splits than a queue, as one place is finished
/// before the next one.
class Protector {
 public:
  Protector(const plc::Plc& plc, Protection strategy, ProtectedDelaunay& state)
      : state_(state), splitter_(plc, strategy, state.delaunay, state.chains), star_(state.delaunay) {
    for (std::uint32_t s = 0; s < state.chains.size(); ++s)
      for (std::size_t i = 0; state.must_be_chain[s] && i + 1 < state.chains[s].size(); ++i)
        add({s, state.chains[s][i], state.chains[s][i + 1]});
  }

  void protect(const Progress& progress) {
    for (std::uint64_t done = 0; !stack_.empty(); ++done) {
      if ((done & 0xFFF) == 0) report(progress, "protect", done, done + stack_.size());
      const std::uint64_t edge = stack_.back();
      stack_.pop_back();
      const Subsegment* piece = pieces_.find(edge);
      if (piece != nullptr && !star_.has_edge(piece->from.vertex, piece->to.vertex)) split(*piece);
    }
    for (auto& chain : state_.chains) std::ranges::sort(chain, {}, &ChainVertex::fraction);
  }

 private:
  void add(const Subsegment& piece) {
    const std::uint64_t edge = edge_key(piece.from.vertex, piece.to.vertex);
    pieces_.set(edge, piece);
    stack_.push_back(edge);
  }

  void split(const Subsegment piece) {
    const ChainVertex middle = splitter_.split(piece);
    state_.chains[piece.segment].push_back(middle);
    pieces_.erase(pieces_.find(edge_key(piece.from.vertex, piece.to.vertex)));
    add({piece.segment, piece.from, middle});
    add({piece.segment, middle, piece.to});
    for (const auto& v : splitter_.destroyed())
      for (int i = 1; i < 4; ++i)
        for (int j = 0; j < i; ++j)
          if (const std::uint64_t edge = edge_key(v[i], v[j]); pieces_.find(edge) != nullptr) stack_.push_back(edge);
  }

  ProtectedDelaunay& state_;
  EdgeSplitter splitter_;
  delaunay::CellStar star_;
  HashTable<std::uint64_t, Subsegment> pieces_;  // by their edges
  std::vector<std::uint64_t> stack_;             // of edges, some of which may be split or there meanwhile
};

/// The Delaunay edges that must stay.
std::vector<std::array<VertexId, 2>> edges_that_stay(const ProtectedDelaunay& p) {
  std::vector<std::array<VertexId, 2>> edges;
  for (std::size_t s = 0; s < p.chains.size(); ++s)
    for (std::size_t i = 0; p.must_be_chain[s] && i + 1 < p.chains[s].size(); ++i)
      edges.push_back({p.chains[s][i].vertex, p.chains[s][i + 1].vertex});
  return edges;
}

/// The edges that must stay, for fast queries.
struct ProtectedEdges {
  std::vector<std::uint8_t> on_edge;  ///< by vertex, those before the interior ones
  EdgeMap edges;

  explicit ProtectedEdges(const ProtectedDelaunay& p) : on_edge(p.delaunay.vertices.size(), 0) {
    const auto list = edges_that_stay(p);
    for (const auto& [a, b] : list) on_edge[a] = on_edge[b] = 1;
    edges = EdgeMap(list, on_edge.size());
  }
  bool is_empty() const { return edges.empty(); }
  bool may_have(std::uint32_t v) const { return v < on_edge.size() && on_edge[v] != 0; }
  bool has(std::uint32_t a, std::uint32_t b) const { return edges.find(a, b) != EdgeMap::none; }
};

/// Would filling this cavity destroy a protected edge, one that no face of the cavity has?
bool destroys_edge(const delaunay::Delaunay& d, const delaunay::Insertion& insertion, const ProtectedEdges& edges,
                   std::vector<std::uint64_t>& found) {
  found.clear();
  const auto interior = static_cast<std::uint32_t>(edges.on_edge.size());  // the first id, and all from there on
  for (const std::uint32_t c : insertion.cavity_cells()) {
    const auto& v = d.cells[c].vertices;
    const int others = int{v[0] < interior} + int{v[1] < interior} + int{v[2] < interior} + int{v[3] < interior};
    if (others < 2) continue;
    for (int i = 1; i < 4; ++i) {
      if (!edges.may_have(v[i])) continue;
      for (int j = 0; j < i; ++j) {
        if (edges.may_have(v[j]) && edges.has(v[i], v[j])) found.push_back(edge_key(v[i], v[j]));
      }
    }
  }
  if (found.empty()) return false;
  std::ranges::sort(found);
  const auto repeated = std::ranges::unique(found);
  // The faces are a closed surface, which passes each of its edges once in each direction.
  std::ptrdiff_t on_faces = 0;
  for (const delaunay::CavityFace& face : insertion.cavity_faces()) {
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t a = face.vertices[i], b = face.vertices[i < 2 ? i + 1 : 0];
      if (a < b && edges.may_have(a) && edges.may_have(b) && edges.has(a, b)) ++on_faces;
    }
  }
  return on_faces < repeated.begin() - found.begin();
}

/// Adds the points in this order to the vertices, which take part in no cell yet.
///
/// \param more_cells  that are to come beside those of insertion
void add_vertices(delaunay::Delaunay& d, std::span<const Point3> points, const std::vector<std::uint32_t>& order,
                  std::size_t more_cells = 0) {
  d.vertices.reserve(d.vertices.size() + points.size());
  for (const std::uint32_t i : order)
    d.vertices.push_back({points[i], static_cast<std::uint32_t>(d.vertices.size()), no_cell});
  const std::size_t inserted = points.size() - std::min(points.size(), more_cells / 6);
  d.cells.reserve(d.cells.size() + 7 * inserted + more_cells);
}

/// Inserts the vertices from the first interior one on, except those that are left out and those that would destroy a
/// protected edge.
///
/// \param left_out  by vertex; empty: none
/// \return          the vertices that would have destroyed an edge, or are where another one is
std::vector<std::uint32_t> insert_vertices(delaunay::Delaunay& d, const ProtectedEdges& edges,
                                           const std::vector<bool>& left_out, const Progress& progress) {
  const auto first = static_cast<std::uint32_t>(edges.on_edge.size());
  delaunay::Insertion insertion(d);
  std::vector<std::uint64_t> found;
  std::vector<std::uint32_t> dropped;
  std::uint32_t last = d.vertices[0].cell;
  for (std::uint32_t v = first; v < d.vertices.size(); ++v) {
    if ((v & 0xFFFF) == 0) report(progress, "delaunay", v - first, d.vertices.size() - first);
    if (!left_out.empty() && left_out[v]) continue;
    if (insertion.find_cavity(v, last) && !destroys_edge(d, insertion, edges, found)) {
      last = insertion.fill_cavity();
    } else {
      insertion.discard_cavity();
      dropped.push_back(v);
    }
  }
  note_bytes(bytes_of(d.vertices, d.cells, d.free_cells, edges.on_edge) + insertion.bytes());
  return dropped;
}

/// Removes vertices that no cell has; those behind them move up.
///
/// \param dropped  interior ones, in increasing order
void remove_vertices(delaunay::Delaunay& d, const std::vector<std::uint32_t>& dropped) {
  if (dropped.empty()) return;
  std::vector<std::uint32_t> number(d.vertices.size());
  std::uint32_t kept = 0;
  auto next = dropped.begin();
  for (std::uint32_t v = 0; v < d.vertices.size(); ++v) {
    if (next != dropped.end() && *next == v) {
      ++next;
      continue;
    }
    number[v] = kept;
    d.vertices[kept] = d.vertices[v];
    if (v >= dropped.front()) d.vertices[kept].rank = kept;
    ++kept;
  }
  d.vertices.resize(kept);
  for (delaunay::Cell& cell : d.cells)
    for (std::uint32_t& v : cell.vertices)
      if (v != delaunay::ghost_vertex) v = number[v];
}

/// The vertices with the points that are not among them, ranked as they would be inserted.
std::vector<delaunay::DelaunayVertex> with_points(std::vector<delaunay::DelaunayVertex> vertices,
                                                  std::span<const Point3> points) {
  const auto less = [](const Point3& a, const Point3& b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); };
  std::vector<Point3> taken;
  taken.reserve(vertices.size());
  for (const delaunay::DelaunayVertex& v : vertices) taken.push_back(v.point);
  std::ranges::sort(taken, less);
  for (const std::uint32_t i : delaunay::hilbert_order(points))
    if (!std::ranges::binary_search(taken, points[i], less))
      vertices.push_back({points[i], static_cast<std::uint32_t>(vertices.size()), 0});
  return vertices;
}

}  // namespace

ProtectedDelaunay unprotected(const plc::Plc& plc, delaunay::Delaunay delaunay, SegmentChains chains) {
  ProtectedDelaunay result{std::move(delaunay), std::move(chains), {}};
  const bool is_split = !result.chains.empty();
  for (const plc::Segment& s : plc.segments) {
    if (!is_split) result.chains.push_back({{s.ends[0], 0}, {s.ends[1], whole}});
    result.must_be_chain.push_back(s.grazeable);
  }
  return result;
}

ProtectedDelaunay protect_edges(const plc::Plc& plc, ProtectedDelaunay start, Protection strategy,
                                const Progress& progress) {
  Protector(plc, strategy, start).protect(progress);
  note_bytes(bytes_of(start.delaunay.vertices, start.delaunay.cells, start.delaunay.free_cells));
  return start;
}

std::vector<std::uint64_t> count_splits_by_level(const SegmentChains& chains) {
  std::vector<std::uint64_t> splits;
  for (const auto& chain : chains)
    for (const ChainVertex& v : chain) {
      if (v.level > splits.size()) splits.resize(v.level, 0);
      if (v.level > 0) ++splits[v.level - 1];
    }
  return splits;
}

delaunay::Delaunay insert_interior(std::span<const Point3> points, ProtectedDelaunay start, const Progress& progress) {
  const ProtectedEdges edges(start);
  delaunay::Delaunay d = std::move(start.delaunay);
  add_vertices(d, points, delaunay::hilbert_order(points));
  const std::vector<std::uint32_t> dropped = insert_vertices(d, edges, {}, progress);
  remove_vertices(d, dropped);
  return d;
}

CoreDelaunay core_interior(const lattice::LatticePoints& lattice, ProtectedDelaunay start, const Progress& progress) {
  const ProtectedEdges edges(start);
  const std::vector<std::uint32_t> order = delaunay::hilbert_order(lattice.points);
  const auto first = static_cast<std::uint32_t>(start.delaunay.vertices.size());
  std::vector<std::uint32_t> vertex(order.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) vertex[order[i]] = first + i;
  std::vector<Point3> others;
  for (const delaunay::DelaunayVertex& v : start.delaunay.vertices) others.push_back(v.point);

  // A point that is dropped may have been taken for a vertex of the core. Then all is done again without it.
  for (int attempt = 1;; ++attempt) {
    cores::LatticeCore core;
    if (attempt <= most_attempts) core = cores::find_lattice_core(lattice, vertex, others, first + order.size());
    const bool is_last = core.cell_count == 0;
    delaunay::Delaunay d = is_last || edges.is_empty() ? std::move(start.delaunay) : start.delaunay;
    add_vertices(d, lattice.points, order, core.cell_count);
    const std::vector<std::uint32_t> dropped = insert_vertices(d, edges, core.is_deep, progress);
    if (!cores::insert_core(core, dropped, d)) {
      for (const std::uint32_t v : dropped) vertex[order[v - first]] = cores::nothing;
      continue;
    }
    remove_vertices(d, dropped);
    return {std::move(d), core.cell_count};
  }
}

delaunay::Delaunay wrap_interior(std::span<const Point3> points, ProtectedDelaunay start, double grid_scale,
                                 const Progress& progress) {
  delaunay::Delaunay all = delaunay::wrap_delaunay(with_points(start.delaunay.vertices, points), grid_scale, progress);
  // Edges that are there with all points were there with any part of them: then insertion would drop none.
  delaunay::CellStar star(all);
  if (std::ranges::all_of(edges_that_stay(start), [&](const auto& edge) { return star.has_edge(edge[0], edge[1]); }))
    return all;
  return delaunay::wrap_delaunay(insert_interior(points, std::move(start), progress).vertices, grid_scale, progress);
}

}  // namespace ccdt::protection
