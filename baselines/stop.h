#pragma once

#include <stdexcept>

namespace ccdt::baselines {

/// The user has stopped the program: there is nothing to report but what is finished.
class Stopped : public std::runtime_error {
 public:
  Stopped() : std::runtime_error("stopped") {}
};

/// Asks this process to stop: programs that run with limits end at once, and `run_program` throws `Stopped`. May be
/// called from a signal handler.
void request_stop();

/// Has somebody asked?
bool stop_requested();

}  // namespace ccdt::baselines
