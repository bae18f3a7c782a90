#pragma once

#include <signal.h>
#include <sys/types.h>

namespace ccdt::baselines {

/// A process between a program and the one that started it, so that the program never leaves anything behind:
///
///     parent ── supervisor ── program ── its children ...
///
/// The supervisor adopts what its descendants leave behind, and kills all of them when the program ends, when the
/// parent ends in whatever way, or on SIGTERM. It is a fork of a process that may have several threads, so it calls
/// nothing but the system.
class Supervisor {
 public:
  /// Makes this process, a fork of `parent`, a supervisor. Ends it if the parent has gone.
  explicit Supervisor(pid_t parent);

  /// In the supervisor's own fork, before the program starts: it dies with the supervisor, and gets signals as usual.
  void release_child() const;

  /// Waits for the end of the program and kills what is left of its descendants. On SIGTERM it ends by that.
  /// \param report  descriptor of a file that gets the program's status, as `waitpid` has it
  [[noreturn]] void watch(pid_t program, int report) const;

 private:
  pid_t self_;
  sigset_t usual_, watched_;
};

}  // namespace ccdt::baselines
