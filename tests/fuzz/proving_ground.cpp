#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>

#include "engine/io/plc_files.h"
#include "tests/fuzz/prove.h"
#include "tests/fuzz/structured_plc.h"

// Tests the engine on random structured PLCs: `proving_ground FIRST COUNT [FOLDER [SECONDS]]`. It prints the seeds
// that fail. With a folder, it writes their PLCs there, and reduced ones of those whose mesh is wrong.

namespace {

using namespace ccdt;
using namespace ccdt::fuzz;
using Outcome = Proof::Outcome;

ProofOptions options_of(std::uint64_t seed, double seconds) {
  constexpr std::array lattices = {Lattice::fcc, Lattice::bcc, Lattice::sc};
  return {.seconds = seconds, .lattices = {lattices[seed % lattices.size()]}, .refined = seed % 4 == 0};
}

void keep(const std::filesystem::path& folder, std::uint64_t seed, const InputPlc& plc, const ProofOptions& options,
          Outcome outcome) {
  std::filesystem::create_directories(folder);
  io::write_plc(plc, folder / (std::to_string(seed) + ".poly"));
  if (outcome == Outcome::endless) return;  // each step of reducing it would take as long
  const InputPlc least =
      reduce(plc, [&](const InputPlc& smaller) { return prove(smaller, options).outcome == outcome; });
  io::write_plc(least, folder / (std::to_string(seed) + "-reduced.poly"));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3 || argc > 5) {
    std::fputs("usage: proving_ground FIRST COUNT [FOLDER [SECONDS]]\n", stderr);
    return 2;
  }
  const std::uint64_t first = std::strtoull(argv[1], nullptr, 10), count = std::strtoull(argv[2], nullptr, 10);
  std::map<Outcome, std::uint64_t> outcomes;
  std::uint64_t meshes = 0, verified = 0;
  const auto summary = [&](std::uint64_t done) {
    std::printf("%llu PLCs: %llu right, %llu invalid, %llu endless, %llu wrong; %llu meshes, %llu verified\n",
                static_cast<unsigned long long>(done), static_cast<unsigned long long>(outcomes[Outcome::right]),
                static_cast<unsigned long long>(outcomes[Outcome::invalid]),
                static_cast<unsigned long long>(outcomes[Outcome::endless]),
                static_cast<unsigned long long>(outcomes[Outcome::wrong]), static_cast<unsigned long long>(meshes),
                static_cast<unsigned long long>(verified));
    std::fflush(stdout);
  };
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::uint64_t seed = first + i;
    const InputPlc plc = structured_plc(seed);
    const ProofOptions options = options_of(seed, argc == 5 ? std::strtod(argv[4], nullptr) : 20);
    const Proof proof = prove(plc, options);
    ++outcomes[proof.outcome];
    meshes += proof.meshes;
    verified += proof.verified;
    if (proof.outcome == Outcome::endless || proof.outcome == Outcome::wrong) {
      std::printf("seed %llu: %s\n", static_cast<unsigned long long>(seed), proof.what.c_str());
      std::fflush(stdout);
      if (argc > 3) keep(argv[3], seed, plc, options, proof.outcome);
    }
    if ((i + 1) % 1000 == 0) summary(i + 1);
  }
  if (count % 1000 != 0) summary(count);
  return outcomes[Outcome::endless] + outcomes[Outcome::wrong] > 0 ? 1 : 0;
}
