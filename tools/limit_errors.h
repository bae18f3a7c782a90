#pragma once

#include <new>
#include <string>
#include <system_error>

#include "engine/base/errors.h"

namespace ccdt::tools {

/// Calls `run()`. If the system has no more memory or threads, the error names the stage and a file.
///
/// \param file   what is worked on
/// \param stage  the work; `run` may change it
/// \throw MemoryError  in place of `std::bad_alloc`
/// \throw LimitError   in place of one that names no file, and where no thread or process can be started
template <class Run>
auto with_stage_of_limits(const std::string& file, const std::string& stage, const Run& run) {
  const auto in_stage = [&](const std::string& what) { return what + " in the stage '" + stage + "'"; };
  try {
    return run();
  } catch (const std::bad_alloc&) {
    throw MemoryError(in_stage("out of memory"), {.file = file},
                      "allow more memory, use a machine with more memory, a coarser model or a larger --edge-length");
  } catch (const LimitError& error) {
    if (!error.place().file.empty()) throw;
    throw LimitError(in_stage(error.what()), {.file = file}, error.remedy());
  } catch (const std::system_error& error) {
    if (error.code() != std::errc::resource_unavailable_try_again && error.code() != std::errc::not_enough_memory)
      throw;
    throw LimitError(in_stage(error.what()), {.file = file}, "allow more memory and processes");
  }
}

}  // namespace ccdt::tools
