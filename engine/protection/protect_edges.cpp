#include "engine/protection/protect_edges.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "engine/base/count_work.h"
#include "engine/base/hash_table.h"
#include "engine/base/simplex_map.h"
#include "engine/delaunay/delaunay.h"
#include "engine/delaunay/insertion.h"
#include "engine/protection/split_edges.h"

namespace ccdt::protection {
namespace {

constexpr std::uint32_t whole = whole_segment;

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
  delaunay::Delaunay& delaunay = start.delaunay;
  delaunay.vertices.reserve(delaunay.vertices.size() + points.size());
  delaunay.cells.reserve(delaunay.cells.size() + 7 * points.size());
  delaunay::Insertion insertion(delaunay);
  std::vector<std::uint64_t> found;
  std::uint32_t last = delaunay.vertices[0].cell;
  std::uint64_t done = 0;
  for (const std::uint32_t i : delaunay::hilbert_order(points)) {
    if ((++done & 0xFFFF) == 0) report(progress, "delaunay", done, points.size());
    const auto id = static_cast<std::uint32_t>(delaunay.vertices.size());
    delaunay.vertices.push_back({points[i], id, 0});
    if (insertion.find_cavity(id, last) && !destroys_edge(delaunay, insertion, edges, found)) {
      last = insertion.fill_cavity();
    } else {
      insertion.discard_cavity();
      delaunay.vertices.pop_back();
    }
  }
  note_bytes(bytes_of(delaunay.vertices, delaunay.cells, delaunay.free_cells, edges.on_edge, points) +
             insertion.bytes());
  return std::move(start.delaunay);
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
