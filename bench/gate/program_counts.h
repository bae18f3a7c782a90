#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "bench/gate/rules.h"
#include "bench/gate/side_program.h"
#include "bench/gate/verdict.h"
#include "engine/base/progress.h"

/// Exact counts of any program, by callgrind: instructions, system calls and allocations.
namespace ccdt::gate {

/// What one run of a program, with its children, or the loop of one benchmark costs.
struct ProgramCounts {
  std::uint64_t instructions = 0;
  std::uint64_t system_calls = 0;
  std::uint64_t allocations = 0;                        ///< calls of malloc, calloc, realloc and their kin
  std::map<std::string, std::uint64_t> functions = {};  ///< instructions of each without its callees
};

/// How to count a program.
struct CountOptions {
  Command arguments = {};            ///< for both programs
  std::set<std::string> cases = {};  ///< benchmarks; empty: the whole process
};

/// Counts base and head. A case of Google Benchmark is one iteration of its loop, without what comes before and after.
/// Any other case is the whole process.
///
/// The base is counted twice, in environments of different sizes. If its instructions differ by more than half of the
/// threshold, they depend on the environment, the time or chance, and the case is undecided. System calls and
/// allocations must stay the same exactly, and are not gated if those of the base differ.
///
/// \return  figures "instructions.total", "instructions.system_calls" and "instructions.allocations" of each case
/// \throw InputError          there is no valgrind
/// \throw baselines::Stopped  the user has stopped this program
std::vector<JudgedFigure> compare_counts(const Programs& programs, const CountOptions& options, const Rules& rules,
                                         const Progress& progress);

/// The counts of a profile, and of others of the same run.
/// \throw InputError  it is not a profile of callgrind
void add_profile(std::string_view profile, ProgramCounts& counts);

/// \param again  the same base once more
std::vector<JudgedFigure> judge_counts(const std::string& case_name, const ProgramCounts& base,
                                       const ProgramCounts& again, const ProgramCounts& head, const Rules& rules);

}  // namespace ccdt::gate
