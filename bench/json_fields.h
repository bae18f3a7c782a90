#pragma once

#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <tuple>
#include <type_traits>

#include "bench/json.h"
#include "engine/base/enum_names.h"

/// Structs in JSON. The members of a struct are listed once, with their names, in `fields<Struct>`; writing, reading
/// and the conversions of nlohmann::json follow from that. Enumerations with `names_of` are their names.
namespace ccdt::bench {

/// A member of a struct.
template <class Access>
struct Field {
  const char* name;
  Access access;          ///< pointer to the member, or a function that returns a reference to it
  bool optional = false;  ///< older programs did not write it
};

template <class Access>
constexpr Field<Access> field(const char* name, Access access) {
  return {name, access};
}
template <class Access>
constexpr Field<Access> optional_field(const char* name, Access access) {
  return {name, access, true};
}

/// A tuple of `Field`, in the order of the JSON.
template <class Struct>
inline constexpr std::nullptr_t fields = nullptr;

template <class Struct>
concept HasFields = !std::is_null_pointer_v<decltype(fields<Struct>)>;

/// JSON has no infinity; what was infinite (r of a flat tetrahedron) is null there.
inline double number_from_json(const Json& json) {
  return json.is_null() ? std::numeric_limits<double>::infinity() : json.get<double>();
}

template <class Struct, class Fields>
void write_fields(const Struct& value, const Fields& list, Json& json) {
  std::apply([&](const auto&... f) { ((json[f.name] = std::invoke(f.access, value)), ...); }, list);
}

/// \throw nlohmann::json::exception  a name is missing, or of another type
template <class Struct, class Fields>
void read_fields(const Json& json, const Fields& list, Struct& value) {
  const auto read = [&](const auto& f) {
    if (f.optional && !json.contains(f.name)) return;
    auto& member = std::invoke(f.access, value);
    if constexpr (std::is_same_v<decltype(member), double&>)
      member = number_from_json(json.at(f.name));
    else
      json.at(f.name).get_to(member);
  };
  std::apply([&](const auto&... f) { (read(f), ...); }, list);
}

}  // namespace ccdt::bench

template <ccdt::bench::HasFields Struct>
struct nlohmann::adl_serializer<Struct, void> {
  static void to_json(ccdt::bench::Json& json, const Struct& value) {
    json = ccdt::bench::Json::object();
    ccdt::bench::write_fields(value, ccdt::bench::fields<Struct>, json);
  }
  static void from_json(const ccdt::bench::Json& json, Struct& value) {
    ccdt::bench::read_fields(json, ccdt::bench::fields<Struct>, value);
  }
};

template <ccdt::NamedEnum Enum>
struct nlohmann::adl_serializer<Enum, void> {
  static void to_json(ccdt::bench::Json& json, Enum value) { json = ccdt::name_of(value); }
  static void from_json(const ccdt::bench::Json& json, Enum& value) {
    const auto name = json.get<std::string>();
    const auto found = ccdt::value_of<Enum>(name);
    if (!found) throw std::invalid_argument("unknown name '" + name + "'");
    value = *found;
  }
};
