#include "engine/improve/remove_steiner_vertices.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "engine/improve/plan_vertex_removal.h"
#include "engine/plc/boundary_sides.h"

namespace ccdt::improve {
namespace {

constexpr std::array all_efforts = {RemovalEffort::collapse, RemovalEffort::fill, RemovalEffort::grow};

/// A Steiner vertex and its neighbors on the segment.
struct Candidate {
  std::uint32_t vertex = no_neighbor;  ///< none if it was removed or may not be
  std::array<std::uint32_t, 2> neighbors{};
  /// By effort: the number of the last change when it could not be removed.
  std::array<std::uint64_t, all_efforts.size()> tried_at{};
};

class SteinerRemover {
 public:
  SteinerRemover(CellComplex& x, std::uint32_t first_steiner) : x_(x), removal_(x), first_steiner_(first_steiner) {}

  void add_chain(const std::vector<protection::ChainVertex>& chain) {
    for (std::size_t i = 1; i + 1 < chain.size(); ++i) {
      const std::uint32_t v = chain[i].vertex;
      if (v < first_steiner_ || x_.cell_at(v) == no_neighbor) continue;
      const std::size_t place = v - first_steiner_;
      if (place >= candidates_.size()) candidates_.resize(place + 1);
      candidates_[place] = {v, {chain[i - 1].vertex, chain[i + 1].vertex}};
    }
  }

  /// \return how many were removed
  std::uint64_t run(const Progress& progress) {
    std::uint64_t all = 0;
    for (std::size_t effort = 0; effort < all_efforts.size();) {
      const std::uint64_t removed = pass(all_efforts[effort], progress);
      all += removed;
      effort = removed > 0 ? 0 : effort + 1;
    }
    return all;
  }

 private:
  /// Tries each vertex once, the last split first, unless nothing around it has changed since it was last tried.
  std::uint64_t pass(RemovalEffort effort, const Progress& progress) {
    std::uint64_t removed = 0;
    for (std::size_t i = candidates_.size(); i-- > 0;) {
      report(progress, "improve", candidates_.size() - i, candidates_.size());
      Candidate& c = candidates_[i];
      std::uint64_t& tried_at = c.tried_at[static_cast<std::size_t>(effort)];
      if (c.vertex == no_neighbor || x_.changed_at(c.vertex) < tried_at) continue;
      if (removal_.plan(c.vertex, c.neighbors, effort, change_)) {
        remove(c);
        ++removed;
      } else {
        tried_at = x_.change_count() + 1;
      }
    }
    return removed;
  }

  void remove(Candidate& c) {
    x_.apply(change_, made_);
    for (int side = 0; side < 2; ++side) replace_neighbor(c.neighbors[side], c.vertex, c.neighbors[1 - side]);
    c.vertex = no_neighbor;
  }

  void replace_neighbor(std::uint32_t of, std::uint32_t from, std::uint32_t to) {
    if (of < first_steiner_ || of - first_steiner_ >= candidates_.size()) return;
    std::ranges::replace(candidates_[of - first_steiner_].neighbors, from, to);
  }

  CellComplex& x_;
  VertexRemoval removal_;
  const std::uint32_t first_steiner_;
  std::vector<Candidate> candidates_;  ///< by vertex, from the first Steiner vertex

  // Working memory.
  Change change_;
  std::vector<std::uint32_t> made_;
};

}  // namespace

std::uint64_t remove_steiner_vertices(const plc::Plc& plc, std::uint32_t first_steiner, CellComplex& x,
                                      protection::SegmentChains& chains, const Progress& progress) {
  if (std::ranges::none_of(chains, protection::is_split)) return 0;
  SteinerRemover remover(x, first_steiner);
  const std::vector<std::uint32_t> sides = plc::count_boundary_sides(plc);
  for (std::size_t s = 0; s < chains.size(); ++s)
    if (sides[s] <= 2) remover.add_chain(chains[s]);
  const std::uint64_t removed = remover.run(progress);
  for (auto& chain : chains)
    std::erase_if(chain, [&](const protection::ChainVertex& v) { return x.is_removed(v.vertex); });
  return removed;
}

}  // namespace ccdt::improve
