#pragma once

#include <map>
#include <set>
#include <string>

namespace ccdt::io {

/// Names for groups of elements in formats that allow few characters. They consist of ASCII letters, digits and '_',
/// begin with a letter, have at most 80 letters, and differ even if case is ignored.
class PlainNames {
 public:
  /// \param prefix  of the name of a group without one: "MARKER_" gives MARKER_3
  /// \param names   as a file gives them; changed as far as necessary
  std::string name_of(int marker, const std::string& prefix, const std::map<int, std::string>& names = {});

 private:
  std::set<std::string> used_;  ///< in upper case
  int next_ = 0;                ///< the last number that was appended to a name
};

}  // namespace ccdt::io
