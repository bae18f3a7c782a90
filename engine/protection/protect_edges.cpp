#include "engine/protection/protect_edges.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "engine/base/count_work.h"
#include "engine/base/hash_table.h"
#include "engine/base/parallel.h"
#include "engine/base/simplex_map.h"
#include "engine/delaunay/delaunay.h"
#include "engine/protection/split_edges.h"

namespace ccdt::protection {
namespace {

/// The pieces that are not edges, in the order of their segments. Most pieces are edges.
std::vector<std::uint64_t> find_missing(const plc::Plc& plc, const ProtectedDelaunay& state) {
  const bool has_new_vertices = state.delaunay.vertices.size() != plc.vertices.size();
  return parallel_collect<std::uint64_t>(
      state.chains.size(), 1024, [&](std::size_t s, std::size_t end, std::vector<std::uint64_t>& missing) {
        for (; s < end; ++s) {
          if (!state.must_be_chain[s] || (plc.segments[s].face != plc::no_face && !has_new_vertices)) continue;
          const std::span<const ChainVertex> chain = state.chains[s];
          for (std::size_t i = 0; i + 1 < chain.size(); ++i)
            if (!has_edge(state.delaunay, chain[i].vertex, chain[i + 1].vertex))
              missing.push_back(edge_key(chain[i].vertex, chain[i + 1].vertex));
        }
      });
}

/// Splits pieces of segments until all that need protection are Delaunay edges. A stack holds the missing pieces: those
/// missing from the start, then those that a split made or destroyed. A lost edge never comes back. A stack needs fewer
/// splits than a queue, because one place is finished before the next one.
class Protector {
 public:
  Protector(const plc::Plc& plc, Protection strategy, std::vector<std::uint64_t> missing, ProtectedDelaunay& state)
      : state_(state), splitter_(plc, strategy, state.delaunay, state.chains), stack_(std::move(missing)) {
    for (std::uint32_t s = 0; s < state.chains.size(); ++s)
      for (std::size_t i = 0; state.must_be_chain[s] && i + 1 < state.chains[s].size(); ++i)
        pieces_.push_back({s, state.chains[s][i], state.chains[s][i + 1]});
    piece_of_.reserve(pieces_.size());
    for (std::uint32_t p = 0; p < pieces_.size(); ++p) index_piece(p);
  }

  void split_those_that_can_be(std::span<const PieceEnds> pieces) {
    for (const PieceEnds& ends : pieces) {
      const std::uint32_t* piece = piece_of_.find(edge_key(ends[0], ends[1]));
      if (piece != nullptr && splitter_.can_split(pieces_[*piece])) split(pieces_[*piece]);
    }
  }

  void protect(const Progress& progress) {
    for (std::uint64_t done = 0; !stack_.empty(); ++done) {
      if ((done & 0xFFF) == 0) report(progress, "protect", done, done + stack_.size());
      const std::uint64_t edge = stack_.back();
      stack_.pop_back();
      if (const std::uint32_t* piece = piece_of_.find(edge)) split(pieces_[*piece]);
    }
    state_.chains.insert(std::move(added_));
  }

 private:
  static std::uint64_t key_of(const Subsegment& piece) { return edge_key(piece.from.vertex, piece.to.vertex); }

  void index_piece(std::uint32_t p) {
    const std::uint32_t a = pieces_[p].from.vertex, b = pieces_[p].to.vertex;
    piece_of_.set(edge_key(a, b), p);
    other_ends_.resize(state_.delaunay.vertices.size(), 0);
    other_ends_[a] |= bit_of(b);
    other_ends_[b] |= bit_of(a);
  }

  void add(const Subsegment& piece) {
    pieces_.push_back(piece);
    index_piece(static_cast<std::uint32_t>(pieces_.size() - 1));
    if (!has_edge(state_.delaunay, piece.from.vertex, piece.to.vertex)) stack_.push_back(key_of(piece));
  }

  static std::uint64_t bit_of(std::uint32_t vertex) { return std::uint64_t{1} << vertex % 64; }

