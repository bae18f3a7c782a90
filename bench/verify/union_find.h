#pragma once

#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace ccdt::verification {

/// Disjoint sets of 0..n-1 with path halving. Each member also knows whether it is flipped against its root, for
/// surfaces whose pieces are oriented one by one.
class UnionFind {
 public:
  explicit UnionFind(std::size_t n) : parent_(n), flipped_(n, false) { std::iota(parent_.begin(), parent_.end(), 0u); }

  /// The root of `i`, and whether `i` is flipped against it.
  std::pair<std::uint32_t, bool> find(std::uint32_t i) {
    bool flip = false;
    while (parent_[i] != i) {
      const std::uint32_t p = parent_[i];
      if (parent_[p] != p) {
        flipped_[i] = flipped_[i] != flipped_[p];
        parent_[i] = parent_[p];
      }
      flip = flip != flipped_[i];
      i = parent_[i];
    }
    return {i, flip};
  }
  std::uint32_t root(std::uint32_t i) { return find(i).first; }

  /// Joins the sets of `a` and `b`, of which one is flipped against the other if `flip`.
  void join(std::uint32_t a, std::uint32_t b, bool flip = false) {
    const auto [ra, fa] = find(a);
    const auto [rb, fb] = find(b);
    if (ra == rb) return;
    parent_[ra] = rb;
    flipped_[ra] = (fa != fb) != flip;
  }

 private:
  std::vector<std::uint32_t> parent_;
  std::vector<bool> flipped_;
};

}  // namespace ccdt::verification
