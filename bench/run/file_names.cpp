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
    throw std::invalid_argument(io::in_quotes(name) + " is not a valid name for a file in this folder");
}

void check_file_path(const std::string& path) {
  std::size_t begin = 0;
  for (std::size_t end = 0; end != std::string::npos; begin = end + 1) {
    end = path.find('/', begin);
    check_file_name(path.substr(begin, end - begin));
  }
}

std::string name_in(const std::filesystem::path& folder, const std::filesystem::path& file) {
  const auto whole = std::filesystem::absolute(file).lexically_normal();
  const auto name = whole.lexically_relative(std::filesystem::absolute(folder).lexically_normal());
  return name.empty() || *name.begin() == ".." ? whole.string() : name.string();
}

}  // namespace ccdt::bench
