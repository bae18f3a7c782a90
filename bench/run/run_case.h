#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/run/case.h"

namespace ccdt::bench {

/// The surroundings of a run.
struct RunPlace {
  std::filesystem::path program;  ///< the `ccdt` that is run
  std::filesystem::path folder;   ///< of all records; the child process runs there
  int jobs = 1;                   ///< number of simultaneous runs
};

/// The arguments of a `ccdt` that runs a case in this folder and writes these files.
std::vector<std::string> mesh_arguments(const std::filesystem::path& folder, const Case& asked, const std::string& mesh,
                                        const std::string& report);

/// Makes the next run of a case in a child process. Verifies the mesh if the case asks for it, unless an equal mesh of
/// the case was verified already. Writes the record as runs/ID-NUMBER.json (complete or not at all), and adds it to the
/// case.
///
/// A child process that crashes or reaches a limit has a record as well. The command in the record can be repeated in
/// the folder, even if that has been moved, and overwrites nothing.
///
/// \throw baselines::Stopped  the user has stopped the program; nothing is left of this run
/// \throw OutputError         the record cannot be written
void run_next(const RunPlace& place, MeasuredCase& measured);

/// Makes the mesh of a case again to keep it, if the case was run without keeping it. Leaves no record.
/// \throw baselines::Stopped  the user has stopped the program
void make_mesh_again(const RunPlace& place, const MeasuredCase& measured);

}  // namespace ccdt::bench
