#include "bench/verify/chains.h"

#include <algorithm>
#include <cmath>
#include <unordered_set>

namespace ccdt::verification {

namespace {

/// Walks from one end of an edge to the other over mesh edges that lie along it.
class EdgeWalk {
 public:
  EdgeWalk(const TetMesh& mesh, const Topology& topology, const Surface& surface, std::array<std::uint32_t, 2> ends)
      : mesh_(mesh),
        topology_(topology),
        ends_(ends),
        origin_(surface.at(ends[0])),
        axis_(surface.at(ends[1]) - surface.at(ends[0])),
        tolerance_(surface.tolerances.place) {
    const double length = std::sqrt(squared_length(axis_));
    axis_ = (1 / length) * axis_;
    length_ = length;
  }

  /// Depth first, nearest vertices first; on nearly every edge there is one way only.
  bool run(std::vector<std::uint32_t>& chain) {
    struct Step {
      std::vector<std::pair<double, std::uint32_t>> ahead;  // nearest last
    };
    std::vector<Step> steps;
    chain.assign(1, ends_[0]);
    seen_.insert(ends_[0]);
    steps.push_back({ahead_of(ends_[0], 0)});
    while (!steps.empty()) {
      if (steps.back().ahead.empty()) {
        steps.pop_back();
        chain.pop_back();
        continue;
      }
      const auto [along, v] = steps.back().ahead.back();
      steps.back().ahead.pop_back();
      if (!seen_.insert(v).second) continue;
      chain.push_back(v);
      if (v == ends_[1]) return true;
      steps.push_back({ahead_of(v, along)});
    }
    return false;
  }

 private:
  std::vector<std::pair<double, std::uint32_t>> ahead_of(std::uint32_t vertex, double from) const {
    std::vector<std::pair<double, std::uint32_t>> ahead;
    for (std::uint32_t i = topology_.star_begin[vertex]; i < topology_.star_begin[vertex + 1]; ++i)
      for (const std::uint32_t v : mesh_.tetrahedra[topology_.star[i]]) {
        if (seen_.count(v) > 0) continue;
        const Point3 p = mesh_.vertices[v] - origin_;
        const double along = v == ends_[1] ? length_ : dot(p, axis_);
        if (along <= from || along > length_) continue;
        if (v != ends_[1] && squared_length(p - along * axis_) > tolerance_ * tolerance_) continue;
        ahead.emplace_back(along, v);
      }
    std::sort(ahead.rbegin(), ahead.rend());
    ahead.erase(std::unique(ahead.begin(), ahead.end()), ahead.end());
    return ahead;
  }

  const TetMesh& mesh_;
  const Topology& topology_;
  std::array<std::uint32_t, 2> ends_;
  Point3 origin_, axis_;
  double length_ = 0, tolerance_;
  std::unordered_set<std::uint32_t> seen_;
};

}  // namespace

Chains find_chains(const TetMesh& mesh, const Topology& topology, const Surface& surface,
                   std::span<const std::array<std::uint32_t, 2>> edges) {
  Chains chains;
  chains.begin.reserve(edges.size() + 1);
  std::vector<std::uint32_t> chain;
  for (const auto& [a, b] : edges) {
    if (surface.sites.in_mesh(a) && surface.sites.in_mesh(b)) {
      if (has_edge(mesh, topology, a, b)) {
        chains.vertices.insert(chains.vertices.end(), {a, b});
      } else if (EdgeWalk(mesh, topology, surface, {a, b}).run(chain)) {
        chains.vertices.insert(chains.vertices.end(), chain.begin(), chain.end());
      }
    }
    chains.begin.push_back(static_cast<std::uint32_t>(chains.vertices.size()));
  }
  return chains;
}

}  // namespace ccdt::verification
