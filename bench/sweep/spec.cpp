#include "bench/sweep/spec.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "baselines/json_schema.h"
#include "baselines/mesher.h"
#include "baselines/mesher_options.h"
#include "bench/run/median_interval.h"
#include "bench/sweep/sweep_schema.h"
#include "engine/base/digits.h"
#include "engine/base/errors.h"
#include "models/solids.h"

namespace ccdt::sweep {
namespace {

using bench::Json;
using Pointer = Json::json_pointer;

constexpr baselines::UserFile spec_file = {"the spec of a sweep", sweep_schema, "; bench/sweeps has examples"};

/// A spec while it is read.
struct Reader {
  const Json& json;
  std::filesystem::path file;
  const MeshOptionRules& rules;

  [[noreturn]] void fail(const Pointer& at, const std::string& what, const std::string& remedy) const {
    baselines::fail_at_pointer(file.string(), at.to_string(), what, remedy);
  }
};

std::string text_of(const Json& value) {
  if (value.is_boolean()) return value.get<bool>() ? "on" : "off";
  if (value.is_number_integer()) return value.dump();
  if (value.is_number()) return digits(value.get<double>());
  return value.get<std::string>();
}

/// With a readable number of digits, the same on every machine.
double rounded_to_four_digits(double value) {
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::scientific, 3).ptr;
  std::from_chars(text.data(), end, value);
  return value;
}

std::vector<double> range_of(const Reader& reader, const Json& range, const Pointer& at) {
  const double from = range.at("from"), to = range.at("to");
  const bool is_log = range.value("scale", "log") == "log";
  const int last = range.at("steps").get<int>() - 1;
  if (is_log && (from <= 0 || to <= 0))
    reader.fail(at, "a log scale cannot reach 0 or a negative number",
                "make both ends greater than 0, or write "
                "\"scale\": \"linear\"");
  std::vector<double> values = {from};
  for (int i = 1; i < last; ++i) {
    const double part = static_cast<double>(i) / last;
    values.push_back(rounded_to_four_digits(is_log ? from * std::pow(to / from, part) : from + part * (to - from)));
  }
  values.push_back(to);
  return values;
}

/// The values of an axis, as texts.
std::vector<std::string> values_of(const Reader& reader, const Json& json, const Pointer& at) {
  std::vector<std::string> values;
  if (json.is_object()) {
    for (const double number : range_of(reader, json, at)) values.push_back(digits(number));
  } else if (json.is_array()) {
    for (const Json& value : json) values.push_back(text_of(value));
  } else {
    values = {text_of(json)};
  }
  return values;
}

/// A path in the spec: relative to its folder or, if nothing is there, to the current folder.
std::filesystem::path found(const Reader& reader, const std::filesystem::path& path) {
  const auto beside = reader.file.parent_path() / path;
  return std::filesystem::exists(beside) || !std::filesystem::exists(path)
             ? std::filesystem::absolute(beside).lexically_normal()
             : std::filesystem::absolute(path).lexically_normal();
}

std::vector<OptionAxis> options_of(const Reader& reader, const Json& parent, const Pointer& parent_at) {
  std::vector<OptionAxis> axes;
  if (!parent.contains("options")) return axes;
  for (const auto& [name, json] : parent["options"].items()) {
    const Pointer at = parent_at / "options" / name;
    if (std::ranges::find(reader.rules.names, name) == reader.rules.names.end())
      reader.fail(at, "a sweep cannot vary this option", baselines::suggestion(name, reader.rules.names));
    OptionAxis axis = {name, values_of(reader, json, at)};
    for (std::size_t i = 0; i < axis.values.size(); ++i) {
      if (baselines::names_a_file(name)) axis.values[i] = found(reader, axis.values[i]).string();
      const std::string fault = reader.rules.fault_of_value(name, axis.values[i]);
      if (!fault.empty()) reader.fail(json.is_array() ? at / i : at, fault, "`ccdt mesh --help` lists the values");
    }
    axes.push_back(std::move(axis));
  }
  return axes;
}

std::vector<std::string> texts_of(const Json& json) {
  return json.is_array() ? json.get<std::vector<std::string>>() : std::vector<std::string>{json.get<std::string>()};
}

void check_model(const Reader& reader, const SweepInput& input, const Pointer& at) {
  const auto solid = std::ranges::find(models::solids(), input.model, &models::Solid::name);
  if (solid == models::solids().end()) {
    std::vector<std::string> names;
    for (const models::Solid& known : models::solids()) names.emplace_back(known.name);
    reader.fail(at / "model", "there is no model '" + input.model + "'", baselines::suggestion(input.model, names));
  }
  for (const double length : input.edge_lengths)
    if (length < solid->finest || length > solid->coarsest)
      reader.fail(at / "edge_length", digits(length) + " is too " + (length < solid->finest ? "short" : "long"),
                  input.model + " keeps its shape from " + digits(solid->finest) + " to " + digits(solid->coarsest));
}

SweepInput input_of(const Reader& reader, const Json& json, const Pointer& at) {
  SweepInput input;
  input.model = json.value("model", "");
  if (json.contains("edge_length")) {
    const Json& lengths = json["edge_length"];
    if (lengths.is_object())
      input.edge_lengths = range_of(reader, lengths, at / "edge_length");
    else
      input.edge_lengths = lengths.is_array() ? lengths.get<std::vector<double>>() : std::vector{lengths.get<double>()};
  }
  if (!input.model.empty()) check_model(reader, input, at);
  if (json.contains("files"))
    for (const std::string& name : texts_of(json["files"])) {
      const bool has_wildcards = name.find_first_of("*?[") != std::string::npos;
      const auto path = has_wildcards ? reader.file.parent_path() / name : found(reader, name);
      input.files.push_back(std::filesystem::absolute(path).lexically_normal().string());
    }
  input.options = options_of(reader, json, at);
  return input;
}

/// \throw InputError  there is no such mesher
void add_mesher(const Reader& reader, const std::string& written, const Pointer& at, std::set<std::string>& names,
                std::vector<std::string>& meshers) {
  const bool is_file = baselines::is_mesher_description(written);
  const std::string mesher = is_file ? found(reader, written).string() : written;
  try {
    if (!names.insert(baselines::mesher(mesher).name).second)
      reader.fail(at, "two meshers have the same name", "rename one of them, so that reports can tell them apart");
  } catch (const InputError&) {
    throw;
  } catch (const Error& error) {
    reader.fail(at, error.what(), error.remedy());
  }
  meshers.push_back(mesher);
}

std::vector<std::string> meshers_of(const Reader& reader) {
  std::vector<std::string> meshers;
  if (!reader.json.contains("meshers")) return {"ccdt"};
  const Json& json = reader.json["meshers"];
  if (json.is_string()) {
    for (const baselines::Mesher& mesher : baselines::meshers()) meshers.push_back(mesher.name);
    return meshers;
  }
  std::set<std::string> names;
  for (std::size_t i = 0; i < json.size(); ++i)
    add_mesher(reader, json[i].get<std::string>(), Pointer() / "meshers" / i, names, meshers);
  return meshers;
}

std::vector<Exclusion> exclusions_of(const Reader& reader) {
  std::vector<Exclusion> all;
  if (!reader.json.contains("exclude")) return all;
  std::vector<std::string> known = {"mesher", "model", "edge_length", "input", "file"};
  known.insert(known.end(), reader.rules.names.begin(), reader.rules.names.end());
  for (const Json& json : reader.json["exclude"]) {
    const Pointer at = Pointer() / "exclude" / all.size();
    Exclusion exclusion;
    for (const auto& [name, value] : json.items()) {
      if (std::ranges::find(known, name) == known.end())
        reader.fail(at / name, "a case has no such property", baselines::suggestion(name, known));
      exclusion.emplace_back(name, values_of(reader, value, at / name));
    }
    all.push_back(std::move(exclusion));
  }
  return all;
}

bench::Repetitions repetitions_of(const Reader& reader) {
  bench::Repetitions repetitions;
  const Json json = reader.json.value("repetitions", Json(1));
  if (json.is_number()) {
    repetitions.at_least = repetitions.at_most = json.get<int>();
  } else {
    repetitions.until = json.at("until").get<double>();
    repetitions.at_least = json.value("at_least", bench::fewest_for_interval);
    repetitions.at_most = json.value("at_most", std::max(60, repetitions.at_least));
    if (repetitions.at_most < repetitions.at_least)
      reader.fail(Pointer() / "repetitions" / "at_most", "this is fewer than at_least", "write a greater number");
  }
  repetitions.warm_up = reader.json.value("warm_up", repetitions.at_most == 1 ? 0 : 1);
  return repetitions;
}

Json options_json(const std::vector<OptionAxis>& axes) {
  Json json = Json::object();
  for (const OptionAxis& axis : axes) json[axis.name] = axis.values;
  return json;
}

Json input_json(const SweepInput& input) {
  Json json;
  if (!input.model.empty()) json["model"] = input.model;
  if (!input.edge_lengths.empty()) json["edge_length"] = input.edge_lengths;
  if (input.model.empty()) json["files"] = input.files;
  if (!input.options.empty()) json["options"] = options_json(input.options);
  return json;
}

}  // namespace

