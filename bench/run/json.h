#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace ccdt::bench {

/// JSON whose names keep the order in which they were written.
using Json = nlohmann::ordered_json;

/// Indented text with a line feed at the end. Invalid UTF-8 (file names may contain any bytes) is replaced.
std::string to_text(const Json& json);

/// Writes the file completely or not at all. \throw OutputError
void write_json(const Json& json, const std::filesystem::path& file);

/// A kind of document: its object has the member `schema` with this name.
struct DocumentKind {
  const char* schema;
  const char* fault;   ///< message for a text that is not of this kind
  const char* remedy;  ///< remedy for the user
};

/// Parses a document and hands it to `read`.
/// \throw InputError  it is not of that kind, or a name or type is wrong
void parse_document(const std::string& text, const DocumentKind& kind, const std::function<void(const Json&)>& read);

/// The same with a file. \throw InputError  also if it cannot be read
void parse_document(const std::filesystem::path& file, const DocumentKind& kind,
                    const std::function<void(const Json&)>& read);

/// The result of `from(json)` for a document, given by its text or file. \throw InputError  see `parse_document`
template <class Source, class Value>
Value read_document(const Source& source, const DocumentKind& kind, Value (*from)(const Json&)) {
  Value value;
  parse_document(source, kind, [&](const Json& json) { value = from(json); });
  return value;
}

}  // namespace ccdt::bench
