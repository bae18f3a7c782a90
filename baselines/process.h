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

/// The limits of a child process; 0 means no limit.
///
/// Memory is checked a hundred times a second, and the disk ten times. The kernel could only limit the address space,
/// but sanitizers and allocators reserve far more of that than they use.
struct Limits {
  double seconds = 0;              ///< of wall-clock time
  std::uint64_t memory_bytes = 0;  ///< of resident memory, including all descendants
  std::uint64_t disk_bytes = 0;    ///< of its scratch folder and its output
};

/// Where and how a program runs.
struct ProgramOptions {
  std::filesystem::path folder = {};                                  ///< empty: where this process runs
  std::vector<std::pair<std::string, std::string>> environment = {};  ///< variables besides those of this process
  std::filesystem::path log = {};  ///< file for all output; empty: standard output is dropped
  /// If there are limits, even of 0, the program is supervised: it is ended at a limit, or when this process ends or is
  /// asked to stop. Its descendants end with it.
  std::optional<Limits> limits = {};
  std::filesystem::path scratch = {};  ///< TMPDIR of the program; empty: that of this process
};

struct ProcessResult {
  RunStatus status = RunStatus::ok;
  std::optional<FailureKind> kind;  ///< why it failed; the status follows from it
  std::string reason;               ///< empty on success; otherwise the limit, the signal or the output, for people
  int exit_code = 0;                ///< if it exited by itself; 127 if the program cannot be started
  int signal = 0;                   ///< if a signal ended it
  double seconds = 0;               ///< wall-clock time from start to end
  std::string printed;              ///< the end of its captured output, without trailing white space
  std::optional<std::string> value = {};  ///< of a function that returned

  /// The exit code as in shells: 128 plus the number of the signal that ended the program.
  int shell_code() const { return signal == 0 ? exit_code : 128 + signal; }
};

/// Runs a program until it ends, reaches a limit, or this process ends. It gets no input. Without a log, its standard
/// error is captured. May be called by several threads at the same time.
///
/// \param command  path of the program, then its arguments
/// \throw std::system_error  no process can be started, or the log cannot be written
/// \throw Stopped            it is supervised, and this process was asked to stop; see `request_stop`
ProcessResult run_program(const std::vector<std::string>& command, const ProgramOptions& options = {});

/// Calls a function in a fork of this process and waits for it. This is for libraries that crash, exit or print instead
/// of returning an error: nothing of what happens there reaches this process, except for the returned bytes. The
/// function must not throw. Its standard output and standard error are captured.
///
/// \throw std::system_error  no process can be started
ProcessResult run_function(const std::function<std::string()>& function);

/// A command as typed in a shell.
std::string command_line(const std::vector<std::string>& command);

}  // namespace ccdt::baselines
