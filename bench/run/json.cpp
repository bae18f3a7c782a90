#include "bench/run/json.h"

#include <nlohmann/json.hpp>

#include "baselines/parse_json.h"
#include "engine/base/errors.h"
#include "engine/io/files.h"

namespace ccdt::bench {

std::string to_text(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void write_json(const Json& json, const std::filesystem::path& file) {
  io::OutputFile output(file);
  output << to_text(json);
  output.commit();
}

void parse_document(const std::string& text, const DocumentKind& kind, const std::function<void(const Json&)>& read) {
  try {
    const Json json = baselines::parse_json(text);
    if (!json.is_object() || json.value("schema", "") != kind.schema) throw InputError(kind.fault, {}, kind.remedy);
    read(json);
  } catch (const Error&) {
    throw;
  } catch (const std::exception& error) {
    throw InputError(std::string(kind.fault) + ": " + error.what(), {}, kind.remedy);
  }
}

void parse_document(const std::filesystem::path& file, const DocumentKind& kind,
                    const std::function<void(const Json&)>& read) {
  try {
    parse_document(io::read_whole_file(file).bytes, kind, read);
  } catch (InputError& error) {
    error.place().file = file.string();
    throw;
  }
}

}  // namespace ccdt::bench
