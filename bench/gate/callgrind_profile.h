#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>

namespace ccdt::gate {

/// Who calls whom, and what that costs.
struct CallGraph {
  struct Callee {
    std::string name;                ///< demangled, without the marks of clones and of recursion
    std::uint64_t instructions = 0;  ///< of all calls from this caller, with all that they call in turn
  };
  std::multimap<std::string, Callee, std::less<>> calls;  ///< by the name of the caller
};

/// Reads what callgrind writes for one process: https://valgrind.org/docs/manual/cl-format.html
/// \throw InputError  it is none, or counts something other than instructions; names the line
CallGraph read_callgrind(std::string_view profile);

/// The qualified name of a function without its parameters: "ccdt::plc::build_plc". All of the name if it is that of
/// something inside a function (a lambda), of a template, or of something in an unnamed namespace.
std::string_view bare_name(std::string_view function);

}  // namespace ccdt::gate
