#pragma once

#include <array>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace ccdt {

/// The place of an error in the user's data. Every part is optional; the program turns the given parts into words.
struct Place {
  std::string file = {};                           ///< path as the user gave it
  long long line = 0;                              ///< line of a text file, from 1
  long long byte = -1;                             ///< offset in a binary file
  std::vector<std::array<double, 3>> points = {};  ///< coordinates in the units of the input
  std::vector<long long> facets = {};              ///< numbers of input facets, from 0
};

/// The base of all errors of the project: what is wrong, where, and what the user can do next.
class Error : public std::runtime_error {
 public:
  Error(const std::string& what, Place place, std::string remedy)
      : std::runtime_error(what), place_(std::move(place)), remedy_(std::move(remedy)) {}

  const Place& place() const { return place_; }
  Place& place() { return place_; }
  const std::string& remedy() const { return remedy_; }

 private:
  Place place_;
  std::string remedy_;
};

/// The input cannot be read or is not a valid piecewise linear complex (exit code 3).
class InputError : public Error {
 public:
  using Error::Error;
};

/// The result cannot be written (exit code 3).
class OutputError : public Error {
 public:
  using Error::Error;
};

/// A limit of time, memory or subdivision was reached (exit code 4).
class LimitError : public Error {
 public:
  using Error::Error;
};

/// There is not enough memory (exit code 4).
class MemoryError : public LimitError {
 public:
  using LimitError::LimitError;
};

/// The engine could not finish a valid mesh, or a mesh failed a check (exit code 1).
class MeshError : public Error {
 public:
  using Error::Error;
};

/// Runs something whose errors concern a file: those that name none get its name.
template <class Run>
auto with_file_in_errors(const std::string& file, const Run& run) {
  try {
    return run();
  } catch (Error& error) {
    if (error.place().file.empty()) error.place().file = file;
    throw;
  }
}

}  // namespace ccdt
