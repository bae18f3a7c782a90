#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace ccdt::baselines {

/// A kind of JSON file that users write by hand.
struct UserFile {
  const char* what;      ///< "the description of a mesher"
  const char* schema;    ///< JSON Schema, draft 7; its descriptions say what to write
  const char* examples;  ///< ends each remedy: "; FOLDER has examples"
};

/// Reads a file and checks it against its schema. Members keep their order.
/// \throw InputError  the file cannot be read or is invalid; names the byte or the JSON pointer, and says what to write
/// there
nlohmann::ordered_json read_user_file(const std::filesystem::path& file, const UserFile& kind);

/// \throw InputError  "POINTER: what" in this file
[[noreturn]] void fail_at_pointer(const std::string& file, const std::string& pointer, const std::string& what,
                                  const std::string& remedy);

/// "a, b, c"
std::string listed(const std::vector<std::string>& names);

/// The remedy for an unknown name: "did you mean 'b'? use one of a, b, c".
///
/// \param before_list  the words before the known names
std::string suggestion(std::string_view unknown, const std::vector<std::string>& known,
                       const std::string& before_list = "use one of ");

}  // namespace ccdt::baselines
