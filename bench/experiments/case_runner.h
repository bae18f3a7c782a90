#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "baselines/process.h"
#include "bench/run_record.h"

namespace ccdt {

/// One thing to measure: a call of `ccdt mesh`.
struct Case {
  std::string mesher;
  std::filesystem::path input;
  std::filesystem::path output;      ///< where its mesh goes
  std::vector<std::string> options;  ///< more of the command line
};

/// Runs a case once in a child process of its own and returns its record, which is also written to `report`. A child
/// that crashes or meets a limit has a record as well, with its status and the reason.
///
/// It runs in the experiment's folder and is told paths relative to it, so that its command can be repeated wherever
/// that folder has been moved to.
///
/// \param program  the `ccdt` program
/// \param folder   of the experiment; all files of the case are in it
/// \throw OutputError  the record cannot be written
RunRecord run_case(const std::filesystem::path& program, const std::filesystem::path& folder, const Case& what,
                   const std::filesystem::path& report, const Limits& limits);

}  // namespace ccdt
