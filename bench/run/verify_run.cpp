#include "bench/run/verify_run.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "baselines/mesher.h"
#include "bench/run/json.h"
#include "engine/base/errors.h"

namespace ccdt::bench {
namespace {

constexpr DocumentKind verification_kind = {"ccdt.verify/1", "not a report of schema ccdt.verify/1",
                                            "verify the mesh again"};

/// An exact check takes longer than a mesher, but at most by this factor.
constexpr double seconds_per_second = 20, least_seconds = 300;

/// The verification of an equal mesh of the case.
const VerifiedMesh* known_verification(const MeasuredCase& measured, const RunRecord& record) {
  const auto is_equal = [&](const RunRecord& run) {
    return run.verification && !record.mesh_fingerprint.empty() && run.mesh_fingerprint == record.mesh_fingerprint;
  };
  if (measured.runs > 0 && is_equal(measured.first)) return &*measured.first.verification;
  const auto found = std::ranges::find_if(measured.counted, is_equal);
  return found == measured.counted.end() ? nullptr : &*found->verification;
}

/// The options of the verifier that follow from those of the mesher.
std::vector<std::string> options_of(const Case& asked) {
  std::vector<std::string> options;
  for (std::size_t i = 0; i + 1 < asked.options.size(); ++i)
    if (asked.options[i] == "--boundary" || asked.options[i] == "--flatness")
      options.insert(options.end(), {asked.options[i], asked.options[i + 1]});
  const baselines::Mesher& mesher = baselines::mesher(asked.mesher);
  if (!mesher.keeps_surface) options.insert(options.end(), {"--surface", "own"});
  if (!mesher.description.empty()) options.insert(options.end(), {"--lists", "tetrahedra"});
  return options;
}

VerifiedMesh verified_from(const Json& json) {
  VerifiedMesh verified{.right = json.at("ok")};
  for (const Json& check : json.at("checks"))
    if (check.at("required") && check.at("failed") > 0)
      verified.checks.push_back({check.at("name"), check.at("checked"), check.at("failed")});
  return verified;
}

/// "the mesh is wrong; positive orientation: 3 of 120"
std::string words_of(const VerifiedMesh& verified) {
  std::string text = "the mesh is wrong";
  for (const auto& check : verified.checks)
    text += "; " + check.name + ": " + std::to_string(check.failed) + " of " + std::to_string(check.checked);
  return text;
}

void take(const VerifiedMesh& verified, RunRecord& record) {
  record.verification = verified;
  if (!verified.right) record.set_failure(baselines::FailureKind::wrong, words_of(verified));
}

}  // namespace

void verify_run(const RunPlace& place, const MeasuredCase& measured, const RunFiles& files, RunRecord& record) {
  if (const VerifiedMesh* known = known_verification(measured, record)) {
    VerifiedMesh same = *known;
    same.seconds = 0;
    return take(same, record);
  }
  const auto report = files.scratch / "verification.json";
  std::vector<std::string> command = {place.program.string(),
                                      "verify",
                                      files.input.string(),
                                      files.mesh.string(),
                                      "--report",
                                      report.string(),
                                      "--threads",
                                      "1"};
  const std::vector<std::string> options = options_of(measured.asked);
  command.insert(command.end(), options.begin(), options.end());
  const baselines::Limits limits{.seconds =
                                     std::max(least_seconds, seconds_per_second * measured.asked.limits.seconds)};
  const auto child =
      baselines::run_program(command, {.folder = place.folder, .limits = limits, .scratch = files.scratch});
  try {
    VerifiedMesh verified = read_document(report, verification_kind, verified_from);
    verified.seconds = child.seconds;
    take(verified, record);
  } catch (const InputError&) {
    record.notes.push_back("the mesh was not verified: " + child.reason);
  }
}

}  // namespace ccdt::bench
