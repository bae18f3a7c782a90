#pragma once

#include <cstddef>

// Loops run on oneTBB. The thread sanitizer cannot see how that library synchronizes threads, because it is not built
// with the sanitizer. So programs that are built with the sanitizer use plain threads instead.

#ifndef __SANITIZE_THREAD__

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <algorithm>

namespace ccdt::thread_backend {

inline unsigned core_count() {
  return static_cast<unsigned>(tbb::info::default_concurrency());
}

/// One thread alone does without oneTBB, whose start takes as long as meshing a small part.
inline thread_local bool is_alone = false;

template <class Run>
auto run_on(unsigned threads, const Run& run) {
  struct Restore {
    bool before = is_alone;
    ~Restore() { is_alone = before; }
  } restore;
  is_alone = threads == 1;
  if (is_alone) return run();
  // Tests use more threads than there are cores.
  const tbb::global_control allowed(tbb::global_control::max_allowed_parallelism, std::max(threads, core_count()));
  tbb::task_arena arena(static_cast<int>(threads));
  return arena.execute(run);
}

inline unsigned thread_count() {
  return is_alone ? 1 : static_cast<unsigned>(std::max(1, tbb::this_task_arena::max_concurrency()));
}

/// The number of the running thread, below `thread_count()`.
inline unsigned thread_number() {
  return is_alone ? 0 : static_cast<unsigned>(std::max(0, tbb::this_task_arena::current_thread_index()));
}

inline bool is_canceled() {
  return !is_alone && tbb::is_current_task_group_canceling();
}

template <class Work>
void for_ranges(std::size_t count, std::size_t grain, const Work& work) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, grain),
                    [&](const tbb::blocked_range<std::size_t>& range) { work(range.begin(), range.end()); });
}

}  // namespace ccdt::thread_backend

#else

#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>
#include <mutex>
#include <random>
#include <thread>
#include <vector>

namespace ccdt::thread_backend {

inline thread_local unsigned count = 1, number = 0;
inline thread_local std::atomic<bool>* canceled = nullptr;

inline unsigned core_count() {
  return std::max(1u, std::thread::hardware_concurrency());
}

template <class Run>
auto run_on(unsigned threads, const Run& run) {
  struct Restore {
    unsigned before = count;
    ~Restore() { count = before; }
  } restore;
  count = threads;
  return run();
}

inline unsigned thread_count() {
  return count;
}

inline unsigned thread_number() {
  return number;
}

inline bool is_canceled() {
  return canceled != nullptr && *canceled;
}

/// Pauses before some of the ranges, so that the threads meet in another order each time.
inline void pause_at_random() {
  thread_local std::minstd_rand random(std::random_device{}());
  if (random() % 8 == 0) std::this_thread::sleep_for(std::chrono::microseconds(random() % 64));
}

template <class Work>
void for_ranges(std::size_t size, std::size_t grain, const Work& work) {
  std::atomic<std::size_t> next = grain;  // the first range is the caller's, as with oneTBB
  std::atomic<bool> stop = false;
  std::exception_ptr failure;
  std::mutex mutex;
  const bool are_several = count > 1;
  const auto take_ranges = [&](unsigned thread) {
    number = thread;
    canceled = &stop;
    try {
      for (std::size_t begin = thread == 0 ? 0 : next.fetch_add(grain); begin < size && !stop;
           begin = next.fetch_add(grain)) {
        if (are_several) pause_at_random();
        work(begin, std::min(begin + grain, size));
      }
    } catch (...) {
      const std::lock_guard lock(mutex);
      if (!failure) failure = std::current_exception();
      stop = true;
    }
    canceled = nullptr;
  };
  {
    std::vector<std::jthread> others;
    for (unsigned thread = 1; thread < count; ++thread) others.emplace_back(take_ranges, thread);
    take_ranges(0);
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace ccdt::thread_backend

#endif
