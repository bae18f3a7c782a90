#include "bench/verify/distinct_vertices.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <ranges>

#include "bench/verify/findings.h"
#include "bench/verify/point_hash.h"
#include "engine/base/platform.h"
#include "engine/base/sort_in_runs.h"

namespace ccdt::verify {

namespace {

/// Enters all vertices into a hash table, on several threads.
bool are_distinct(const Topology& topology) {
  const auto& vertices = topology.mesh.vertices;
  const std::size_t mask = std::bit_ceil(2 * vertices.size() + 1) - 1;
  std::vector<std::uint32_t> table(mask + 1, none);
  std::atomic<bool> distinct = true;
  const auto enter = [&](std::uint32_t v) {
    for (std::size_t i = PointHash::hash(vertices[v]) & mask;; i = (i + 1) & mask) {
      std::uint32_t there = none;
      if (as_atomic(table[i]).compare_exchange_strong(there, v, std::memory_order_relaxed)) return;
      if (vertices[there] == vertices[v]) return distinct.store(false, std::memory_order_relaxed);
    }
  };
  parallel_for(vertices.size(), chunk_length, [&](std::size_t v) {
    if (topology.used(static_cast<std::uint32_t>(v))) enter(static_cast<std::uint32_t>(v));
  });
  return distinct;
}

}  // namespace

Check check_distinct_vertices(const Topology& topology) {
  Check check{.name = "distinct vertices"};
  if (are_distinct(topology)) {
    const auto is_used = [&](std::uint32_t v) { return topology.used(v); };
    const auto all = static_cast<std::uint32_t>(topology.mesh.vertices.size());
    check.checked = static_cast<std::uint64_t>(std::ranges::count_if(std::views::iota(0u, all), is_used));
    return check;
  }
  struct Vertex {
    std::array<double, 3> at;
    std::uint32_t number;

    auto operator<=>(const Vertex&) const = default;
  };
  std::vector<Vertex> sorted;
  for (std::uint32_t v = 0; v < topology.mesh.vertices.size(); ++v)
    if (topology.used(v)) sorted.push_back({as_array(topology.mesh.vertices[v]), v});
  check.checked = sorted.size();
  sort_in_runs(sorted, [](const Vertex& a, const Vertex& b) { return a < b; });
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    if (sorted[i - 1].at != sorted[i].at) continue;
    fail(check, [&] {
      return "vertices " + std::to_string(sorted[i - 1].number) + " and " + std::to_string(sorted[i].number) +
             " are both at " + text(topology.mesh.vertices[sorted[i].number]);
    });
  }
  return check;
}

}  // namespace ccdt::verify
