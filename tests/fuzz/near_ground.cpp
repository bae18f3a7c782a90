#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "engine/io/plc_files.h"
#include "tests/fuzz/near_duplicates.h"
#include "tests/fuzz/one_meaning.h"
#include "tests/fuzz/prove.h"

// Compares what check, mesh, verify and repair make of random inputs with near duplicates: `near_ground FIRST COUNT
// [FOLDER]`. It prints the seeds about which they disagree. With a folder, it writes reduced inputs there.

namespace {

using namespace ccdt;
using namespace ccdt::fuzz;

void keep(const std::filesystem::path& folder, std::uint64_t seed, const InputPlc& input) {
  std::filesystem::create_directories(folder);
  const bool about_copy = find_meaning(input).disagreement.empty();
  const auto disagrees = [&](const InputPlc& smaller) {
    const Meaning meaning = find_meaning(smaller);
    return !(about_copy ? meaning.about_copy : meaning.disagreement).empty();
  };
  io::write_plc(reduce(input, disagrees), folder / (std::to_string(seed) + ".poly"));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3 || argc > 4) {
    std::fputs("usage: near_ground FIRST COUNT [FOLDER]\n", stderr);
    return 2;
  }
  const std::uint64_t first = std::strtoull(argv[1], nullptr, 10), count = std::strtoull(argv[2], nullptr, 10);
  std::uint64_t valid = 0, repaired = 0, refused = 0, disagreements = 0, of_copies = 0;
  for (std::uint64_t i = 0; i < count; ++i) {
    const InputPlc input = near_duplicates(first + i);
    const Meaning meaning = find_meaning(input);
    valid += meaning.is_valid;
    repaired += !meaning.is_valid && meaning.is_copy_valid;
    refused += meaning.is_refused;
    disagreements += !meaning.disagreement.empty();
    of_copies += !meaning.about_copy.empty();
    const std::string& what = meaning.disagreement.empty() ? meaning.about_copy : meaning.disagreement;
    if (!what.empty()) {
      std::printf("seed %llu: %s\n", static_cast<unsigned long long>(first + i), what.c_str());
      if (argc > 3) keep(argv[3], first + i, input);
    }
    if ((i + 1) % 1000 == 0 || i + 1 == count)
      std::printf("%llu inputs: %llu valid, %llu repaired, %llu refused; %llu disagreements, %llu about copies\n",
                  static_cast<unsigned long long>(i + 1), static_cast<unsigned long long>(valid),
                  static_cast<unsigned long long>(repaired), static_cast<unsigned long long>(refused),
                  static_cast<unsigned long long>(disagreements), static_cast<unsigned long long>(of_copies));
    std::fflush(stdout);
  }
  return disagreements > 0 ? 1 : 0;
}
