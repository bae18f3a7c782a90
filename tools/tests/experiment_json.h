#pragma once

#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

namespace ccdt {

using Json = nlohmann::json;

/// The rows of a table of an experiment's JSON.
/// \throw std::out_of_range  there is no such table
inline Json rows_of(const Json& experiment, const std::string& table) {
  for (const Json& t : experiment.at("tables"))
    if (t.at("name") == table) return t.at("rows");
  throw std::out_of_range("no table " + table);
}

/// The JSON of an experiment without tables and texts.
///
/// \param environment  of a run
inline Json empty_experiment(const Json& environment) {
  Json json = {{"schema", "ccdt.experiment/1"},
               {"name", "fig7"},
               {"title", "Fig. 7"},
               {"section", "6"},
               {"command", "ccdt reproduce fig7"},
               {"scale", "quick"},
               {"tetrahedra", 8000},
               {"runs", 1},
               {"confidence", 0.95},
               {"limits", {{"seconds", 600}, {"memory_bytes", 0}}},
               {"good", true},
               {"environment", environment}};
  for (const char* list : {"definitions", "findings", "problems", "tables", "meshes", "raw_files"})
    json[list] = Json::array();
  return json;
}

}  // namespace ccdt
