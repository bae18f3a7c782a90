#pragma once

#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "engine/base/edge_key.h"

namespace ccdt {

/// Undirected edges, each found at its smaller end: those of vertex v are entries first[v] to first[v + 1].
class EdgeMap {
 public:
  static constexpr std::uint32_t none = 0xFFFFFFFFu;

  EdgeMap() = default;
  /// \param keys  `edge_key` of different edges, of vertices below `vertices`
  EdgeMap(const std::vector<std::uint64_t>& keys, std::size_t vertices) : first_(vertices + 1, 0), ends_(keys.size()) {
    for (const std::uint64_t key : keys) ++first_[key >> 32];
    // From counts to ends; filling from behind turns the ends into beginnings.
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    for (std::uint32_t i = 0; i < keys.size(); ++i)
      ends_[--first_[keys[i] >> 32]] = {static_cast<std::uint32_t>(keys[i]), i};
  }

  bool empty() const { return ends_.empty(); }
  /// The index of the edge among the keys; `none` if it was not there.
  std::uint32_t find(std::uint32_t a, std::uint32_t b) const {
    if (b < a) std::swap(a, b);
    for (std::uint32_t i = first_[a]; i < first_[a + 1]; ++i)
      if (ends_[i].greater == b) return ends_[i].index;
    return none;
  }

 private:
  struct End {
    std::uint32_t greater, index;
  };
  std::vector<std::uint32_t> first_;
  std::vector<End> ends_;
};

}  // namespace ccdt
