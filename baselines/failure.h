#pragma once

#include <array>
#include <exception>
#include <optional>
#include <string>
#include <utility>

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

/// Why a run failed. The status follows from it.
enum class FailureKind { invalid_input, limit, refused, crashed, timeout, out_of_memory, wrong, missed, interrupted };

constexpr auto names_of(FailureKind) {
  using enum FailureKind;
  return std::to_array<NamedValue<FailureKind>>(
      {{invalid_input, "invalid_input", "the input cannot be read, or is not a valid piecewise linear complex"},
       {limit, "limit", "a limit of subdivision, size or disk space was reached"},
       {refused, "refused", "the mesher gave up and said so"},
       {crashed, "crashed", "a signal ended the mesher, or an unexpected error occurred"},
       {timeout, "timeout", "the time limit was reached"},
       {out_of_memory, "out_of_memory", "the memory limit was reached, or the machine ran out of memory"},
       {wrong, "wrong", "the mesh cannot be read, is incomplete, or failed its verification"},
       {missed, "missed", "the mesh misses a quality that was required of it, and is otherwise right"},
       {interrupted, "interrupted", "a signal asked the program to end"}});
}

/// The status of a run that failed.
RunStatus status_of(FailureKind kind);

/// The kind of failure for an error. The type of the error decides, never its message.
FailureKind failure_kind_of(const std::exception& error);

/// The kind of failure for a signal. Without a memory limit, SIGKILL means that the machine ran out of memory.
FailureKind failure_kind_of_signal(int signal);

/// The kind of failure for an exit code other than 0. Shells report a signal as 128 plus its number.
FailureKind failure_kind_of_exit_code(int code);

/// Another mesher failed; `kind` says how.
class MesherError : public MeshError {
 public:
  MesherError(FailureKind kind, const std::string& what, Place place, std::string remedy)
      : MeshError(what, std::move(place), std::move(remedy)), kind_(kind) {}

  FailureKind kind() const { return kind_; }

 private:
  FailureKind kind_;
};

}  // namespace ccdt::baselines
