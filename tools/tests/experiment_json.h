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

}  // namespace ccdt
