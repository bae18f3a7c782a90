#include "engine/base/thread_backend.h"

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
#include <atomic>
#include <exception>
#include <new>
#include <string>

#include "engine/base/errors.h"

namespace ccdt::thread_backend {
namespace {

/// A single thread does without oneTBB, which takes 1 ms to start.
thread_local bool is_alone = false;

/// Calls `use(guarded)`, which calls our own functions through `guarded`. Any other failure is that of oneTBB itself:
/// it starts threads when it needs them, and the system may allow no more of them, or lack memory (`std::bad_alloc`).
///
/// \throw LimitError  oneTBB failed
/// \throw ...         what our functions throw
template <class Use>
void with_errors_of_library(const Use& use) {
  std::atomic<bool> is_ours = false;
  const auto guarded = [&](const auto& run) {
    try {
      run();
    } catch (...) {
      is_ours = true;
      throw;
    }
  };
  try {
    use(guarded);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    if (is_ours) throw;
    throw LimitError(std::string("no more threads can be started: ") + error.what(), {},
                     "use fewer threads, or allow more memory and processes");
  }
}

}  // namespace

unsigned core_count() {
  return static_cast<unsigned>(tbb::info::default_concurrency());
}

void run_on(unsigned threads, const std::function<void()>& run) {
  struct Restore {
    bool before = is_alone;
    ~Restore() { is_alone = before; }
  } restore;
  is_alone = threads == 1;
  if (is_alone) return run();
  // Tests use more threads than there are cores.
  with_errors_of_library([&](const auto& guarded) {
    const tbb::global_control allowed(tbb::global_control::max_allowed_parallelism, std::max(threads, core_count()));
    tbb::task_arena arena(static_cast<int>(threads));
    arena.execute([&] { guarded(run); });
  });
}

unsigned thread_count() {
  return is_alone ? 1 : static_cast<unsigned>(std::max(1, tbb::this_task_arena::max_concurrency()));
}

unsigned thread_number() {
  return is_alone ? 0 : static_cast<unsigned>(std::max(0, tbb::this_task_arena::current_thread_index()));
}

bool is_canceled() {
  return !is_alone && tbb::is_current_task_group_canceling();
}

void for_ranges(std::size_t count, std::size_t grain, const std::function<void(std::size_t, std::size_t)>& work) {
  with_errors_of_library([&](const auto& guarded) {
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, count, grain),
        [&](const tbb::blocked_range<std::size_t>& range) { guarded([&] { work(range.begin(), range.end()); }); });
  });
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
namespace {

thread_local unsigned threads_in_use = 1, number = 0;
thread_local std::atomic<bool>* canceled = nullptr;

/// Pauses before some of the ranges, so that the threads meet in another order each time.
void pause_at_random() {
  thread_local std::minstd_rand random(std::random_device{}());
  if (random() % 8 == 0) std::this_thread::sleep_for(std::chrono::microseconds(random() % 64));
}

}  // namespace

unsigned core_count() {
  return std::max(1u, std::thread::hardware_concurrency());
}

void run_on(unsigned threads, const std::function<void()>& run) {
  struct Restore {
    unsigned before = threads_in_use;
    ~Restore() { threads_in_use = before; }
  } restore;
  threads_in_use = threads;
  run();
}

unsigned thread_count() {
  return threads_in_use;
}

unsigned thread_number() {
  return number;
}

bool is_canceled() {
  return canceled != nullptr && *canceled;
}

void for_ranges(std::size_t count, std::size_t grain, const std::function<void(std::size_t, std::size_t)>& work) {
  std::atomic<std::size_t> next = grain;  // the first range is the caller's, as with oneTBB
  std::atomic<bool> stop = false;
  std::exception_ptr failure;
  std::mutex mutex;
  const bool are_several = threads_in_use > 1;
  const auto take_ranges = [&](unsigned thread) {
    number = thread;
    canceled = &stop;
    try {
      for (std::size_t begin = thread == 0 ? 0 : next.fetch_add(grain); begin < count && !stop;
           begin = next.fetch_add(grain)) {
        if (are_several) pause_at_random();
        work(begin, std::min(begin + grain, count));
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
    for (unsigned thread = 1; thread < threads_in_use; ++thread) others.emplace_back(take_ranges, thread);
    take_ranges(0);
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace ccdt::thread_backend

#endif
