#pragma once

#include <stdexcept>

namespace ccdt::baselines {

/// The user has stopped the program. Only finished work can be reported.
class Stopped : public std::runtime_error {
 public:
  Stopped() : std::runtime_error("stopped") {}
};

/// Asks this process to stop: programs that run with limits end at once, and `run_program` throws `Stopped`. May be
/// called from a signal handler.
void request_stop();

/// Has this process been asked to stop?
bool stop_requested();

}  // namespace ccdt::baselines
