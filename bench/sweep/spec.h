#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "baselines/process.h"
#include "bench/run/case.h"
#include "bench/run/json.h"

namespace ccdt::sweep {

/// The command line of `ccdt mesh`, which only the program knows.
struct MeshOptionRules {
  std::vector<std::string> names;  ///< options that a sweep may vary, without dashes
  /// The error in the value of one option; empty: none.
  std::function<std::string(const std::string& name, const std::string& value)> fault_of_value;
  /// The same for all options of a call.
  std::function<std::string(const std::vector<std::string>& words)> fault_of_words;
};

/// An option with its values, as on the command line.
struct OptionAxis {
  std::string name;  ///< without dashes
  std::vector<std::string> values;
};

/// A model in several sizes, or files.
struct SweepInput {
  std::string model;                     ///< empty: files
  std::vector<double> edge_lengths;      ///< of the model's triangles; empty: the model's default
  std::vector<std::string> files;        ///< names of files or folders, or with wildcards
  std::vector<OptionAxis> options = {};  ///< override the options of the spec for this input
};

/// A rule that excludes cases: names of properties, each with texts. A case is excluded if every property has one of
/// its texts.
using Exclusion = std::vector<std::pair<std::string, std::vector<std::string>>>;

/// A spec: schema ccdt.sweep/1.
struct SweepSpec {
  std::filesystem::path file;  ///< where it was read
  std::string name, what, expects;
  std::uint64_t seed = 1;
  std::vector<SweepInput> inputs;
  std::vector<std::string> meshers = {"ccdt"};  ///< names, or absolute paths of descriptions
  std::vector<OptionAxis> options;
  std::vector<Exclusion> exclude;
  bench::Repetitions repetitions;
  bool verify = false;
  baselines::Limits limits = {.seconds = 600};
  bool keep_meshes = false;
};

/// Reads a spec, and checks everything that can be checked without reading inputs.
/// \throw InputError  it cannot be read or is invalid; names the file and the JSON pointer
SweepSpec read_spec(const std::filesystem::path& file, const MeshOptionRules& rules);

/// The same from a parsed document; the file gives the base of relative paths.
SweepSpec spec_from(const bench::Json& json, const std::filesystem::path& file, const MeshOptionRules& rules);

/// The spec as JSON, with defaults filled in.
bench::Json to_json(const SweepSpec& spec);

/// The member "limits" of a spec, which may be missing.
baselines::Limits limits_from(const bench::Json& json);

/// Replaces the files of the spec by the user's files; models stay. Names are relative to the current folder.
void replace_files(SweepSpec& spec, const std::vector<std::string>& files);

}  // namespace ccdt::sweep