baselines::Limits limits_from(const Json& json) {
  baselines::Limits limits = SweepSpec().limits;
  if (!json.contains("limits")) return limits;
  const Json& given = json["limits"];
  limits.seconds = given.value("seconds", limits.seconds);
  limits.memory_bytes = given.value("bytes", limits.memory_bytes);
  limits.disk_bytes = given.value("disk_bytes", limits.disk_bytes);
  return limits;
}

SweepSpec spec_from(const Json& json, const std::filesystem::path& file, const MeshOptionRules& rules) {
  const Reader reader{json, file, rules};
  SweepSpec spec;
  spec.file = file;
  spec.name = json.value("name", file.stem().string());
  spec.what = json.value("what", "");
  spec.expects = json.value("expects", "");
  spec.seed = json.value("seed", spec.seed);
  for (const Json& input : json.at("inputs"))
    spec.inputs.push_back(input_of(reader, input, Pointer() / "inputs" / spec.inputs.size()));
  spec.meshers = meshers_of(reader);
  spec.options = options_of(reader, json, Pointer());
  spec.exclude = exclusions_of(reader);
  spec.repetitions = repetitions_of(reader);
  spec.verify = json.value("verify", false);
  spec.limits = limits_from(json);
  spec.keep_meshes = json.value("keep_meshes", false);
  return spec;
}

