#include "engine/steiner/remove_steiner_vertices.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "engine/base/count_work.h"
#include "engine/steiner/loosen_star.h"
#include "engine/steiner/plan_vertex_removal.h"

namespace ccdt::steiner {
namespace {

constexpr std::array all_efforts = {RemovalEffort::collapse, RemovalEffort::fill};

/// How often the cells around a vertex are loosened before the next vertex has its turn.
constexpr int loosenings = 8;
/// How many edges and faces loosening tries to remove at random. A few are enough for most vertices, so the first turn
/// of each is cheap.
constexpr int few_shakes = 25, many_shakes = 250;
/// The turns beyond the first two of each vertex. Nearly all vertices are removed in the first two turns, a few only
/// after dozens, and some never.
constexpr std::size_t more_turns = 100;

/// A Steiner vertex and its neighbors on the segment.
struct Candidate {
  VertexId vertex;  ///< none if it was removed or may not be
  std::array<std::uint32_t, 2> neighbors{};
  /// By effort: the number of the last change when it could not be removed.
  std::array<std::uint64_t, all_efforts.size()> tried_at{};
};

class SteinerRemover {
 public:
  SteinerRemover(CellComplex& x, std::uint32_t first_steiner) : x_(x), first_steiner_(first_steiner) {}

  void add_chain(std::span<const protection::ChainVertex> chain) {
    for (std::size_t i = 1; i + 1 < chain.size(); ++i) {
      const VertexId v = chain[i].vertex;
      if (v < first_steiner_ || x_.cell_at(v).is_none()) continue;
      const std::size_t place = v - first_steiner_;
      if (place >= candidates_.size()) candidates_.resize(place + 1);
      candidates_[place] = {v, {chain[i - 1].vertex, chain[i + 1].vertex}};
    }
  }

  /// \return how many were removed
  std::uint64_t run(const Progress& progress) {
    for (std::size_t effort = 0; effort < all_efforts.size();)
      effort = pass(all_efforts[effort], progress) ? 0 : effort + 1;
    loosen_rest(progress);
    return removed_;
  }

 private:
  /// Tries each vertex once, the last split first, unless nothing around it has changed since it was last tried.
  /// \return was one removed?
  bool pass(RemovalEffort effort, const Progress& progress) {
    const std::uint64_t before = removed_;
    for (std::size_t i = candidates_.size(); i-- > 0;) {
      report(progress, "improve", candidates_.size() - i, candidates_.size());
      Candidate& c = candidates_[i];
      std::uint64_t& tried_at = c.tried_at[static_cast<std::size_t>(effort)];
      if (c.vertex.is_none() || x_.changed_at(c.vertex) < tried_at || remove(c, effort)) continue;
      tried_at = x_.change_count() + 1;
    }
    return removed_ > before;
  }

  /// \return was it removed?
  bool remove(Candidate& c, RemovalEffort effort) {
    if (!plan_vertex_removal(x_, c.vertex, c.neighbors, effort, scratch_, change_)) return false;
    x_.apply(change_, made_);
    for (int side = 0; side < 2; ++side) replace_neighbor(c.neighbors[side], c.vertex, c.neighbors[1 - side]);
    c.vertex = {};
    ++removed_;
    return true;
  }

  void replace_neighbor(std::uint32_t of, std::uint32_t from, std::uint32_t to) {
    if (of < first_steiner_ || of - first_steiner_ >= candidates_.size()) return;
    std::ranges::replace(candidates_[of - first_steiner_].neighbors, from, to);
  }

  /// Tries the remaining vertices again and again, each time after changing the cells around them.
  void loosen_rest(const Progress& progress) {
    std::vector<std::size_t> left;
    for (std::size_t i = 0; i < candidates_.size(); ++i)
      if (!candidates_[i].vertex.is_none()) left.push_back(i);
    std::size_t turn = 0, most_turns = left.size();
    const auto give_turns = [&](int shakes) {
      std::erase_if(left, [&](std::size_t i) {
        report(progress, "improve", turn++, most_turns);
        return remove_loosened(candidates_[i], shakes);
      });
    };
    give_turns(few_shakes);
    most_turns = turn + left.size() + more_turns;
    while (!left.empty() && turn + left.size() <= most_turns) give_turns(many_shakes);
    work_done.removal_turns += left.size();
  }

  /// Changes the cells around a vertex until it can be removed. \return was it removed?
  bool remove_loosened(Candidate& c, int shakes) {
    for (int i = 0; i < loosenings; ++i) {
      loosen_star(x_, c.vertex, shakes, loosening_);
      const bool is_removed = remove(c, RemovalEffort::collapse) || remove(c, RemovalEffort::fill);
      tidy_star(x_, is_removed ? c.neighbors[0] : c.vertex, loosening_);
      if (is_removed) return true;
    }
    return false;
  }

  CellComplex& x_;
  const std::uint32_t first_steiner_;
  std::vector<Candidate> candidates_;  ///< by vertex, from the first Steiner vertex
  std::uint64_t removed_ = 0;
  Loosening loosening_;

  // Working memory.
  RemovalScratch scratch_;
  Change change_;
  std::vector<CellId> made_;
};

}  // namespace

std::uint64_t remove_steiner_vertices(const plc::Plc& plc, std::uint32_t first_steiner, CellComplex& x,
                                      protection::SegmentChains& chains, const Progress& progress) {
  if (protection::count_split(chains) == 0) return 0;
  x.index_faces();
  SteinerRemover remover(x, first_steiner);
  for (std::size_t s = 0; s < chains.size(); ++s)
    if (!plc.segments[s].touching) remover.add_chain(chains[s]);
  const std::uint64_t removed = remover.run(progress);
  chains.erase_if([&](const protection::ChainVertex& v) { return x.is_removed(v.vertex); });
  return removed;
}

}  // namespace ccdt::steiner
