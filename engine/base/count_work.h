#pragma once

#include <cstddef>

#include "engine/base/work.h"

namespace ccdt {

/// What the running thread has done since its innermost `WorkScope` began. Code that counts adds to it; in inner loops
/// it counts in a local variable, and adds that once.
inline constinit thread_local Work work_done;

/// Adds what this thread does in the scope's life to some work, and to that of the scope around it.
class WorkScope {
 public:
  explicit WorkScope(Work& work) : work_(work), before_(work_done) { work_done = {}; }
  ~WorkScope() {
    work_ += work_done;
    before_ += work_done;
    work_done = before_;
  }
  WorkScope(const WorkScope&) = delete;
  WorkScope& operator=(const WorkScope&) = delete;

 private:
  Work& work_;
  Work before_;
};

/// The bytes of the elements of lists, not of what they have reserved.
template <class... List>
std::size_t bytes_of(const List&... lists) {
  return ((lists.size() * sizeof(typename List::value_type)) + ... + std::size_t{0});
}

/// Notes that so many bytes are in use.
inline void note_bytes(std::size_t bytes) {
  work_done.peak_bytes = std::max<std::uint64_t>(work_done.peak_bytes, bytes);
}

}  // namespace ccdt
