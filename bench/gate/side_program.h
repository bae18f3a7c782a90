#pragma once

#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "baselines/process.h"
#include "bench/gate/paired_samples.h"
#include "engine/base/errors.h"

/// The two programs that a gate runs.
namespace ccdt::gate {

/// A program and its arguments.
using Command = std::vector<std::string>;

/// A program failed while it was measured.
class ProgramFailed : public MeshError {
 public:
  ProgramFailed(Side side, const std::string& what, Place place, std::string command)
      : MeshError(what, std::move(place), "run it alone: " + command), side_(side), command_(std::move(command)) {}

  Side side() const { return side_; }
  const std::string& command() const { return command_; }

 private:
  Side side_;
  std::string command_;
};

/// Two programs, which may be the same, and how other builds of them are made.
struct Programs {
  Command base, head;  ///< the first word is the path of the program
  /// The path of a build by its number. Empty: there is only the program itself.
  std::function<std::filesystem::path(Side, int layout)> rebuilt = {};
};

/// One run of a program.
struct RunRequest {
  Side side = Side::base;
  std::size_t padding = 0;           ///< bytes of a variable that shifts the stack of the process
  std::set<std::string> cases = {};  ///< wanted cases; empty: all
  int layout = 0;                    ///< number of the build, if programs are rebuilt
  double most_seconds = 0;           ///< limit of the run; 0: that of the target
};

/// Splits what a user typed into words, as a shell does. A text that names a file is one word. A text with pipes or
/// other syntax of the shell becomes a call of /bin/sh. The program is searched on PATH, and its path is made absolute.
///
/// \param option  names the text in errors
/// \throw InputError  there is no such program
Command command_from(const std::string& text, const std::string& option);

/// "tool input.txt": a command for people, without the folder of the program.
std::string short_name(const Command& command);

/// The command of one side, with these arguments after its own.
Command command_of(const Programs& programs, const RunRequest& request, const Command& arguments);

/// Runs a command with an environment that is larger by the padding.
/// \param folder  where it runs; empty: where this process runs
baselines::ProcessResult try_run(const RunRequest& request, const Command& command, baselines::Limits limits,
                                 const std::filesystem::path& folder = {});

/// Why a run failed, in one line: the exit code, signal or limit, and the last lines that the program printed. The
/// lines that Google Benchmark prints at the start of every run are left out.
std::string reason_of(const baselines::ProcessResult& ended);

/// \throw ProgramFailed  always
[[noreturn]] void fail(Side side, const Command& command, const std::string& why);

/// Runs a command as `try_run`. \throw ProgramFailed
baselines::ProcessResult run(const RunRequest& request, const Command& command, const baselines::Limits& limits,
                             const std::filesystem::path& folder = {});

}  // namespace ccdt::gate
