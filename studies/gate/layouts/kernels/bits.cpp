// A checksum, and functions that count and reverse bits.

#include <benchmark/benchmark.h>

#include <array>
#include <bit>
#include <vector>

#include "studies/gate/layouts/kernels/work.h"

namespace kernels {
namespace {

constexpr std::array<std::uint32_t, 256> make_table() {
  std::array<std::uint32_t, 256> table = {};
  for (std::uint32_t i = 0; i < table.size(); ++i) {
    std::uint32_t crc = i;
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ (crc & 1 ? 0xedb88320U : 0);
    table[i] = crc;
  }
  return table;
}

constexpr std::array<std::uint32_t, 256> table = make_table();

std::uint64_t reversed(std::uint64_t x) {
  x = ((x >> 1) & 0x5555555555555555) | ((x & 0x5555555555555555) << 1);
  x = ((x >> 2) & 0x3333333333333333) | ((x & 0x3333333333333333) << 2);
  x = ((x >> 4) & 0x0f0f0f0f0f0f0f0f) | ((x & 0x0f0f0f0f0f0f0f0f) << 4);
  return __builtin_bswap64(x);
}

[[gnu::noinline]] std::uint64_t mix(const std::vector<std::uint64_t>& words) {
  std::uint32_t crc = ~0U;
  std::uint64_t turned = 0;
  for (std::uint64_t word : words) {
    turned ^= reversed(word) + static_cast<std::uint64_t>(std::popcount(word ^ turned));
    for (int byte = 0; byte < 8; ++byte, word >>= 8) crc = (crc >> 8) ^ table[(crc ^ word) & 0xff];
  }
  return turned ^ crc;
}

void bits(benchmark::State& state) {
  Random random(10);
  std::vector<std::uint64_t> words(10);
  for (std::uint64_t& word : words) word = random();
  const int passes = passes_of("bits");
  for (auto _ : state)
    for (int pass = 0; pass < passes; ++pass) benchmark::DoNotOptimize(mix(words));
}
BENCHMARK(bits);

}  // namespace
}  // namespace kernels
