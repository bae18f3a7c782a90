#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "bench/cases/case.h"

namespace ccdt::cases {

/// What results depend on besides their cases, by the name of the field: "machine.cpu", "ccdt.binary" (a hash),
/// "tetgen.version".
using Identity = std::map<std::string, std::string>;

/// Of this machine and of these meshers.
/// \throw Error  there is no such mesher
Identity identity_of(const std::vector<std::string>& meshers, const std::filesystem::path& program);

/// What to do with records that were made with another identity.
enum class OtherIdentity {
  refuse,   ///< throw
  refresh,  ///< measure again; what they were made with is obsolete
  mixed     ///< keep them beside those that are made now
};

/// The identities whose records count: the one of now, and with `mixed` older ones.
///
/// \param file  the JSON document that keeps them under "identity" (now) and "mixed_with" (older ones); need not exist
/// \throw InputError  the one of the file differs, and the policy is to refuse; the message names the fields
std::vector<Identity> accepted_identities(const std::filesystem::path& file, const Identity& now, OtherIdentity policy);

/// The names of the fields that differ, with both values: "machine.cpu: 'A' then, 'B' now".
std::vector<std::string> differences(const Identity& then, const Identity& now);

/// The hash that identifies a case: of the bytes of its input and of other files that its options name, the mesher's
/// name, version and binary, the options, the limits, and whether it is verified; 16 hexadecimal digits.
std::string id_of(const Case& asked, const Identity& identity);

}  // namespace ccdt::cases
