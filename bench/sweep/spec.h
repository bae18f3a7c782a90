#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "baselines/process.h"
#include "bench/cases/case.h"
#include "bench/json.h"

namespace ccdt::sweep {

/// The command line of `ccdt mesh`, which only the program knows.
struct MeshOptionRules {
  std::vector<std::string> names;  ///< of the options that a sweep may vary, without dashes
  /// What is wrong with the value of one option; empty: nothing.
  std::function<std::string(const std::string& name, const std::string& value)> fault_of_value;
  /// The same of all options of a call.
  std::function<std::string(const std::vector<std::string>& words)> fault_of_words;
};

/// An option with the values that are tried, as on the command line.
struct OptionAxis {
  std::string name;  ///< without dashes
  std::vector<std::string> values;
};

/// A model in several sizes, or files.
struct SweepInput {
  std::string model;                     ///< empty: files
  std::vector<double> edge_lengths;      ///< of the model's triangles; empty: the model's default
  std::vector<std::string> files;        ///< names of files or folders, or with wildcards
  std::vector<OptionAxis> options = {};  ///< for this input instead of the spec's
};

/// What a case that is left out has: names of its properties, and for each the texts one of which it has.
using Exclusion = std::vector<std::pair<std::string, std::vector<std::string>>>;

/// What is measured: schema ccdt.sweep/1.
struct SweepSpec {
  std::filesystem::path file;  ///< where it was read
  std::string name, what, expects;
  std::uint64_t seed = 1;
  std::vector<SweepInput> inputs;
  std::vector<std::string> meshers = {"ccdt"};  ///< names, or absolute paths of descriptions
  std::vector<OptionAxis> options;
  std::vector<Exclusion> exclude;
  cases::Repetitions repetitions;
  bool verify = false;
  baselines::Limits limits = {.seconds = 600};
  bool keep_meshes = false;
};

/// Reads a spec, and checks it as far as that is possible without reading inputs.
/// \throw InputError  it cannot be read or is wrong; names the file and the JSON pointer
SweepSpec read_spec(const std::filesystem::path& file, const MeshOptionRules& rules);

/// The same from a document that is one; the file says where paths begin.
SweepSpec spec_from(const bench::Json& json, const std::filesystem::path& file, const MeshOptionRules& rules);

/// With defaults filled in.
bench::Json to_json(const SweepSpec& spec);

/// Of the member "limits" of a spec, which may be missing.
baselines::Limits limits_from(const bench::Json& json);

/// The user's files instead of those that the spec names; the models stay. Names begin in the current folder.
void replace_files(SweepSpec& spec, const std::vector<std::string>& files);

}  // namespace ccdt::sweep
