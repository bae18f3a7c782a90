#include "baselines/failure.h"

#include <csignal>
#include <new>
#include <system_error>

namespace ccdt::baselines {
namespace {

FailureKind failure_kind_of_system(const std::error_code& code) {
  if (code == std::errc::no_space_on_device || code == std::errc::file_too_large) return FailureKind::limit;
  if (code == std::errc::not_enough_memory) return FailureKind::out_of_memory;
  return FailureKind::crashed;
}

template <class Type>
bool is(const std::exception& error) {
  return dynamic_cast<const Type*>(&error) != nullptr;
}

}  // namespace

RunStatus status_of(FailureKind kind) {
  switch (kind) {
    case FailureKind::crashed:
      return RunStatus::crashed;
    case FailureKind::timeout:
      return RunStatus::timeout;
    case FailureKind::out_of_memory:
      return RunStatus::out_of_memory;
    default:
      return RunStatus::failed;
  }
}

FailureKind failure_kind_of(const std::exception& error) {
  if (const auto* mesher_error = dynamic_cast<const MesherError*>(&error)) return mesher_error->kind();
  if (const auto* system_error = dynamic_cast<const std::system_error*>(&error))
    return failure_kind_of_system(system_error->code());
  if (is<InputError>(error)) return FailureKind::invalid_input;
  if (is<MemoryError>(error) || is<std::bad_alloc>(error)) return FailureKind::out_of_memory;
  if (is<LimitError>(error) || is<OutputError>(error)) return FailureKind::limit;  // usually a full disk
  if (is<Error>(error)) return FailureKind::refused;
  return FailureKind::crashed;
}

FailureKind failure_kind_of_signal(int signal) {
  switch (signal) {
    case SIGKILL:
      return FailureKind::out_of_memory;
    case SIGXCPU:
      return FailureKind::timeout;
    case SIGXFSZ:
      return FailureKind::limit;
    default:
      return FailureKind::crashed;
  }
}

FailureKind failure_kind_of_exit_code(int code) {
  constexpr int first_signal = 129, last_signal = 192;
  return code >= first_signal && code <= last_signal ? failure_kind_of_signal(code - 128) : FailureKind::refused;
}

}  // namespace ccdt::baselines
