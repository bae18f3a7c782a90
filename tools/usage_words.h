#pragma once

#include <string>

namespace CLI {
class App;
class Error;
}  // namespace CLI

namespace ccdt::tools {

/// The message for a wrong command line, in the form of `in_words(std::exception)`: what is wrong, and what to do.
std::string usage_in_words(const CLI::App& app, const CLI::Error& error);

}  // namespace ccdt::tools
