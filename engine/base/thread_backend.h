#pragma once

#include <cstddef>
#include <functional>

/// What loops on several threads run on. Templates are in base/parallel.h, so that only one source file includes a
/// threading library: its headers take longer to compile than most of our files.
namespace ccdt::thread_backend {

unsigned core_count();

/// Calls `run()` with this many threads for its loops.
///
/// \throw LimitError  a thread cannot be started; loops throw it, too
/// \throw ...         what `run` throws
void run_on(unsigned threads, const std::function<void()>& run);

unsigned thread_count();

/// The number of the running thread, below `thread_count()`.
unsigned thread_number();

/// Did the loop that the calling thread works on fail on any thread?
bool is_canceled();

/// Calls `work(begin, end)` for ranges that cover 0 .. count, on several threads, in any order.
///
/// \param grain  ranges up to this length are not divided
/// \throw ...    what `work` throws; then some of the other ranges may be skipped
void for_ranges(std::size_t count, std::size_t grain,
                const std::function<void(std::size_t begin, std::size_t end)>& work);

}  // namespace ccdt::thread_backend
