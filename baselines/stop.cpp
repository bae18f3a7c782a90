#include "baselines/stop.h"

#include <atomic>

namespace ccdt::baselines {
namespace {

std::atomic<bool> is_requested = false;
static_assert(std::atomic<bool>::is_always_lock_free);  // otherwise a signal handler must not use it

}  // namespace

void request_stop() {
  is_requested = true;
}

bool stop_requested() {
  return is_requested;
}

}  // namespace ccdt::baselines
