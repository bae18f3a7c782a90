#include "baselines/parse_json.h"

#include <algorithm>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace ccdt::baselines {

namespace {

using Document = nlohmann::ordered_json;

void check_nesting(std::string_view text) {
  int depth = 0;
  bool is_quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (is_quoted) {
      if (c == '\\')
        ++i;
      else
        is_quoted = c != '"';
      continue;
    }
    is_quoted = c == '"';
    if (c == '[' || c == '{') ++depth;
    if (c == ']' || c == '}') --depth;
    if (depth > most_nested)
      throw Document::parse_error::create(101, i + 1, "nested deeper than " + std::to_string(most_nested) + " levels",
                                          nullptr);
  }
}

/// Makes a document of what the library's parser finds. The library's own builder looks through all members of an
/// object for each new one, so that the time grows with their square; this one sorts their names once.
class Builder {
 public:
  explicit Builder(Document& root) : root_(root) {}

  /// \name What the parser calls; `false` would stop it.
  /// @{
  bool null() { return put(nullptr); }
  bool boolean(bool value) { return put(value); }
  bool number_integer(Document::number_integer_t value) { return put(value); }
  bool number_unsigned(Document::number_unsigned_t value) { return put(value); }
  bool number_float(Document::number_float_t value, const std::string& /*digits*/) { return put(value); }
  bool string(std::string& value) { return put(std::move(value)); }
  bool binary(Document::binary_t& value) { return put(std::move(value)); }  // not in text
  bool start_array(std::size_t /*size*/) { return open(Document::array()); }
  bool end_array() { return close(); }
  bool start_object(std::size_t /*size*/) { return open(Document::object()); }
  bool key(std::string& name) {
    name_ = std::move(name);
    return true;
  }
  bool end_object() {
    keep_last_of_equal_names(members_of(*open_.back()));
    return close();
  }
  template <class Fault>
  bool parse_error(std::size_t /*byte*/, const std::string& /*token*/, const Fault& error) {
    throw error;
  }
  /// @}

 private:
  using Members = Document::object_t;

  static Members& members_of(Document& object) { return object.get_ref<Members&>(); }

  static void keep_last_of_equal_names(Members& members) {
    std::vector<std::string_view> names;
    for (const auto& [name, value] : members) names.emplace_back(name);
    std::ranges::sort(names);
    if (std::ranges::adjacent_find(names) == names.end()) return;
    Members distinct;
    std::unordered_map<std::string, std::size_t> places;
    for (auto& [name, value] : members) {
      const auto [place, is_new] = places.try_emplace(name, distinct.size());
      if (is_new)
        distinct.emplace_back(name, std::move(value));
      else
        distinct.data()[place->second].second = std::move(value);
    }
    members = std::move(distinct);
  }

  Document& added(Document value) {
    if (open_.empty()) return root_ = std::move(value);
    Document& parent = *open_.back();
    if (!parent.is_object()) {
      parent.push_back(std::move(value));
      return parent.back();
    }
    return members_of(parent).emplace_back(std::move(name_), std::move(value)).second;
  }
  bool put(Document value) {
    added(std::move(value));
    return true;
  }
  bool open(Document value) {
    open_.push_back(&added(std::move(value)));
    return true;
  }
  bool close() {
    open_.pop_back();
    return true;
  }

  Document& root_;
  std::vector<Document*> open_;  ///< lists and objects that have not ended, each within the one before
  std::string name_;             ///< of the next member
};

}  // namespace

nlohmann::ordered_json parse_json(std::string_view text) {
  check_nesting(text);
  Document root;
  Builder builder(root);
  Document::sax_parse(text, &builder);
  return root;
}

std::optional<nlohmann::ordered_json> try_parse_json(std::string_view text) {
  try {
    return parse_json(text);
  } catch (const Document::parse_error&) {
    return std::nullopt;
  }
}

}  // namespace ccdt::baselines
