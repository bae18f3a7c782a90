#include "bench/run/file_names.h"

#include <algorithm>
#include <stdexcept>

#include "engine/io/text_scanner.h"

namespace ccdt::bench {
namespace {

bool is_plain(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' || c == '-' || c == '_';
}

}  // namespace

void check_file_name(const std::string& name) {
  if (name.empty() || name[0] == '.' || !std::ranges::all_of(name, is_plain))
    throw std::invalid_argument(io::in_quotes(name) + " is no name for a file of this folder");
}

void check_file_path(const std::string& path) {
  std::size_t begin = 0;
  for (std::size_t end = 0; end != std::string::npos; begin = end + 1) {
    end = path.find('/', begin);
    check_file_name(path.substr(begin, end - begin));
  }
}

}  // namespace ccdt::bench
