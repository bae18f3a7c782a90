#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "tests/fuzz/targets/target.h"

// Tries files, or all files of folders, one after the other: a fuzzer without libFuzzer.

namespace {

void replay(const std::filesystem::path& file) {
  std::puts(file.c_str());
  std::fflush(stdout);  // the last one is the culprit
  std::ifstream in(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
}

}  // namespace

int main(int argc, char** argv) {
  std::size_t files = 0;
  for (int i = 1; i < argc; ++i) {
    if (!std::filesystem::is_directory(argv[i])) {
      replay(argv[i]), ++files;
      continue;
    }
    for (const auto& entry : std::filesystem::directory_iterator(argv[i])) replay(entry.path()), ++files;
  }
  return files > 0 ? 0 : 2;
}
