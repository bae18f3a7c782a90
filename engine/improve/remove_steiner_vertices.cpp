#include "engine/improve/remove_steiner_vertices.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>

#include "engine/improve/plan_vertex_removal.h"
#include "engine/plc/boundary_sides.h"

namespace ccdt::improve {
namespace {

/// A Steiner vertex and its neighbors on the segment.
struct Candidate {
  std::uint32_t vertex;
  std::array<std::uint32_t, 2> neighbors;
  std::array<std::uint64_t, 3> tried_at{};  ///< by effort: the number of the last change when it could not be removed
};

class SteinerRemover {
 public:
  SteinerRemover(CellComplex& x, std::uint32_t first_steiner) : x_(x), removal_(x), first_steiner_(first_steiner) {}

  void add_chain(const std::vector<protection::ChainVertex>& chain) {
    for (std::size_t i = 1; i + 1 < chain.size(); ++i) {
      const std::uint32_t v = chain[i].vertex;
      if (v < first_steiner_ || x_.cell_at(v) == no_neighbor) continue;
      resize(v);
      candidates_[v - first_steiner_] = {v, {chain[i - 1].vertex, chain[i + 1].vertex}};
    }
  }

  std::uint64_t run(const Progress& progress) {
    std::uint64_t removed = 0;
    for (RemovalEffort effort = RemovalEffort::collapse;;) {
      const std::uint64_t before = removed;
      for (std::size_t i = candidates_.size(); i-- > 0;) {
        report(progress, "unsplit", candidates_.size() - i, candidates_.size());
        Candidate& c = candidates_[i];
        if (c.vertex == no_neighbor || x_.changed_at(c.vertex) < c.tried_at[static_cast<int>(effort)]) continue;
        if (try_to_remove(c, effort)) {
          ++removed;
        } else {
          for (int e = 0; e <= static_cast<int>(effort); ++e) c.tried_at[e] = x_.change_count() + 1;
        }
      }
      if (removed != before) {
        effort = RemovalEffort::collapse;
      } else if (effort == RemovalEffort::grow) {
        return removed;
      } else {
        effort = static_cast<RemovalEffort>(static_cast<int>(effort) + 1);
      }
    }
  }

 private:
  void resize(std::uint32_t v) {
    if (candidates_.size() <= v - first_steiner_)
      candidates_.resize(v - first_steiner_ + std::size_t{1}, Candidate{no_neighbor, {}});
  }

  bool try_to_remove(Candidate& c, RemovalEffort effort) {
    if (!removal_.plan(c.vertex, c.neighbors, effort, change_)) return false;
    x_.apply(change_, made_);
    for (int side = 0; side < 2; ++side) replace_neighbor(c.neighbors[side], c.vertex, c.neighbors[1 - side]);
    c.vertex = no_neighbor;
    return true;
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
