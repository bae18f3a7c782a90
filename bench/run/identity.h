#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "bench/run/case.h"
#include "bench/run/json.h"

namespace ccdt::bench {

/// The fields on which results depend besides their cases: "machine.cpu", "ccdt.binary" (a hash), "tetgen.version". A
/// mesher that a file describes also has the hashes of that file, "NAME.description", and of the files that it names,
/// "NAME.file FILE".
using Identity = std::map<std::string, std::string>;

/// The identity of this machine and these meshers.
///
/// \param meshers  of this build, or files that describe others
/// \param program  the `ccdt` that runs them
/// \throw Error  there is no such mesher
Identity identity_of(const std::vector<std::string>& meshers, const std::filesystem::path& program);

/// What to do with records that were made with another identity.
enum class OtherIdentity {
  refuse,   ///< throw
  refresh,  ///< measure again; the old records are obsolete
  mixed     ///< keep the old records beside the new ones
};

/// The common fields that differ, with both values: "machine.cpu was 'A' and is 'B'".
std::vector<std::string> differences(const Identity& then, const Identity& now);

/// The identities whose records count: first the current one, then those with which it is mixed.
///
/// \param file  a JSON document with the members of `identities_json`; need not exist
/// \throw InputError  the identity of the file differs, and the policy is to refuse; the message names the fields
std::vector<Identity> accepted_identities(const std::filesystem::path& file, const Identity& now, OtherIdentity policy);

/// The members "identity" and "mixed_with" of a document that keeps identities.
Json identities_json(const std::vector<Identity>& accepted);

/// The hashes of files that many cases share, each computed once unless the file changes.
class FileHashes {
 public:
  /// SHA-256; empty if the file cannot be read.
  const std::string& of(const std::filesystem::path& file);

 private:
  struct Known {
    std::filesystem::file_time_type written;
    std::uintmax_t size = 0;
    std::string hash;
  };
  std::map<std::filesystem::path, Known> known_;
};

/// The hash that identifies a case: of the contents and endings of its input and of the files that belong to it or that
/// options name; the mesher's name and its part of the identity; the machine; the options; the limits of time, memory
/// and disk; and whether it is verified. Files count by their contents, wherever they are, and no other file counts. 16
/// hexadecimal digits.
std::string id_of(const Case& asked, const Identity& identity, FileHashes& hashes);

}  // namespace ccdt::bench
