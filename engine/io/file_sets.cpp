#include "engine/io/file_sets.h"

#include <fstream>
#include <string>

#include "engine/io/formats.h"
#include "engine/io/text_scanner.h"

namespace ccdt::io {
namespace {

using Paths = std::vector<std::filesystem::path>;

bool begins_with_zero(const FileBytes& text) {
  return TextScanner(text).peek() == "0";
}

/// Does a TetGen file leave its vertices to the .node beside it? If so, its first number, the vertex count, is 0. Only
/// the beginning of the file is read, unless it is compressed.
bool has_no_vertices(const std::filesystem::path& file) {
  if (is_gzip_name(file)) return begins_with_zero(read_inflated_file(file));
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    const FileBytes bytes{file.string(), line};
    if (!TextScanner(bytes).at_end()) return begins_with_zero(bytes);
  }
  return false;
}

void add_if_there(const std::filesystem::path& file, Paths& files) {
  if (is_there(file)) files.push_back(file);
}

}  // namespace

Paths files_of_plc(const std::filesystem::path& file) {
  const std::string ending = lower_ending(without_gzip(file));
  Paths files = {file};
  if ((ending == ".poly" || ending == ".smesh") && is_there(file) && has_no_vertices(file))
    files.push_back(sibling(file, ".node"));
  return files;
}

Paths files_of_sizes(const std::filesystem::path& file) {
  Paths files = {file};
  if (lower_ending(file) == ".sol") {
    add_if_there(sibling(file, ".mesh"), files);
    return files;
  }
  for (const char* ending : {".node", ".poly", ".smesh"}) {
    if (!is_there(sibling(file, ending))) continue;
    files.push_back(sibling(file, ending));
    if (std::string_view(ending) == ".node") add_if_there(sibling(file, ".ele"), files);
    break;
  }
  return files;
}

}  // namespace ccdt::io
