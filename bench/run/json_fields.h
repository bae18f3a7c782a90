#pragma once

#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

#include "bench/run/json.h"
#include "engine/base/enum_names.h"

/// Structs in JSON. The members of a struct are listed once, with their names, in `fields<Struct>`; writing, reading
/// and the conversions of nlohmann::json follow from that. Values of enumerations with `names_of` become their names.
namespace ccdt::bench {

/// A member of a struct.
template <class Access>
struct Field {
  const char* name;
  Access access;            ///< pointer to the member, or a function that returns a reference to it
  bool optional = false;    ///< may be missing: older programs did not write it
  bool omit_empty = false;  ///< is not written if it is empty
};

template <class Access>
constexpr Field<Access> field(const char* name, Access access) {
  return {name, access};
}
template <class Access>
constexpr Field<Access> optional_field(const char* name, Access access) {
  return {name, access, true};
}
/// A member that may be empty (a text, a list, `std::optional`), and is missing from the JSON then.
template <class Access>
constexpr Field<Access> field_if_any(const char* name, Access access) {
  return {name, access, true, true};
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

inline std::vector<double> numbers_from_json(const Json& json) {
  std::vector<double> numbers;
  for (const Json& number : json) numbers.push_back(number_from_json(number));
  return numbers;
}

template <class Type>
inline constexpr bool is_optional = false;
template <class Type>
inline constexpr bool is_optional<std::optional<Type>> = true;

/// \pre  what is `std::optional` has a value
template <class Member>
Json json_of_member(const Member& member) {
  if constexpr (is_optional<Member>)
    return *member;
  else
    return member;
}

template <class Member>
bool is_empty(const Member& member) {
  if constexpr (is_optional<Member>)
    return !member.has_value();
  else if constexpr (requires { member.empty(); })
    return member.empty();
  else
    return false;
}

template <class Struct, class Fields>
void write_fields(const Struct& value, const Fields& list, Json& json) {
  const auto write = [&](const auto& f) {
    const auto& member = std::invoke(f.access, value);
    if (!f.omit_empty || !is_empty(member)) json[f.name] = json_of_member(member);
  };
  std::apply([&](const auto&... f) { (write(f), ...); }, list);
}

/// \throw nlohmann::json::exception  a name is missing, or of another type
template <class Struct, class Fields>
void read_fields(const Json& json, const Fields& list, Struct& value) {
  const auto read = [&](const auto& f) {
    if (f.optional && !json.contains(f.name)) return;
    auto& member = std::invoke(f.access, value);
    if constexpr (std::is_same_v<decltype(member), double&>)
      member = number_from_json(json.at(f.name));
    else if constexpr (std::is_same_v<decltype(member), std::vector<double>&>)
      member = numbers_from_json(json.at(f.name));
    else if constexpr (is_optional<std::remove_reference_t<decltype(member)>>)
      member = json.at(f.name).template get<typename std::remove_reference_t<decltype(member)>::value_type>();
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
