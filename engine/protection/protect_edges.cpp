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

/// Inserts interior vertices, except those that would destroy a protected edge or are where another one is.
class InteriorInsertion {
 public:
  /// \param points  where the vertices come from
  InteriorInsertion(delaunay::Delaunay& d, std::span<const Point3> points, const ProtectedEdges& edges,
                    const Progress& progress)
      : d_(d), points_(points), edges_(edges), progress_(progress), insertion_(d), last_(d.vertices[0].cell) {}

  const std::vector<std::uint32_t>& dropped() const { return dropped_; }

  /// In the order of their ranks. \param is_wanted  which ones, by vertex
  template <class Wanted>
  void insert(const Wanted& is_wanted) {
    const std::uint32_t first = first_interior();
    for (std::uint32_t v = first; v < d_.vertices.size(); ++v) {
      if ((v & 0xFFFF) == 0) report(progress_, "delaunay", v - first, d_.vertices.size() - first);
      if (is_wanted(v) && !insert(v, delaunay::Ties::greatest_rank)) dropped_.push_back(v);
    }
    note_bytes(bytes_of(d_.vertices, d_.cells, d_.free_cells, edges_.on_edge, points_) + insertion_.bytes());
  }

  /// \return false if the vertex was not inserted
  bool insert(std::uint32_t v, delaunay::Ties ties) {
    if (insertion_.find_cavity(v, last_, ties) && !destroys_edge(d_, insertion_, edges_, found_)) {
      last_ = insertion_.fill_cavity();
      return true;
    }
    insertion_.discard_cavity();
    return false;
  }

 private:
  std::uint32_t first_interior() const { return static_cast<std::uint32_t>(edges_.on_edge.size()); }

  delaunay::Delaunay& d_;
  std::span<const Point3> points_;
  const ProtectedEdges& edges_;
  const Progress& progress_;
  delaunay::Insertion insertion_;
  std::vector<std::uint64_t> found_;
  std::vector<std::uint32_t> dropped_;
  std::uint32_t last_;
};

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

namespace {

/// Inserts all points into a tetrahedralization that has none of them yet.
delaunay::Delaunay insert_all(std::span<const Point3> points, const std::vector<std::uint32_t>& order,
                              delaunay::Delaunay d, const ProtectedEdges& edges, const Progress& progress) {
  add_vertices(d, points, order);
  InteriorInsertion insertion(d, points, edges, progress);
  insertion.insert([](std::uint32_t) { return true; });
  remove_vertices(d, insertion.dropped());
  return d;
}

/// Inserts the points that are not deep in a lattice, and puts the others in with the core.
class CoreInsertion {
 public:
  CoreInsertion(const lattice::LatticePoints& lattice, const std::vector<std::uint32_t>& order,
                const delaunay::Delaunay& surface)
      : lattice_(lattice),
        order_(order),
        first_(static_cast<std::uint32_t>(surface.vertices.size())),
        vertex_(order.size()) {
    for (std::uint32_t i = 0; i < order.size(); ++i) vertex_[order[i]] = first_ + i;
    others_.reserve(first_);
    for (const delaunay::DelaunayVertex& v : surface.vertices) others_.push_back(v.point);
    core_ = find_core();
  }

  std::size_t core_cells() const { return core_.cell_count; }

  /// \param d  has no interior vertex yet
  /// \return   false if the core cannot be told; `d` is of no use then
  bool run(delaunay::Delaunay& d, const ProtectedEdges& edges, const Progress& progress) {
    add_vertices(d, lattice_.points, order_, core_.cell_count);
    InteriorInsertion insertion(d, lattice_.points, edges, progress);
    std::size_t tried = 0;
    bool gives_up = false;
    insertion.insert([&](std::uint32_t v) {
      gives_up = gives_up || (++tried > least_tried && most_dropped * insertion.dropped().size() > tried);
      return !core_.is_deep[v] && !gives_up;
    });
    if (gives_up || !withdraw_from(insertion.dropped(), insertion)) return false;
    cores::insert_core(core_, d);
    remove_vertices(d, insertion.dropped());
    return true;
  }

 private:
  /// Where more than one in so many points is dropped, some of those that are called deep would be dropped as well.
  static constexpr std::size_t most_dropped = 12, least_tried = 1000;

  cores::LatticeCore find_core() const {
    return cores::find_lattice_core(lattice_, vertex_, others_, first_ + order_.size());
  }

  /// Makes the core one without the dropped vertices. What is no longer deep is inserted, later than its rank says.
  /// \return  false if one of these would destroy an edge, which it might not have done in its turn
  bool withdraw_from(const std::vector<std::uint32_t>& dropped, InteriorInsertion& insertion) {
    if (dropped.empty()) return true;
    for (const std::uint32_t v : dropped) vertex_[order_[v - first_]] = cores::nothing;
    const std::vector<bool> was_deep = std::move(core_.is_deep);
    core_ = find_core();
    for (std::uint32_t v = first_; v < was_deep.size(); ++v)
      if (was_deep[v] && !core_.is_deep[v] && !insertion.insert(v, delaunay::Ties::any_rank)) return false;
    return true;
  }

  const lattice::LatticePoints& lattice_;
  const std::vector<std::uint32_t>& order_;
  const std::uint32_t first_;
  std::vector<std::uint32_t> vertex_;  ///< by point
  std::vector<Point3> others_;         ///< all other vertices
  cores::LatticeCore core_;
};

}  // namespace

delaunay::Delaunay insert_interior(std::span<const Point3> points, ProtectedDelaunay start, const Progress& progress) {
  const ProtectedEdges edges(start);
  return insert_all(points, delaunay::hilbert_order(points), std::move(start.delaunay), edges, progress);
}

CoreDelaunay core_interior(const lattice::LatticePoints& lattice, ProtectedDelaunay start, const Progress& progress) {
  const ProtectedEdges edges(start);
  const std::vector<std::uint32_t> order = delaunay::hilbert_order(lattice.points);
  CoreInsertion core(lattice, order, start.delaunay);
  if (core.core_cells() > 0) {
    delaunay::Delaunay d = start.delaunay;
    if (core.run(d, edges, progress)) return {std::move(d), core.core_cells()};
  }
  return {insert_all(lattice.points, order, std::move(start.delaunay), edges, progress), 0};
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
