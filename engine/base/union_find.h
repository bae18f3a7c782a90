#pragma once

#include <atomic>
#include <cstdint>
#include <utility>

#include "engine/base/parallel.h"
#include "engine/base/platform.h"
#include "engine/base/raw_vector.h"

namespace ccdt {

/// Disjoint sets of 0, 1, ..., n-1 that several threads may join and find at the same time. The representative of a set
/// is its smallest member, whatever the order of the joins.
///
/// Once a member has a smaller parent, each later parent is also a member of the set, on the way down to the
/// representative. So old parents that a thread reads or writes back do no harm, and only the join of a representative
/// must be atomic (Jayanti and Tarjan 2016).
class UnionFind {
 public:
  explicit UnionFind(std::size_t n) : parent_(n) {
    parallel_for(n, 4096, [&](std::size_t i) { parent_[i] = static_cast<std::uint32_t>(i); });
  }

  std::uint32_t find(std::uint32_t i) {
    for (std::uint32_t parent = load(i); parent != i; parent = load(i)) {
      const std::uint32_t above = load(parent);
      if (above != parent) as_atomic(parent_[i]).store(above, std::memory_order_relaxed);
      i = above;
    }
    return i;
  }

  /// \return  the representative of both, unless another thread joins them with a third set
  std::uint32_t join(std::uint32_t i, std::uint32_t j) {
    for (;;) {
      i = find(i);
      j = find(j);
      if (i < j) std::swap(i, j);
      if (is_alone_) {  // no branch depends on the sets: it would be mispredicted
        as_atomic(parent_[i]).store(j, std::memory_order_relaxed);
        return j;
      }
      if (i == j) return i;
      std::uint32_t expected = i;  // no thread has joined it with another in the meantime
      if (as_atomic(parent_[i]).compare_exchange_strong(expected, j, std::memory_order_relaxed)) return j;
    }
  }

 private:
  std::uint32_t load(std::uint32_t i) { return as_atomic(parent_[i]).load(std::memory_order_relaxed); }

  RawVector<std::uint32_t> parent_;
  const bool is_alone_ = thread_count() == 1;  ///< a single thread does not pay for atomic joins
};

}  // namespace ccdt
