#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "engine/base/count_work.h"
#include "engine/base/platform.h"
#include "engine/base/thread_backend.h"

namespace ccdt {

/// Calls `run()` with this many threads for its loops.
///
/// \param threads  0: one for each core that the process may use
/// \return  what `run` returns
template <class Run>
auto with_threads(unsigned threads, const Run& run) {
  using Result = decltype(run());
  if (threads == 0) threads = thread_backend::core_count();
  if constexpr (std::is_void_v<Result>) {
    thread_backend::run_on(threads, std::cref(run));
  } else {
    std::optional<Result> result;
    thread_backend::run_on(threads, [&] { result.emplace(run()); });
    return *std::move(result);
  }
}

/// How many threads the loops of the calling thread use.
inline unsigned thread_count() {
  return thread_backend::thread_count();
}

/// The largest number of threads that have worked on one loop of this thread since its innermost `ThreadScope` began.
inline constinit thread_local unsigned threads_at_work = 1;

/// When the scope ends, raises a number to the largest number of threads that worked on one loop in it.
class ThreadScope {
 public:
  explicit ThreadScope(unsigned& threads) : threads_(threads) { threads_at_work = 1; }
  ~ThreadScope() { threads_ = std::max(threads_, threads_at_work); }
  ThreadScope(const ThreadScope&) = delete;
  ThreadScope& operator=(const ThreadScope&) = delete;

 private:
  unsigned& threads_;
};

/// Calls `work(begin, end)` for ranges that cover 0 .. count, on several threads, in any order. What the calls count
/// (base/count_work.h) is added to the caller's work.
///
/// \param grain  ranges up to this length are not divided
/// \throw ...    what `work` throws; then some of the other ranges may be skipped
template <class Work>
void parallel_ranges(std::size_t count, std::size_t grain, const Work& work) {
  if (count == 0) return;
  if (thread_count() == 1 || count <= grain) {
    work(std::size_t{0}, count);
    return;
  }
  struct alignas(64) Share {
    ccdt::Work work;
    bool has_worked = false;
  };
  std::vector<Share> shares(thread_count());
  thread_backend::for_ranges(count, grain, [&](std::size_t begin, std::size_t end) {
    Share& share = shares[thread_backend::thread_number()];
    share.has_worked = true;
    const WorkScope scope(share.work, true);
    work(begin, end);
  });
  for (const Share& share : shares) work_done += share.work;
  threads_at_work =
      std::max(threads_at_work, static_cast<unsigned>(std::ranges::count(shares, true, &Share::has_worked)));
}

/// Calls `work(i)` for each i below `count`, as `parallel_ranges` does.
template <class Work>
void parallel_for(std::size_t count, std::size_t grain, const Work& work) {
  parallel_ranges(count, grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) work(i);
  });
}

/// Sets all items to this value, on several threads.
template <class Item>
void parallel_fill(std::span<Item> items, const Item& value) {
  parallel_ranges(items.size(), 1 << 16, [&](std::size_t begin, std::size_t end) {
    std::ranges::fill(items.subspan(begin, end - begin), value);
  });
}

/// Calls two functions, on two threads if there are several; the first one on the thread of the caller.
///
/// \throw ...  what the first one throws, or else the second
template <class First, class Second>
void parallel_both(const First& first, const Second& second) {
  std::array<std::exception_ptr, 2> failures;
  parallel_for(2, 1, [&](std::size_t i) {
    try {
      i == 0 ? first() : second();
    } catch (...) {
      failures[i] = std::current_exception();
    }
  });
  for (const std::exception_ptr& failure : failures)
    if (failure) std::rethrow_exception(failure);
}

/// Calls `work(begin, end)` for ranges of this length that cover 0 .. count, as `parallel_ranges` does. The ranges do
/// not depend on the number of threads.
///
/// \return  what the calls return, in the order of the ranges
template <class Work>
auto parallel_chunks(std::size_t count, std::size_t length, const Work& work) {
  std::vector<decltype(work(count, count))> results((count + length - 1) / length);
  parallel_for(results.size(), 1,
               [&](std::size_t i) { results[i] = work(i * length, std::min(count, (i + 1) * length)); });
  return results;
}

/// Calls `work(begin, end, found)` for ranges that cover 0 .. count, as `parallel_ranges` does, to add to a list.
///
/// \param length  of the ranges if there are several threads
/// \return  what the calls found, in the order of the ranges
template <class Item, class Work>
std::vector<Item> parallel_collect(std::size_t count, std::size_t length, const Work& work) {
  std::vector<Item> all;
  if (thread_count() == 1 || count <= length) {
    work(std::size_t{0}, count, all);
    return all;
  }
  const auto parts = parallel_chunks(count, length, [&](std::size_t begin, std::size_t end) {
    std::vector<Item> found;
    work(begin, end, found);
    return found;
  });
  std::size_t size = 0;
  for (const std::vector<Item>& part : parts) size += part.size();
  all.reserve(size);
  for (const std::vector<Item>& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

/// The indices below `count` for which `holds(i)` is true, in increasing order.
///
/// \param length  of the ranges of `parallel_collect`
template <class Holds>
std::vector<std::uint32_t> parallel_select(std::size_t count, std::size_t length, const Holds& holds) {
  return parallel_collect<std::uint32_t>(count, length,
                                         [&](std::size_t i, std::size_t end, std::vector<std::uint32_t>& found) {
                                           for (; i < end; ++i)
                                             if (holds(i)) found.push_back(static_cast<std::uint32_t>(i));
                                         });
}

/// Adds one to numbers that all threads of the following loops add to. Make it before these loops, not in them. A
/// single thread does not pay for atomic operations.
class AddOne {
 public:
  /// \return  the number before
  std::uint32_t operator()(std::uint32_t& number) const {
    return is_alone_ ? number++ : as_atomic(number).fetch_add(1, std::memory_order_relaxed);
  }

 private:
  const bool is_alone_ = thread_count() == 1;
};

/// Sets bits in bytes that all threads of the following loops set bits in. Make it before these loops, not in them. A
/// single thread does not pay for atomic operations, nor do bits that are set already.
class SetBits {
 public:
  /// \return  the byte before
  std::uint8_t operator()(std::uint8_t& byte, std::uint8_t bits) const {
    if (is_alone_) return std::exchange(byte, static_cast<std::uint8_t>(byte | bits));
    const auto shared = as_atomic(byte);
    const std::uint8_t before = shared.load(std::memory_order_relaxed);
    return (before & bits) == bits ? before : shared.fetch_or(bits, std::memory_order_relaxed);
  }

 private:
  const bool is_alone_ = thread_count() == 1;
};

/// Fills a list, on several threads. Each chunk of 0 .. count adds some items, in the order of the chunks.
///
/// \param count_in   `count_in(begin, end)`: how many items these indices add
/// \param make_room  `make_room(size)`: called once with the number of all items
/// \param fill       `fill(begin, end, place)`: writes the items of these indices, the first one at this place
template <class CountIn, class MakeRoom, class Fill>
void parallel_pack(std::size_t count, std::size_t length, const CountIn& count_in, const MakeRoom& make_room,
                   const Fill& fill) {
  std::vector<std::size_t> places = parallel_chunks(
      count, length, [&](std::size_t begin, std::size_t end) { return std::size_t{count_in(begin, end)}; });
  std::size_t size = 0;
  for (std::size_t& place : places) size += std::exchange(place, size);
  make_room(size);
  parallel_for(places.size(), 1,
               [&](std::size_t i) { fill(i * length, std::min(count, (i + 1) * length), places[i]); });
}

}  // namespace ccdt
