#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "tests/fuzz/targets/target.h"

// Tries files, or all files of folders, one after the other: a fuzzer without libFuzzer. With --random FIRST
// COUNT, it tries lists of random bytes, the same ones each time.

namespace {

void replay(const std::filesystem::path& file) {
  std::puts(file.c_str());
  std::fflush(stdout);  // the last one is the culprit
  std::ifstream in(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
}

std::vector<std::uint8_t> random_bytes(std::size_t number) {
  std::minstd_rand random(static_cast<std::minstd_rand::result_type>(number + 1));
  std::vector<std::uint8_t> bytes(16 + random() % 112);
  for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random() >> 8);
  return bytes;
}

void try_random(std::size_t first, std::size_t count) {
  for (std::size_t i = first; i < first + count; ++i) {
    std::printf("random %zu\n", i);
    std::fflush(stdout);
    const std::vector<std::uint8_t> bytes = random_bytes(i);
    LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 4 && std::string_view(argv[1]) == "--random") {
    try_random(std::stoul(argv[2]), std::stoul(argv[3]));
    return 0;
  }
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
