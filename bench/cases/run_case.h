#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/cases/case.h"

namespace ccdt::cases {

/// Where a run takes place.
struct RunPlace {
  std::filesystem::path program;  ///< the `ccdt` that is run
  std::filesystem::path folder;   ///< of all records; the child runs there
  int jobs = 1;                   ///< how many runs there are at the same time
};

/// The arguments of a `ccdt` that runs a case in this folder and writes these files.
std::vector<std::string> mesh_arguments(const std::filesystem::path& folder, const Case& asked, const std::string& mesh,
                                        const std::string& report);

/// Makes the next run of a case in a child process, verifies the mesh if that is asked for and was not done for an
/// equal mesh of this case, writes the record as runs/ID-NUMBER.json (whole or not at all), and adds it to the case.
///
/// A child that crashes or meets a limit has a record as well. Its command is one that can be repeated in the folder,
/// wherever that has been moved to, and overwrites nothing.
///
/// \throw baselines::Stopped  the user has stopped the program; nothing is left of this run
/// \throw OutputError         the record cannot be written
void run_next(const RunPlace& place, MeasuredCase& measured);

/// Makes the mesh of a case once more, to keep it, if that was not asked for when the case was run. Leaves no record.
/// \throw baselines::Stopped  the user has stopped the program
void make_mesh_again(const RunPlace& place, const MeasuredCase& measured);

}  // namespace ccdt::cases
