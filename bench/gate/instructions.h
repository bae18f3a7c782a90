#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <string_view>

#include "bench/gate/recording.h"
#include "bench/gate/rules.h"
#include "bench/run/case.h"
#include "engine/base/progress.h"

/// The instructions that a program executes, counted by callgrind: the same number in every run of one program on
/// machines with the same CPU model and libraries.
namespace ccdt::gate {

/// The instructions of each stage by its name, "delaunay", and of meshing as a whole, "mesh".
using StageInstructions = std::map<std::string, std::uint64_t>;

/// The instructions of the stages from a profile of callgrind, including all functions that they call. A stage that did
/// not run has 0. "rest" is the work of `mesh_plc` between stages.
///
/// \param profile  of one process (callgrind.out.PID)
/// \throw InputError  it is not a profile, or a stage is missing because its function was inlined or the program is
/// stripped
StageInstructions stage_instructions(std::string_view profile);

/// The C library chooses string functions and thresholds by the processor. These settings, a variable of the
/// environment with its value, work on all processors; names that a version of the library does not know are ignored.
/// Without fast bins, the stage that frees memory pays for it. With them, all are merged in the stage that first
/// requests a large block, and a few bytes decide which stage that is.
inline constexpr const char* same_on_all_processors =
    "GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX512F,-AVX512VL,-AVX512BW,-AVX2,-AVX2_Usable,-ERMS,-FSRM:"
    "glibc.cpu.x86_data_cache_size=32768:glibc.cpu.x86_shared_cache_size=1048576:"
    "glibc.cpu.x86_non_temporal_threshold=786432:glibc.malloc.mxfast=0";

/// The path of valgrind. \throw InputError  there is none; says what to do
std::filesystem::path find_valgrind();

/// The conditions on which instruction counts depend besides the program: "instructions.cpu", "instructions.valgrind",
/// "instructions.libc", "instructions.libstdc++", and how the program was compiled, "instructions.compiler" and
/// "instructions.flags".
///
/// \throw InputError  there is no valgrind, or the program is not `ccdt`; says what to do
bench::Identity instruction_identity(const std::filesystem::path& program);

/// Runs `ccdt mesh` of a program once under callgrind for each case of our mesher that the rules name. Adds the counts
/// of the stages to the case of that name in the recording, or to a new one, as figures "instructions.STAGE". The
/// identity gains `instruction_identity`.
///
/// \param folder    exists; gets the profiles, as instructions/NUMBER.callgrind in the order of the cases
/// \param progress  counts cases
/// \throw InputError  there is no valgrind, or a stage cannot be found; says what to do
/// \throw MeshError   the program failed on a case; says with what
/// \throw baselines::Stopped  the user has stopped this program
void add_instructions(const std::filesystem::path& program, std::span<const bench::Case> cases, const Rules& rules,
                      const std::filesystem::path& folder, Recording& recording, const Progress& progress = {});

}  // namespace ccdt::gate
