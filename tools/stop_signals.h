#pragma once

namespace ccdt::tools {

/// As long as the object lives, SIGINT, SIGTERM and SIGHUP do not end this process but ask it to stop: see
/// `baselines::request_stop`.
class StopSignals {
 public:
  StopSignals();
  ~StopSignals();
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;
};

/// The exit code of a process that a signal asked to stop: 128 plus the number of the signal, as shells expect.
int stopped_exit_code();

}  // namespace ccdt::tools
