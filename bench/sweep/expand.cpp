#include "bench/sweep/expand.h"

#include <fnmatch.h>
#include <glob.h>

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "baselines/json_schema.h"
#include "baselines/mesher.h"
#include "baselines/mesher_options.h"
#include "bench/run/numbers.h"
#include "engine/base/digits.h"
#include "engine/base/errors.h"
#include "engine/io/plc_files.h"
#include "models/solids.h"

namespace ccdt::sweep {
namespace {

using Values = std::vector<std::pair<std::string, std::string>>;
using baselines::NamedOptions;

[[noreturn]] void fail(const SweepSpec& spec, const std::string& pointer, const std::string& what,
                       const std::string& remedy) {
  baselines::fail_at_pointer(spec.file.string(), pointer, what, remedy);
}

/// An input with its options.
struct ExpandedInput {
  CaseInput input;
  std::vector<OptionAxis> options;
};

/// The options of the spec; options of the input override those of the same name.
std::vector<OptionAxis> options_of(const SweepSpec& spec, const SweepInput& input) {
  std::vector<OptionAxis> axes = spec.options;
  for (const OptionAxis& own : input.options) {
    const auto same = std::ranges::find(axes, own.name, &OptionAxis::name);
    if (same != axes.end())
      *same = own;
    else
      axes.push_back(own);
  }
  return axes;
}

/// The files that match a name with wildcards, sorted by name.
std::vector<std::filesystem::path> files_like(const std::string& pattern) {
  glob_t found{};
  std::vector<std::filesystem::path> files;
  if (glob(pattern.c_str(), 0, nullptr, &found) == 0) files.assign(found.gl_pathv, found.gl_pathv + found.gl_pathc);
  globfree(&found);
  return files;
}

/// Is a file of this name mostly no input by itself? Node lists belong to other files; those of Gmsh and VTK are mostly
/// meshes.
bool is_mostly_no_input(const std::filesystem::path& file) {
  return file.extension() == ".node" || file.extension() == ".msh" || file.extension() == ".vtu";
}

/// All inputs in a folder.
std::vector<std::filesystem::path> files_in(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.is_regular_file() && io::is_plc_file(entry.path()) && !is_mostly_no_input(entry.path()))
      files.push_back(entry.path());
  std::ranges::sort(files);
  return files;
}

std::vector<std::filesystem::path> files_of(const SweepSpec& spec, const SweepInput& input,
                                            const std::string& pointer) {
  std::vector<std::filesystem::path> files;
  for (const std::string& pattern : input.files) {
    std::vector<std::filesystem::path> some;
    for (const auto& path : files_like(pattern)) {
      if (std::filesystem::is_directory(path))
        for (const auto& file : files_in(path)) some.push_back(file);
      else
        some.push_back(path);
    }
    if (some.empty()) fail(spec, pointer, "no file matches '" + pattern + "'", "correct it, or give files by --input");
    files.insert(files.end(), some.begin(), some.end());
  }
  if (files.empty()) fail(spec, pointer, "there are no files", "give them by --input, or name them there");
  return files;
}

CaseInput model_input(const SweepInput& input, double edge_length, const std::filesystem::path& folder) {
  const std::string name = input.model + "-" + digits(edge_length);
  return {name, folder / "models" / (name + ".poly"), input.model, edge_length};
}

double default_edge_length(const std::string& model) {
  return std::ranges::find(models::solids(), model, &models::Solid::name)->default_edge_length;
}

/// Files of the same name are distinguished by their folders.
void tell_apart(const SweepSpec& spec, std::vector<ExpandedInput>& inputs) {
  std::map<std::string, std::set<std::filesystem::path>> files;
  for (const ExpandedInput& one : inputs) files[one.input.name].insert(one.input.file);
  const auto folder = std::filesystem::absolute(spec.file).parent_path().lexically_normal();
  for (ExpandedInput& one : inputs)
    if (files[one.input.name].size() > 1) one.input.name = one.input.file.lexically_relative(folder).string();
}

std::vector<ExpandedInput> inputs_of(const SweepSpec& spec, const std::filesystem::path& folder) {
  std::vector<ExpandedInput> all;
  for (std::size_t i = 0; i < spec.inputs.size(); ++i) {
    const SweepInput& input = spec.inputs[i];
    const std::vector<OptionAxis> options = options_of(spec, input);
    if (input.model.empty()) {
      for (const auto& file : files_of(spec, input, "/inputs/" + std::to_string(i) + "/files"))
        all.push_back({{file.filename().string(), file, {}, 0}, options});
    } else if (input.edge_lengths.empty()) {
      all.push_back({model_input(input, default_edge_length(input.model), folder), options});
    } else {
      for (const double length : input.edge_lengths) all.push_back({model_input(input, length, folder), options});
    }
  }
  tell_apart(spec, all);
  return all;
}

bool is_like(const std::string& text, const std::string& pattern) {
  return text == pattern || fnmatch(pattern.c_str(), text.c_str(), 0) == 0;
}

/// The texts that a spec may use for a property of a case.
std::vector<std::string> property(const std::string& name, const CaseInput& input, const std::string& mesher,
                                  const Values& options) {
  if (name == "mesher") return {mesher, baselines::mesher(mesher).name};
  if (name == "model") return {input.model};
  if (name == "input") return {input.name};
  if (name == "edge_length") return {input.model.empty() ? "" : digits(input.edge_length)};
  if (name == "file") return {input.file.filename().string(), input.file.string()};
  const auto option = std::ranges::find(options, name, &Values::value_type::first);
  return {option == options.end() ? "" : option->second};
}

bool is_excluded(const SweepSpec& spec, const CaseInput& input, const std::string& mesher, const Values& options) {
  return std::ranges::any_of(spec.exclude, [&](const Exclusion& exclusion) {
    return std::ranges::all_of(exclusion, [&](const auto& member) {
      const auto texts = property(member.first, input, mesher, options);
      return std::ranges::any_of(member.second, [&](const std::string& pattern) {
        return std::ranges::any_of(texts, [&](const std::string& text) { return is_like(text, pattern); });
      });
    });
  });
}

/// Calls `visit` with each combination of values; the last axis changes fastest.
template <class Visit>
void for_each_combination(const std::vector<OptionAxis>& axes, const Visit& visit) {
  std::vector<std::size_t> at(axes.size(), 0);
  for (;;) {
    Values values;
    for (std::size_t i = 0; i < axes.size(); ++i) values.emplace_back(axes[i].name, axes[i].values[at[i]]);
    visit(values);
    std::size_t axis = axes.size();
    while (axis > 0 && ++at[axis - 1] == axes[axis - 1].values.size()) at[--axis] = 0;
    if (axis == 0) return;
  }
}

NamedOptions effective(const std::string& mesher, const Values& options) {
  return baselines::effective_options(baselines::mesher(mesher), NamedOptions(options.begin(), options.end()));
}

/// The options that make a difference to the mesher here, by name. A default value is included if another value of its
/// axis makes a difference.
Values shown_options(const std::string& mesher, const Values& asked, const std::vector<OptionAxis>& axes) {
  const NamedOptions used = effective(mesher, asked);
  const auto matters = [&](std::size_t axis) {
    return std::ranges::any_of(axes[axis].values, [&](const std::string& value) {
      Values other = asked;
      other[axis].second = value;
      return effective(mesher, other) != used;
    });
  };
  Values shown;
  for (std::size_t i = 0; i < asked.size(); ++i) {
    const auto found = used.find(asked[i].first);
    if (found != used.end())
      shown.emplace_back(*found);
    else if (matters(i))
      shown.push_back(asked[i]);
  }
  std::ranges::sort(shown);
  return shown;
}

/// "piston-2, ccdt, lattice bcc": the options that have several values.
std::string name_of_case(const SweepCase& one, const std::vector<OptionAxis>& axes) {
  std::vector<std::string> parts = {one.input.name, one.mesher};
  for (const OptionAxis& axis : axes) {
    const auto option = std::ranges::find(one.options, axis.name, &Values::value_type::first);
    if (axis.values.size() > 1 && option != one.options.end()) parts.push_back(axis.name + " " + option->second);
  }
  return bench::joined(parts);
}

SweepCase case_of(const SweepSpec& spec, const ExpandedInput& input, const std::string& mesher, Values options) {
  SweepCase one;
  one.input = input.input;
  one.asked.mesher = mesher;
  one.mesher = baselines::mesher(mesher).name;
  one.options = std::move(options);
  one.asked.name = name_of_case(one, input.options);
  one.asked.group = input.input.name;
  one.asked.input = input.input.file;
  one.asked.options = words_for(mesher, one.options);
  one.asked.limits = spec.limits;
  one.asked.verify = spec.verify;
  if (spec.keep_meshes) one.asked.mesh_ending = kept_mesh_ending;
  one.asked.repetitions = spec.repetitions;
  return one;
}

/// \throw InputError  options of a case contradict each other
void check_options(const SweepSpec& spec, std::span<const SweepCase> cases, const MeshOptionRules& rules) {
  std::set<std::vector<std::string>> checked;
  for (const SweepCase& one : cases) {
    if (!checked.insert(one.asked.options).second) continue;
    const std::string fault = rules.fault_of_words(one.asked.options);
    if (!fault.empty()) fail(spec, "/options", fault + " (" + one.asked.name + ")", "change it, or exclude this case");
  }
}

}  // namespace