SweepSpec read_spec(const std::filesystem::path& file, const MeshOptionRules& rules) {
  return spec_from(baselines::read_user_file(file, spec_file), file, rules);
}

Json to_json(const SweepSpec& spec) {
  const bench::Repetitions& repetitions = spec.repetitions;
  Json json = {{"schema", "ccdt.sweep/1"}, {"name", spec.name}};
  if (!spec.what.empty()) json["what"] = spec.what;
  if (!spec.expects.empty()) json["expects"] = spec.expects;
  json["seed"] = spec.seed;
  json["inputs"] = Json::array();
  for (const SweepInput& input : spec.inputs) json["inputs"].push_back(input_json(input));
  json["meshers"] = spec.meshers;
  json["options"] = options_json(spec.options);
  json["exclude"] = Json::array();
  for (const Exclusion& exclusion : spec.exclude) {
    Json one = Json::object();
    for (const auto& [name, values] : exclusion) one[name] = values;
    json["exclude"].push_back(one);
  }
  if (repetitions.until > 0)
    json["repetitions"] = {
        {"until", repetitions.until}, {"at_least", repetitions.at_least}, {"at_most", repetitions.at_most}};
  else
    json["repetitions"] = repetitions.at_least;
  json["warm_up"] = repetitions.warm_up;
  json["verify"] = spec.verify;
  json["limits"] = {{"seconds", spec.limits.seconds}};
  if (spec.limits.memory_bytes > 0) json["limits"]["bytes"] = spec.limits.memory_bytes;
  if (spec.limits.disk_bytes > 0) json["limits"]["disk_bytes"] = spec.limits.disk_bytes;
  json["keep_meshes"] = spec.keep_meshes;
  return json;
}

void replace_files(SweepSpec& spec, const std::vector<std::string>& files) {
  SweepInput mine;
  const auto of_files = [](const SweepInput& input) { return input.model.empty(); };
  const auto first = std::ranges::find_if(spec.inputs, of_files);
  if (first != spec.inputs.end()) mine.options = first->options;
  for (const std::string& file : files)
    mine.files.push_back(std::filesystem::absolute(file).lexically_normal().string());
  std::erase_if(spec.inputs, of_files);
  spec.inputs.push_back(std::move(mine));
}

}  // namespace ccdt::sweep
