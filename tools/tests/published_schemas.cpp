#include "tools/tests/published_schemas.h"

#include <fstream>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validation_results.hpp>
#include <valijson/validator.hpp>

namespace ccdt {

using Json = nlohmann::json;

PublishedSchemas::PublishedSchemas(const std::filesystem::path& folder) {
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    std::ifstream file(entry.path());
    const Json schema = Json::parse(file);
    schemas_[schema.at("title")] = schema;
    files_[entry.path().filename().string()] = schema;
  }
}

std::vector<std::string> PublishedSchemas::faults(const std::string& name, const Json& document) const {
  const auto rules = schemas_.find(name);
  if (rules == schemas_.end()) return {"no schema '" + name + "' is published"};
  using Adapter = valijson::adapters::NlohmannJsonAdapter;
  valijson::Schema schema;
  valijson::SchemaParser().populateSchema(
      Adapter(rules->second), schema, [&](const std::string& file) { return &files_.at(file); }, [](const Json*) {});
  valijson::ValidationResults results;
  valijson::Validator().validate(schema, Adapter(document), &results);
  std::vector<std::string> faults;
  for (const auto& fault : results) {
    std::string place;
    for (const std::string& step : fault.context) place += step;
    faults.push_back(place + ": " + fault.description);
  }
  return faults;
}

}  // namespace ccdt
