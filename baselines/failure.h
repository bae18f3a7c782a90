#pragma once

#include <array>
#include <exception>
#include <optional>
#include <string>

#include "engine/base/enum_names.h"
#include "engine/base/errors.h"

namespace ccdt::baselines {

/// How a run ended; the names are those of the `ccdt.run/1` schema.
enum class RunStatus { ok, failed, timeout, out_of_memory, crashed };

constexpr auto names_of(RunStatus) {
  return std::to_array<NamedValue<RunStatus>>({{RunStatus::ok, "ok"},
                                               {RunStatus::failed, "failed"},
                                               {RunStatus::timeout, "timeout"},
                                               {RunStatus::out_of_memory, "out_of_memory"},
                                               {RunStatus::crashed, "crashed"}});
}

/// Why a run did not end well. The status follows from it.
enum class FailureKind { invalid_input, limit, refused, crashed, timeout, out_of_memory, wrong };

constexpr auto names_of(FailureKind) {
  using enum FailureKind;
  return std::to_array<NamedValue<FailureKind>>(
      {{invalid_input, "invalid_input", "the input cannot be read, or is no valid piecewise linear complex"},
       {limit, "limit", "a limit of subdivision, size or disk space was reached"},
       {refused, "refused", "the mesher gave up and said so"},
       {crashed, "crashed", "a signal ended the mesher, or it met an error that nobody expected"},
       {timeout, "timeout", "the limit of time was reached"},
       {out_of_memory, "out_of_memory", "the limit of memory was reached, or the machine had no more"},
       {wrong, "wrong", "the mesh cannot be read, is not whole, or failed its verification"}});
}

/// The status of a run that failed.
RunStatus status_of(FailureKind kind);

/// What an error says about the run that it ended. Its type decides, never its words.
FailureKind failure_kind_of(const std::exception& error);

/// What a signal says about the process that it ended: without a limit of ours, the kernel sends SIGKILL where memory
/// runs out.
FailureKind failure_kind_of_signal(int signal);

/// What the exit code of a program says that did not succeed. Shells report the signal that ended their program as 128
/// and its number.
FailureKind failure_kind_of_exit_code(int code);

/// The program of a mesher crashed, or what it wrote is no mesh.
class MesherError : public MeshError {
 public:
  MesherError(FailureKind kind, const std::string& what, Place place, std::string remedy)
      : MeshError(what, std::move(place), std::move(remedy)), kind_(kind) {}

  FailureKind kind() const { return kind_; }

 private:
  FailureKind kind_;
};

}  // namespace ccdt::baselines
