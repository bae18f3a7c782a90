#pragma once

#include <signal.h>  // NOLINT(modernize-deprecated-headers): of POSIX
#include <sys/types.h>

namespace ccdt::baselines {

/// A process between a program and its parent, so that the program never leaves processes behind:
///
///     parent ── supervisor ── program ── its children ...
///
/// The supervisor adopts orphans of its descendants. It kills all descendants when the program ends, when the parent
/// ends in any way, or on SIGTERM. It is forked from a process that may have several threads, so it makes only system
/// calls.
class Supervisor {
 public:
  /// Makes this process, a fork of `parent`, a supervisor. Ends it if the parent is gone.
  explicit Supervisor(pid_t parent);

  /// Prepares the supervisor's fork before the program starts: it dies with the supervisor and gets default signal
  /// handling.
  void release_child() const;

  /// Waits for the end of the program and kills its remaining descendants. On SIGTERM, it ends by this signal.
  /// \param report  descriptor of a file that gets the status of the program, in the form of `waitpid`
  [[noreturn]] void watch(pid_t program, int report) const;

 private:
  pid_t self_;
  sigset_t usual_, watched_;
};

}  // namespace ccdt::baselines
