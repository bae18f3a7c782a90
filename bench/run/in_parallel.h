#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace ccdt::bench {

/// Calls `work(i)` for each i below `count`, in any order.
///
/// \param most_threads  largest number of threads
/// \throw ...           the first exception of `work`; then some of the other calls may be skipped
template <class Work>
void in_parallel(std::size_t count, const Work& work, std::size_t most_threads = std::thread::hardware_concurrency()) {
  std::atomic<std::size_t> next = 0;
  std::exception_ptr failure;
  std::mutex mutex;
  const auto take_all = [&] {
    try {
      for (std::size_t i = next++; i < count; i = next++) work(i);
    } catch (...) {
      const std::lock_guard lock(mutex);
      if (!failure) failure = std::current_exception();
      next = count;
    }
  };
  {
    std::vector<std::jthread> others;
    try {
      for (std::size_t thread = 1; thread < std::min(count, most_threads); ++thread) others.emplace_back(take_all);
    } catch (const std::system_error&) {  // no more threads can be started; those that there are do all
    }
    take_all();
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace ccdt::bench
