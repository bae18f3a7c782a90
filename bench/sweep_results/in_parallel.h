#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <thread>
#include <vector>

namespace ccdt::sweep_results {

/// Calls `work(i)` for each i below `count`, on all cores, in any order. \pre it does not throw
template <class Work>
void in_parallel(std::size_t count, const Work& work) {
  std::atomic<std::size_t> next = 0;
  const auto take_all = [&] {
    for (std::size_t i = next++; i < count; i = next++) work(i);
  };
  std::vector<std::jthread> others;
  for (unsigned core = 1; core < std::thread::hardware_concurrency(); ++core) others.emplace_back(take_all);
  take_all();
}

}  // namespace ccdt::sweep_results
