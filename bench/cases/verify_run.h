#pragma once

#include <filesystem>

#include "bench/cases/case.h"
#include "bench/cases/run_case.h"

namespace ccdt::cases {

/// The files of a run whose mesh is to be verified.
struct RunFiles {
  std::filesystem::path input;  ///< what the mesh must agree with: the case's input, or the surface made of it
  std::filesystem::path mesh;
  std::filesystem::path scratch;  ///< a folder for the verifier's own files
};

/// Checks the mesh of a run exactly, in a child process of its own, and says in its record what came out. A mesh that
/// is not right makes the run a failure. An equal mesh of an earlier run of the case is not checked again. Meshers that
/// make a surface of their own are held to what their meshes promise.
///
/// \pre the run went well
/// \throw baselines::Stopped  the user has stopped the program
void verify_run(const RunPlace& place, const MeasuredCase& measured, const RunFiles& files, RunRecord& record);

}  // namespace ccdt::cases