std::vector<std::string> words_for(const std::string& mesher, const Values& options) {
  std::vector<std::string> words;
  for (const auto& [name, value] : effective(mesher, options)) words.insert(words.end(), {"--" + name, value});
  return words;
}

std::vector<SweepCase> expand(const SweepSpec& spec, const std::filesystem::path& folder,
                              const MeshOptionRules& rules) {
  std::vector<SweepCase> all;
  std::set<std::tuple<std::filesystem::path, std::string, NamedOptions>> known;
  for (const ExpandedInput& input : inputs_of(spec, std::filesystem::absolute(folder).lexically_normal()))
    for (const std::string& mesher : spec.meshers)
      for_each_combination(input.options, [&](const Values& asked) {
        if (is_excluded(spec, input.input, mesher, asked)) return;
        if (!known.emplace(input.input.file, mesher, effective(mesher, asked)).second) return;
        all.push_back(case_of(spec, input, mesher, shown_options(mesher, asked, input.options)));
      });
  if (all.empty())
    fail(spec, spec.inputs.empty() ? "/inputs" : "/exclude", "there are no cases",
         spec.inputs.empty() ? "name a model or files" : "exclude fewer");
  check_options(spec, all, rules);
  return all;
}

void write_models(std::span<const SweepCase> cases, bool anew, const Progress& progress) {
  std::map<std::filesystem::path, const CaseInput*> models;
  for (const SweepCase& one : cases)
    if (!one.input.model.empty() && (anew || !std::filesystem::exists(one.input.file)))
      models.emplace(one.input.file, &one.input);
  std::uint64_t done = 0;
  for (const auto& [file, model] : models) {
    if (baselines::stop_requested()) throw baselines::Stopped();
    report(progress, "writing " + model->name, done++, models.size());
    std::filesystem::create_directories(file.parent_path());
    io::write_plc(models::make_solid(model->model, model->edge_length), file);
  }
}

std::vector<bench::Case> asked_of(std::span<const SweepCase> cases) {
  std::vector<bench::Case> all;
  for (const SweepCase& one : cases) {
    all.push_back(one.asked);
    all.back().options = words_for(one.asked.mesher, one.options);
  }
  return all;
}

}  // namespace ccdt::sweep
