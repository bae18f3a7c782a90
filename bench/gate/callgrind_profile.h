#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>

namespace ccdt::gate {

/// The costs and calls of functions. Names are demangled, without the marks of clones and of recursion.
struct CallGraph {
  struct Callee {
    std::string name;
    std::uint64_t instructions = 0;  ///< inclusive cost of all calls from this caller
    std::uint64_t calls = 0;
  };
  std::multimap<std::string, Callee, std::less<>> calls;  ///< by the name of the caller
  std::map<std::string, std::uint64_t, std::less<>> own;  ///< instructions of each function without its callees
  std::uint64_t system_calls = 0;                         ///< if the profile counts them
};

/// Reads the profile that callgrind writes for one process: https://valgrind.org/docs/manual/cl-format.html
/// \throw InputError  it is not a profile, or counts no instructions; names the line
CallGraph read_callgrind(std::string_view profile);

/// The qualified name of a function without its parameters: "ccdt::plc::build_plc". The full name for something inside
/// a function (a lambda), for a template, or in an unnamed namespace.
std::string_view bare_name(std::string_view function);

/// The cost of all calls of a function by others, with what it calls.
/// \param function  its bare name
std::uint64_t inclusive_instructions(const CallGraph& graph, std::string_view function);

}  // namespace ccdt::gate
