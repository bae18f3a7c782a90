#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "bench/cases/identity.h"
#include "bench/sweep/expand.h"
#include "bench/sweep/spec.h"

namespace ccdt::sweep {

/// What a sweep's folder says of itself: DIR/sweep.json, schema ccdt.sweep/1.
struct SweepDocument {
  std::uint64_t seed = 1;                   ///< of the spec
  std::vector<cases::Identity> identities;  ///< whose records count; the first is the one of the last call
  std::vector<SweepCase> cases;             ///< ready for `cases::Runner`
};

/// The document of a folder.
std::filesystem::path sweep_file(const std::filesystem::path& folder);

/// \throw OutputError
void write_sweep(const std::filesystem::path& folder, const SweepSpec& spec,
                 const std::vector<cases::Identity>& identities, std::span<const SweepCase> cases);

/// \throw InputError  there is none, or it is none
SweepDocument read_sweep(const std::filesystem::path& folder);

/// What has changed since the folder's last call.
struct SweepChanges {
  std::vector<std::string> added, obsolete;  ///< names of cases

  bool none() const { return added.empty() && obsolete.empty(); }
};

SweepChanges changes_since(const SweepDocument& then, std::span<const SweepCase> now);

}  // namespace ccdt::sweep
