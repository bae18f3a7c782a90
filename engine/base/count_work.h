#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>

#include "engine/base/work.h"

namespace ccdt {

/// The work of this thread since its innermost `WorkScope` began. Counting code adds to it; inner loops count in a
/// local variable and add it once.
inline constinit thread_local Work work_done;

/// Adds the work of this thread during the life of the scope to a total, and to that of the enclosing scope.
class WorkScope {
 public:
  /// \param elsewhere  the enclosing scope gets nothing, because the work belongs to a stage of another thread
  explicit WorkScope(Work& work, bool elsewhere = false)
      : work_(work), before_(std::exchange(work_done, {})), elsewhere_(elsewhere) {}
  ~WorkScope() {
    work_ += work_done;
    if (!elsewhere_) before_ += work_done;
    work_done = before_;
  }
  WorkScope(const WorkScope&) = delete;
  WorkScope& operator=(const WorkScope&) = delete;

 private:
  Work& work_;
  Work before_;
  bool elsewhere_;
};

/// The bytes of the elements of lists, without reserved memory.
template <class... List>
std::size_t bytes_of(const List&... lists) {
  return ((lists.size() * sizeof(typename List::value_type)) + ... + std::size_t{0});
}

/// Notes that this many bytes are in use.
inline void note_bytes(std::size_t bytes) {
  if (bytes > work_done.peak_bytes) work_done.peak_bytes = bytes;
}

}  // namespace ccdt
