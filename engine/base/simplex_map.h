#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "engine/base/index.h"
#include "engine/base/parallel.h"
#include "engine/base/sort_in_buckets.h"

namespace ccdt {

/// An undirected edge as one number: the smaller end in the upper half. Keys sort as pairs of ends do.
constexpr std::uint64_t edge_key(std::uint32_t a, std::uint32_t b) {
  return a < b ? std::uint64_t{a} << 32 | b : std::uint64_t{b} << 32 | a;
}

/// The corners of a triangle in increasing order: the same from both sides.
using FaceKey = std::array<std::uint32_t, 3>;

constexpr FaceKey face_key(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  const std::uint32_t low = std::min(a, b), high = std::max(a, b);
  return {std::min(low, c), std::max(low, std::min(high, c)), std::max(high, c)};
}

/// Is the order of three distinct corners an odd permutation of the increasing order? Triangles with the same corners
/// face the same way if both are odd or both are even.
constexpr bool is_odd(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  return ((a > b) ^ (b > c) ^ (a > c)) != 0;
}

/// A fixed set of edges (N = 2) or triangles (N = 3), each found at its least vertex, in any order of its corners.
template <std::size_t N>
class SimplexMap {
 public:
  using Corners = std::array<std::uint32_t, N>;

  SimplexMap() = default;
  /// \param simplices  corners of any integer or index type; edges are distinct
  /// \param vertices   more than each corner
  template <class Id>
  SimplexMap(const std::vector<std::array<Id, N>>& simplices, std::size_t vertices)
      : first_(vertices + 2, 0), entries_(simplices.size()) {
    constexpr std::size_t grain = 4096;
    const AddOne add_one;
    parallel_for(simplices.size(), grain, [&](std::size_t i) { add_one(first_[2 + sorted(simplices[i])[0]]); });
    // Each list's beginning, stored one place too far. Filling moves it to the list's end, the next one's beginning.
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    parallel_for(simplices.size(), grain, [&](std::size_t i) {
      const Corners corners = sorted(simplices[i]);
      Entry& entry = entries_[add_one(first_[1 + corners[0]])];
      std::copy(corners.begin() + 1, corners.end(), entry.others.begin());
      entry.number = static_cast<std::uint32_t>(i);
      if constexpr (N == 3) entry.number = 2 * entry.number + is_odd(simplices[i][0], simplices[i][1], simplices[i][2]);
    });
  }

  bool empty() const { return entries_.empty(); }

  /// The index of the edge in the given list; `none` if it is not there.
  std::uint32_t find(std::uint32_t a, std::uint32_t b) const requires(N == 2) {
    if (b < a) std::swap(a, b);
    for (std::uint32_t i = first_[a]; i < first_[a + 1]; ++i)
      if (entries_[i].others[0] == b) return entries_[i].number;
    return none;
  }

  /// A triangle in the given list.
  struct Found {
    std::uint32_t index;       ///< the least one of triangles with these corners; `none` if it is not there
    bool faces_the_other_way;  ///< than the corners in the given order
  };
  Found find(std::uint32_t a, std::uint32_t b, std::uint32_t c) const requires(N == 3) {
    const FaceKey key = face_key(a, b, c);
    std::uint32_t found = none;
    // It is unpredictable which entry matches, so there is no branch for each.
    for (std::uint32_t i = first_[key[0]]; i < first_[key[0] + 1]; ++i) {
      const unsigned is_same = unsigned{entries_[i].others[0] == key[1]} & unsigned{entries_[i].others[1] == key[2]};
      found = std::min(found, entries_[i].number | (is_same - 1));
    }
    return {found == none ? none : found / 2, ((found & 1) != 0) != is_odd(a, b, c)};
  }

 private:
  template <class Id>
  static Corners sorted(const std::array<Id, N>& c) {
    if constexpr (N == 2)
      return {std::min(c[0], c[1]), std::max(c[0], c[1])};
    else
      return face_key(c[0], c[1], c[2]);
  }

  struct Entry {
    std::array<std::uint32_t, N - 1> others;  // greater than the least corner, increasing
    std::uint32_t number;  // of an edge: its index; of a triangle: twice its index, and one more if it `is_odd`
  };
  std::vector<std::uint32_t> first_;  // entries of least vertex v: first_[v] .. first_[v + 1]
  std::vector<Entry> entries_;
};

using EdgeMap = SimplexMap<2>;
using FaceMap = SimplexMap<3>;

/// A value that belongs to an edge, such as a face or a half-edge at it.
struct AtEdge {
  std::uint64_t edge;  ///< `edge_key`
  std::uint32_t value;

  auto operator<=>(const AtEdge&) const = default;
};

/// Sorts the values by edge, and within each edge.
///
/// \param values  a vector of `AtEdge`
template <class Values>
void sort_by_edge(Values& values) {
  sort_in_buckets(values, [](const AtEdge& value) { return static_cast<std::uint32_t>(value.edge >> 32); });
}

/// Sorts the values by edge, then calls visit(group) for the values of each edge, in increasing order of the edges and
/// of the values of an edge. Visit takes a `std::span<const AtEdge>`.
template <class Visit>
void for_each_edge_group(std::vector<AtEdge>& values, const Visit& visit) {
  sort_by_edge(values);
  for (std::size_t i = 0, next; i < values.size(); i = next) {
    for (next = i + 1; next < values.size() && values[next].edge == values[i].edge;) ++next;
    visit(std::span<const AtEdge>(values).subspan(i, next - i));
  }
}

}  // namespace ccdt
