#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace ccdt::bench {

/// JSON whose names keep the order in which they were written.
using Json = nlohmann::ordered_json;

/// Indented, with a line feed at the end. What is no UTF-8 (a file name may hold any bytes) is replaced.
std::string to_text(const Json& json);

/// Writes the file whole or not at all. \throw OutputError
void write_json(const Json& json, const std::filesystem::path& file);

/// A kind of document: its object has the member `schema` with this name.
struct DocumentKind {
  const char* schema;
  const char* fault;   ///< what to say about a text that is none
  const char* remedy;  ///< what the user can do then
};

/// Parses a document and hands it to `read`.
/// \throw InputError  it is none of that kind, or `read` misses a name or a type
void parse_document(const std::string& text, const DocumentKind& kind, const std::function<void(const Json&)>& read);

/// The same with a file. \throw InputError  also if it cannot be read
void parse_document(const std::filesystem::path& file, const DocumentKind& kind,
                    const std::function<void(const Json&)>& read);

/// What `from(json)` makes of a document, given by its text or its file. \throw InputError  see `parse_document`
template <class Source, class Value>
Value read_document(const Source& source, const DocumentKind& kind, Value (*from)(const Json&)) {
  Value value;
  parse_document(source, kind, [&](const Json& json) { value = from(json); });
  return value;
}

}  // namespace ccdt::bench
