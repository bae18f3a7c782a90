#pragma once

#include <filesystem>

#include "bench/run/case.h"
#include "bench/run/run_case.h"

namespace ccdt::bench {

/// The files of a run whose mesh is verified.
struct RunFiles {
  std::filesystem::path input;  ///< the reference: the input of the case, or the surface made from it
  std::filesystem::path mesh;
  std::filesystem::path scratch;  ///< a folder for the verifier's own files
};

/// Checks the mesh of a run exactly, in a separate child process, and adds the result to its record. A wrong mesh makes
/// the run a failure. A mesh that equals that of an earlier run of the case is not checked again. Meshers that make
/// their own surface are checked with `--surface own`.
///
/// \pre the run succeeded
/// \throw baselines::Stopped  the user has stopped the program
void verify_run(const RunPlace& place, const MeasuredCase& measured, const RunFiles& files, RunRecord& record);

}  // namespace ccdt::bench
