#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "bench/run/identity.h"
#include "bench/sweep/expand.h"
#include "bench/sweep/spec.h"

namespace ccdt::sweep {

/// The document of a sweep's folder: DIR/sweep.json, schema ccdt.sweep/1.
struct SweepDocument {
  std::string name;
  std::uint64_t seed = 1;                   ///< of the spec
  std::vector<bench::Identity> identities;  ///< identities whose records count; the first is that of the last call
  std::vector<SweepCase> cases;             ///< without words for the command line; `asked_of` adds them
};

/// The document of a folder.
std::filesystem::path sweep_file(const std::filesystem::path& folder);

/// \throw OutputError
void write_sweep(const std::filesystem::path& folder, const SweepSpec& spec,
                 const std::vector<bench::Identity>& identities, std::span<const SweepCase> cases);

/// \throw InputError  it is missing or invalid
SweepDocument read_sweep(const std::filesystem::path& folder);

/// The changes since the last call in the folder.
struct SweepChanges {
  std::vector<std::string> added, obsolete;  ///< names of cases

  bool none() const { return added.empty() && obsolete.empty(); }
};

SweepChanges changes_since(const SweepDocument& then, std::span<const SweepCase> now);

}  // namespace ccdt::sweep
