#pragma once

#include <atomic>
#include <cstdint>
#include <string_view>
#include <thread>

#include "engine/base/progress.h"
#include "engine/base/thread_backend.h"

namespace ccdt {

/// Progress of a stage that several threads work on. Only the thread that made it reports.
class SharedProgress {
 public:
  SharedProgress(const Progress& progress, std::string_view stage, std::uint64_t done, std::uint64_t total)
      : progress_(progress), stage_(stage), done_(done), total_(total) {}

  /// \return  false if the work was canceled, on this thread or another: the caller should end soon
  bool add(std::uint64_t done) {
    const std::uint64_t all = done_.fetch_add(done, std::memory_order_relaxed) + done;
    if (std::this_thread::get_id() == reporter_) report(progress_, stage_, all, total_);
    return !thread_backend::is_canceled();
  }

 private:
  const Progress& progress_;
  const std::string_view stage_;
  std::atomic<std::uint64_t> done_;
  const std::uint64_t total_;
  const std::thread::id reporter_ = std::this_thread::get_id();
};

}  // namespace ccdt
