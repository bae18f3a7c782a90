#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace ccdt {

/// How a run ended; the names are those of the `ccdt.run/1` schema.
enum class RunStatus { ok, failed, timeout, out_of_memory, crashed };

std::string_view name_of(RunStatus status);
/// \throw std::invalid_argument  no such status
RunStatus run_status(std::string_view name);

/// What a child process may use; 0 is no limit.
struct Limits {
  double seconds = 0;              ///< of wall-clock time
  std::uint64_t memory_bytes = 0;  ///< of resident memory
};

struct ChildResult {
  RunStatus status = RunStatus::ok;
  std::string
      reason;  ///< empty if all went well; else what a person needs to know: limit, signal or the child's own words
  int exit_code = 0;   ///< if it exited by itself
  int signal = 0;      ///< if a signal ended it
  double seconds = 0;  ///< wall-clock time from start to end
};

/// Runs a program to its end, or to its limit, whichever comes first, in a process group of its own: at a limit the
/// whole group is killed. It gets no input, its standard output is dropped, and its standard error becomes the reason
/// if it fails.
///
/// Memory is watched a hundred times a second instead of limited by the kernel, because that knows only limits of
/// address space, which sanitizers and allocators reserve far more of than they use.
///
/// \param command  absolute path of the program, then its arguments
/// \param folder   where it runs; empty: where this process does
ChildResult run_child(const std::vector<std::string>& command, const Limits& limits = {},
                      const std::filesystem::path& folder = {});

}  // namespace ccdt
