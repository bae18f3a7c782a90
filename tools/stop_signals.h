#pragma once

namespace ccdt::tools {

/// While one of these lives, SIGINT, SIGTERM and SIGHUP do not end this process but ask it to stop: see
/// `baselines::request_stop`.
class StopSignals {
 public:
  StopSignals();
  ~StopSignals();
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;
};

/// What a process ends with that a signal has asked to stop: 128 and its number, as shells expect.
int stopped_exit_code();

}  // namespace ccdt::tools
