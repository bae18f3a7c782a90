#include "bench/sweep/sweep_document.h"

#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "baselines/mesher.h"
#include "bench/run/file_names.h"
#include "engine/base/errors.h"

namespace ccdt::sweep {
namespace {

using bench::Json;

constexpr bench::DocumentKind sweep_document = {"ccdt.sweep/1", "not the document of a sweep",
                                                "give a folder that `ccdt sweep SPEC.json -o DIR` has made"};

Json json_of(const bench::Repetitions& repetitions) {
  return {{"warm_up", repetitions.warm_up},
          {"at_least", repetitions.at_least},
          {"at_most", repetitions.at_most},
          {"until", repetitions.until}};
}

Json json_of(const SweepCase& one, const std::filesystem::path& folder) {
  Json input = {{"name", one.input.name}, {"file", bench::name_in(folder, one.input.file)}};
  if (!one.input.model.empty()) {
    input["model"] = one.input.model;
    input["edge_length"] = one.input.edge_length;
  }
  Json options = Json::object();
  for (const auto& [name, value] : one.options) options[name] = value;
  Json json = {{"id", one.id},
               {"name", one.asked.name},
               {"group", one.asked.group},
               {"input", std::move(input)},
               {"mesher", one.mesher}};
  if (baselines::is_mesher_description(one.asked.mesher)) json["mesher_file"] = one.asked.mesher;
  json["options"] = std::move(options);
  json["repetitions"] = json_of(one.asked.repetitions);
  if (!one.older_ids.empty()) json["older_ids"] = one.older_ids;
  return json;
}

SweepCase case_from(const Json& json, const SweepSpec& common, const std::filesystem::path& folder) {
  SweepCase one;
  const Json& input = json.at("input");
  input.at("name").get_to(one.input.name);
  one.input.file = folder / input.at("file").get<std::string>();
  one.input.model = input.value("model", "");
  one.input.edge_length = input.value("edge_length", 0.0);
  json.at("id").get_to(one.id);
  bench::check_file_name(one.id);
  one.older_ids = json.value("older_ids", one.older_ids);
  json.at("name").get_to(one.asked.name);
  json.at("group").get_to(one.asked.group);
  json.at("mesher").get_to(one.mesher);
  one.asked.mesher = json.value("mesher_file", one.mesher);
  for (const auto& [name, value] : json.at("options").items()) one.options.emplace_back(name, value.get<std::string>());
  const Json& repetitions = json.at("repetitions");
  repetitions.at("warm_up").get_to(one.asked.repetitions.warm_up);
  repetitions.at("at_least").get_to(one.asked.repetitions.at_least);
  repetitions.at("at_most").get_to(one.asked.repetitions.at_most);
  repetitions.at("until").get_to(one.asked.repetitions.until);
  one.asked.input = one.input.file;
  one.asked.limits = common.limits;
  one.asked.verify = common.verify;
  if (common.keep_meshes) one.asked.mesh_ending = kept_mesh_ending;
  return one;
}

}  // namespace

std::filesystem::path sweep_file(const std::filesystem::path& folder) {
  return folder / "sweep.json";
}

void write_sweep(const std::filesystem::path& folder, const SweepSpec& spec,
                 const std::vector<bench::Identity>& identities, std::span<const SweepCase> cases) {
  const auto whole = std::filesystem::absolute(folder).lexically_normal();
  Json json = to_json(spec);
  json.update(bench::identities_json(identities));
  json["cases"] = Json::array();
  for (const SweepCase& one : cases) json["cases"].push_back(json_of(one, whole));
  bench::write_json(json, sweep_file(folder));
}

SweepDocument read_sweep(const std::filesystem::path& folder) {
  const auto whole = std::filesystem::absolute(folder).lexically_normal();
  SweepDocument document;
  bench::parse_document(sweep_file(folder), sweep_document, [&](const Json& json) {
    SweepSpec common;
    common.limits = limits_from(json);
    json.at("verify").get_to(common.verify);
    json.at("keep_meshes").get_to(common.keep_meshes);
    json.at("name").get_to(document.name);
    json.at("seed").get_to(document.seed);
    document.identities = {json.at("identity").get<bench::Identity>()};
    for (const Json& other : json.value("mixed_with", Json::array()))
      document.identities.push_back(other.get<bench::Identity>());
    for (const Json& one : json.at("cases")) document.cases.push_back(case_from(one, common, whole));
  });
  return document;
}

SweepChanges changes_since(const SweepDocument& then, std::span<const SweepCase> now) {
  std::set<std::string> before, after;
  for (const SweepCase& one : then.cases) before.insert(one.id);
  for (const SweepCase& one : now) after.insert(one.id);
  SweepChanges changes;
  for (const SweepCase& one : now)
    if (!before.contains(one.id)) changes.added.push_back(one.asked.name);
  for (const SweepCase& one : then.cases)
    if (!after.contains(one.id)) changes.obsolete.push_back(one.asked.name);
  return changes;
}

}  // namespace ccdt::sweep
