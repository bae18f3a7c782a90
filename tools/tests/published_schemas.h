#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace ccdt {

/// The JSON Schemas that come with the program.
class PublishedSchemas {
 public:
  /// \param folder  share/ccdt/schemas
  explicit PublishedSchemas(const std::filesystem::path& folder);

  /// By the names that documents give in their member `schema`: "ccdt.run/1".
  const std::map<std::string, nlohmann::json>& all() const { return schemas_; }

  /// What does not conform to the schema of this name, each with its place; empty: nothing.
  std::vector<std::string> faults(const std::string& name, const nlohmann::json& document) const;

 private:
  std::map<std::string, nlohmann::json> schemas_;
  std::map<std::string, nlohmann::json> files_;  ///< the same by their file names, by which they refer to each other
};

}  // namespace ccdt
