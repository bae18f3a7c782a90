#pragma once

#include <cstdint>
#include <numeric>
#include <vector>

namespace ccdt {

/// Disjoint sets of 0, 1, ..., n-1. The representative of a set is its smallest member, whatever the order of the
/// joins.
class UnionFind {
 public:
  explicit UnionFind(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0u); }

  std::uint32_t find(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }

  std::size_t bytes() const { return parent_.size() * sizeof(parent_[0]); }

  /// \return  the representative of both
  std::uint32_t join(std::uint32_t i, std::uint32_t j) {
    i = find(i);
    j = find(j);
    return i < j ? parent_[j] = i : parent_[i] = j;
  }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace ccdt
