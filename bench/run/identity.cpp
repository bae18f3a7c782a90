#include "bench/run/identity.h"

#include <unistd.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "baselines/mesher.h"
#include "baselines/mesher_description.h"
#include "baselines/mesher_options.h"
#include "baselines/parse_json.h"
#include "bench/run/environment.h"
#include "bench/run/numbers.h"
#include "engine/base/errors.h"
#include "engine/io/file_sets.h"
#include "engine/io/files.h"

namespace ccdt::bench {
namespace {

constexpr std::size_t id_digits = 16;
constexpr const char* identity_member = "identity";
constexpr const char* mixed_member = "mixed_with";

void add_machine(Identity& identity) {
  const Environment here = capture_environment();
  identity["machine.cpu"] = here.cpu;
  // All cores of the machine: a batch system may give a process only some of them.
  identity["machine.cores"] = std::to_string(sysconf(_SC_NPROCESSORS_CONF));
  identity["machine.system"] = here.system;
}

/// The fields on which a case depends: those of its mesher, and of the machine, which determines the times.
Identity part_for(const std::string& mesher, const Identity& identity) {
  Identity part;
  for (const auto& [field, value] : identity)
    if (field.starts_with("machine.") || field.starts_with(mesher + ".")) part[field] = value;
  return part;
}

/// The fields of the machine and of meshers that the other identity does not have.
Identity fields_missing_in(const Identity& other, const Identity& identity) {
  const auto owner_of = [](const std::string& field) { return field.substr(0, field.find('.') + 1); };
  Identity missing;
  for (const auto& [field, value] : identity) {
    const std::string owner = owner_of(field);
    const auto first = other.lower_bound(owner);
    if (first == other.end() || !first->first.starts_with(owner)) missing[field] = value;
  }
  return missing;
}

Json read_identities(const std::filesystem::path& file) {
  const io::FileBytes bytes = io::read_whole_file(file);
  auto json = baselines::try_parse_json(bytes.bytes);
  if (!json || !json->is_object() || !json->contains(identity_member))
    throw InputError("this file does not say which programs made its folder", io::place_in(file.string()),
                     "choose another folder, or remove the file to measure everything again");
  return *std::move(json);
}

/// The contents of files, each with the ending that says its format. Where the files are does not matter.
Json contents_of(const std::vector<std::filesystem::path>& files, FileHashes& hashes) {
  Json all = Json::array();
  for (const auto& file : files) all.push_back({io::lower_ending(file), hashes.of(file)});
  return all;
}

/// The words of the options, with the contents of files in place of their names.
Json options_json(const std::vector<std::string>& words, FileHashes& hashes) {
  Json all = Json::array();
  std::string_view before;
  for (const std::string& word : words) {
    const bool is_file = before.starts_with("--") && baselines::names_a_file(before.substr(2));
    all.push_back(is_file ? contents_of(io::files_of_sizes(word), hashes) : Json(word));
    before = word;
  }
  return all;
}

/// What a description of a mesher says: its own content, and that of the files that it names.
void add_description(const baselines::Mesher& mesher, FileHashes& hashes, Identity& identity) {
  if (mesher.description.empty()) return;
  identity[mesher.name + ".description"] = hashes.of(mesher.description);
  for (const auto& file : baselines::files_named_in(baselines::read_mesher_description(mesher.description)))
    if (file != mesher.program) identity[mesher.name + ".file " + file.filename().string()] += hashes.of(file);
}

}  // namespace

Identity identity_of(const std::vector<std::string>& meshers, const std::filesystem::path& program) {
  Identity identity;
  add_machine(identity);
  FileHashes hashes;
  for (const std::string& name_or_file : meshers) {
    const baselines::Mesher& mesher = baselines::mesher(name_or_file);
    identity[mesher.name + ".version"] = baselines::version_of(mesher);
    identity[mesher.name + ".binary"] = hashes.of(mesher.program.empty() ? program : mesher.program);
    add_description(mesher, hashes, identity);
  }
  return identity;
}

std::vector<std::string> differences(const Identity& then, const Identity& now) {
  std::vector<std::string> all;
  for (const auto& [field, value] : then) {
    const auto found = now.find(field);
    if (found == now.end() || found->second == value) continue;
    std::string words = field;
    words.append(" was '").append(value).append("' and is '").append(found->second).append("'");
    all.push_back(std::move(words));
  }
  return all;
}

std::vector<Identity> accepted_identities(const std::filesystem::path& file, const Identity& now,
                                          OtherIdentity policy) {
  if (!std::filesystem::exists(file)) return {now};
  const Json json = read_identities(file);
  const auto then = json.at(identity_member).get<Identity>();
  const auto mixed = json.value(mixed_member, std::vector<Identity>());
  const std::vector<std::string> changes = differences(then, now);
  Identity all = now;
  all.merge(fields_missing_in(now, then));  // of meshers that are not used now
  std::vector<Identity> accepted = {all};
  if (!changes.empty()) {
    const bool is_known =
        std::ranges::any_of(mixed, [&](const Identity& other) { return differences(other, now).empty(); });
    if (policy == OtherIdentity::refuse && !is_known)
      throw InputError("this folder was made with other programs or on another machine: " + joined(changes, "; "),
                       io::place_in(file.string()),
                       "choose another folder; or measure again with --refresh; or keep both with --mixed");
    if (policy == OtherIdentity::refresh) return accepted;
    accepted.push_back(then);
  }
  accepted.insert(accepted.end(), mixed.begin(), mixed.end());
  return accepted;
}

Json identities_json(const std::vector<Identity>& accepted) {
  Json json = {{identity_member, accepted.front()}};
  if (accepted.size() > 1) json[mixed_member] = std::vector<Identity>(accepted.begin() + 1, accepted.end());
  return json;
}

const std::string& FileHashes::of(const std::filesystem::path& file) {
  std::error_code ignored;
  const auto written = std::filesystem::last_write_time(file, ignored);
  const auto size = std::filesystem::file_size(file, ignored);
  const auto [entry, is_new] = known_.try_emplace(file);
  Known& known = entry->second;
  if (is_new || known.written != written || known.size != size) known = {written, size, sha256_of_file(file)};
  return known.hash;
}

std::string id_of(const Case& asked, const Identity& identity, FileHashes& hashes) {
  const std::string name = baselines::mesher(asked.mesher).name;
  Json what = {{"input", contents_of(io::files_of_plc(asked.input), hashes)},
               {"mesher", name},
               {"identity", part_for(name, identity)},
               {"options", options_json(asked.options, hashes)}};
  what["limits"] = {asked.limits.seconds, asked.limits.memory_bytes, asked.limits.disk_bytes};
  what["verify"] = asked.verify;
  return sha256_of_text(what.dump(-1, ' ', false, Json::error_handler_t::replace)).substr(0, id_digits);
}

}  // namespace ccdt::bench
