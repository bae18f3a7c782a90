#pragma once

#include <array>
#include <csignal>
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

/// From now on, SIGINT, SIGTERM and SIGHUP remove all unfinished files (`io::remove_unfinished_files`) and end this
/// process with the usual exit code of shells: 128 plus the number of the signal. Before, they call `last`, if that is
/// given; it may do only what a signal handler may. After `nohup`, SIGHUP stays ignored.
/// Where a file would get larger than the system allows, writing fails, as on a full disk, instead of ending the
/// process.
void clean_up_on_signals(void (*last)() = nullptr);

/// While the object lives, these signals do not end this process but ask it to stop (`request_stop`). Objects may be
/// nested. If nothing was stopped, the signal takes effect at the end of the outermost one.
class StopSignals {
 public:
  StopSignals();
  ~StopSignals();
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;

 private:
  std::array<struct sigaction, 3> before_{};
};

/// The exit code of a process that a signal asked to stop.
int stopped_exit_code();

}  // namespace ccdt::baselines
