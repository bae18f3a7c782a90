#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "baselines/failure.h"
#include "baselines/stop.h"

namespace ccdt::baselines {

/// What a child process may use; 0 is no limit.
///
/// Memory is watched a hundred times a second instead of limited by the kernel, because that knows only limits of
/// address space, which sanitizers and allocators reserve far more of than they use; the disk ten times a second.
struct Limits {
  double seconds = 0;              ///< of wall-clock time
  std::uint64_t memory_bytes = 0;  ///< of resident memory, with all that it has started
  std::uint64_t disk_bytes = 0;    ///< in its scratch folder, and printed
};

/// Where and how a program runs.
struct ProgramOptions {
  std::filesystem::path folder = {};                                  ///< empty: where this process runs
  std::vector<std::pair<std::string, std::string>> environment = {};  ///< variables besides those of this process
  std::filesystem::path log = {};  ///< gets all that it prints; empty: standard output is dropped
  /// If there are limits, even of 0, the program is supervised: it and all that it has started ends when it ends, when
  /// this process ends or is to stop, or at a limit.
  std::optional<Limits> limits = {};
  std::filesystem::path scratch = {};  ///< for its temporary files, as TMPDIR; empty: where this process has them
};

struct ProcessResult {
  RunStatus status = RunStatus::ok;
  std::optional<FailureKind> kind;  ///< why not ok; the status follows from it
  std::string reason;   ///< empty if all went well; else what a person needs to know: limit, signal or what it printed
  int exit_code = 0;    ///< if it exited by itself; 127 if the program cannot be started
  int signal = 0;       ///< if a signal ended it
  double seconds = 0;   ///< wall-clock time from start to end
  std::string printed;  ///< the end of what was captured of its output, without trailing white space
  std::optional<std::string> value = {};  ///< of a function that returned

  /// The exit code as shells have it: 128 and the number of the signal that ended it.
  int shell_code() const { return signal == 0 ? exit_code : 128 + signal; }
};

/// Runs a program to its end, to a limit, or to the end of this process, whichever comes first. It gets no input.
/// Without a log, its standard error is captured. May be called by several threads at once.
///
/// \param command  path of the program, then its arguments
/// \throw std::system_error  no process can be started, or the log cannot be written
/// \throw Stopped            it is supervised, and this process is to stop; see `request_stop`
ProcessResult run_program(const std::vector<std::string>& command, const ProgramOptions& options = {});

/// Calls a function in a fork of this process and waits for it. This is for libraries that crash, exit or print instead
/// of returning an error: nothing of what happens there reaches this process, except for the returned bytes. The
/// function must not throw. Its standard output and standard error are captured.
///
/// \throw std::system_error  no process can be started
ProcessResult run_function(const std::function<std::string()>& function);

/// A command as one types it in a shell.
std::string command_line(const std::vector<std::string>& command);

}  // namespace ccdt::baselines