  /// Visits the pieces among the edges of a cell or a face; most other edges are skipped without being looked up. Edges
  /// of cells and faces with the ghost are edges of others, too.
  template <std::size_t n, class Visit>
  void visit_pieces(const std::array<std::uint32_t, n>& vertices, const Visit& visit) const {
    if (std::ranges::find(vertices, delaunay::ghost_vertex) != vertices.end()) return;
    for (std::size_t i = 1; i < n; ++i)
      for (std::size_t j = 0; j < i; ++j)
        if ((other_ends_[vertices[i]] & bit_of(vertices[j])) != 0 &&
            (other_ends_[vertices[j]] & bit_of(vertices[i])) != 0)
          if (const std::uint32_t* piece = piece_of_.find(edge_key(vertices[i], vertices[j]))) visit(*piece);
  }

  /// Finds the pieces within the cavity, in an order that does not depend on that of the cells.
  void find_lost() {
    lost_.clear();
    met_in_.resize(pieces_.size(), 0);
    const std::size_t split = added_.size() + 1;
    for (const delaunay::CavityFace& face : splitter_.insertion().cavity_faces())
      visit_pieces(face.vertices, [&](std::uint32_t piece) { met_in_[piece] = split; });
    for (const std::uint32_t cell : splitter_.insertion().cavity_cells())
      visit_pieces(state_.delaunay.cells[cell].vertices, [&](std::uint32_t piece) {
        if (std::exchange(met_in_[piece], split) != split) lost_.push_back(key_of(pieces_[piece]));
      });
    std::ranges::sort(lost_);
  }

  void split(const Subsegment piece) {
    const ChainVertex middle = splitter_.choose(piece);
    find_lost();
    splitter_.insert();
    added_.push_back({piece.segment, middle});
    piece_of_.erase(piece_of_.find(key_of(piece)));
    add({piece.segment, piece.from, middle});
    add({piece.segment, middle, piece.to});
    stack_.insert(stack_.end(), lost_.begin(), lost_.end());
  }

  ProtectedDelaunay& state_;
  EdgeSplitter splitter_;
  std::vector<InnerVertex> added_;
  std::vector<Subsegment> pieces_;                    // also those that were split
  HashTable<std::uint64_t, std::uint32_t> piece_of_;  // by their edges: the pieces that were not split
  std::vector<std::uint64_t> other_ends_;             // by vertex: bits of the other ends of pieces there
  std::vector<std::uint64_t> lost_;                   // pieces that the last split has destroyed
  std::vector<std::size_t> met_in_;                   // by piece: the last split with it in the cavity or on its border
  std::vector<std::uint64_t> stack_;                  // of edges that do not exist; some may be split by now
};

}  // namespace

ProtectedDelaunay unprotected(const plc::Plc& plc, delaunay::Delaunay delaunay, SegmentChains chains) {
  ProtectedDelaunay result{std::move(delaunay), std::move(chains), {}};
  for (const plc::Segment& s : plc.segments) result.must_be_chain.push_back(s.grazeable);
  result.chains.append(std::span(plc.segments).subspan(result.chains.size()));
  return result;
}

ProtectedDelaunay protect_edges(const plc::Plc& plc, ProtectedDelaunay start, Protection strategy,
                                const Progress& progress, std::span<const PieceEnds> to_split) {
  report(progress, "protect", 0, start.chains.size());
  std::vector<std::uint64_t> missing = find_missing(plc, start);
  if (!missing.empty() || !to_split.empty()) {
    Protector protector(plc, strategy, std::move(missing), start);
    protector.split_those_that_can_be(to_split);
    protector.protect(progress);
  }
  note_bytes(
      bytes_of(start.delaunay.vertices, start.delaunay.cell_at, start.delaunay.cells, start.delaunay.free_cells));
  return start;
}

std::vector<std::uint64_t> count_splits_by_level(const SegmentChains& chains) {
  std::vector<std::uint64_t> splits;
  for (std::size_t s = 0; s < chains.size(); ++s)
    for (const ChainVertex& v : chains[s]) {
      if (v.level > splits.size()) splits.resize(v.level, 0);
      if (v.level > 0) ++splits[v.level - 1];
    }
  return splits;
}

}  // namespace ccdt::protection
