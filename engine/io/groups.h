#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "engine/plc/input.h"

namespace ccdt::io {

/// Groups of facets in a file. They become markers: a name that is a whole number is the marker itself; other names get
/// the unused numbers from 1 up, in order of appearance. Facets before the first group have the marker 0.
class Groups {
 public:
  Groups() : names_{"0"} {}

  /// The facets that follow are in this group.
  void enter(std::string_view name);
  /// The number of the group, as long as markers are not known.
  int current() const { return current_; }
  /// How many groups there are, without that of marker 0.
  std::size_t count() const { return names_.size() - 1; }
  /// Replaces the numbers of groups by markers, and notes the names.
  void give_markers(plc::InputPlc& plc) const;

 private:
  std::vector<int> markers() const;

  std::vector<std::string> names_;
  std::map<std::string, int> numbers_;
  int current_ = 0;
};

}  // namespace ccdt::io
