#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "bench/run/case.h"
#include "bench/sweep/spec.h"
#include "engine/base/progress.h"

namespace ccdt::sweep {

/// The format in which meshes are kept.
inline constexpr const char* kept_mesh_ending = ".vtu";

/// The input of a case.
struct CaseInput {
  std::string name;            ///< unique name: "piston-2.32", "part.off"
  std::filesystem::path file;  ///< absolute
  std::string model;           ///< empty: a user's file
  double edge_length = 0;      ///< of the model's triangles
};

/// A case of a sweep.
struct SweepCase {
  bench::Case asked;
  CaseInput input;
  std::string mesher;                                        ///< its name in reports
  std::vector<std::pair<std::string, std::string>> options;  ///< options that make a difference to its mesher, by name
  std::string id = {};                                       ///< known once its input exists
  std::vector<std::string> older_ids = {};                   ///< with the other identities of a mixed sweep
};

/// All cases of a spec: inputs times meshers times options, minus excluded ones, in the order of the spec. An option
/// that a mesher does not have does not multiply its cases.
///
/// \param folder  of the sweep; models are files in its subfolder `models`, which need not exist yet
/// \throw InputError  no file matches, nothing is left, or options contradict each other; names the JSON pointer
std::vector<SweepCase> expand(const SweepSpec& spec, const std::filesystem::path& folder, const MeshOptionRules& rules);

/// The options as words of a command line. Options that the mesher does not use and default values are left out, so
/// that equal cases have equal words.
std::vector<std::string> words_for(const std::string& mesher,
                                   const std::vector<std::pair<std::string, std::string>>& options);

/// Writes the missing models. \param anew  writes existing ones again
/// \throw OutputError
/// \throw baselines::Stopped
void write_models(std::span<const SweepCase> cases, bool anew, const Progress& progress);

/// The cases for `bench::Runner`, with the options as words of a command line.
/// \throw Error  a mesher is not in this build, or its description cannot be read
std::vector<bench::Case> asked_of(std::span<const SweepCase> cases);

}  // namespace ccdt::sweep
