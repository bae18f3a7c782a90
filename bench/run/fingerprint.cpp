#include "bench/run/fingerprint.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstdio>

#include "engine/base/parallel.h"

namespace ccdt::bench {
namespace {

/// The final bijection of SplitMix64 (Steele, Lea and Flood 2014): each bit of the result depends on all bits.
constexpr std::uint64_t mix(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9U;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebU;
  return x ^ (x >> 31);
}

/// Two 64-bit hashes of a sequence of words, which combine words differently.
struct Hash {
  std::uint64_t a = 0x9e3779b97f4a7c15U, b = 0xd1b54a32d192ed03U;

  void add(std::uint64_t word) {
    a = mix(a ^ word) + 0x9e3779b97f4a7c15U;
    b = mix(b + word) ^ 0xd1b54a32d192ed03U;
  }
};

/// A sum of hashes does not depend on their order.
struct Sum {
  std::uint64_t a = 0, b = 0;

  void add(const Hash& hash) {
    a += hash.a;
    b += hash.b;
  }
};

/// The sum of the hashes that `hash(i)` gives for each i below `count`.
template <class HashOf>
Sum sum_of(std::size_t count, const HashOf& hash) {
  constexpr std::size_t chunk_length = 16384;
  const auto parts = parallel_chunks(count, chunk_length, [&](std::size_t i, std::size_t end) {
    Sum sum;
    for (; i < end; ++i) sum.add(hash(i));
    return sum;
  });
  Sum all;
  for (const Sum& part : parts) all.add({part.a, part.b});
  return all;
}

/// The two zeros are equal.
std::uint64_t bits_of(double coordinate) {
  return std::bit_cast<std::uint64_t>(coordinate + 0.0);
}

Hash hash_of(std::array<std::uint32_t, 4> corners, int region) {
  std::ranges::sort(corners);
  Hash hash;
  hash.add(corners[0] | std::uint64_t{corners[1]} << 32);
  hash.add(corners[2] | std::uint64_t{corners[3]} << 32);
  hash.add(static_cast<std::uint32_t>(region));
  return hash;
}

Hash hash_of(std::uint64_t number, const Point3& p) {
  Hash hash;
  for (const std::uint64_t word : {number, bits_of(p.x), bits_of(p.y), bits_of(p.z)}) hash.add(word);
  return hash;
}

}  // namespace

std::string fingerprint(const mesh::TetMesh& mesh) {
  const Sum vertices = sum_of(mesh.vertices.size(), [&](std::size_t v) { return hash_of(v, mesh.vertices[v]); });
  const Sum tetrahedra =
      sum_of(mesh.tetrahedra.size(), [&](std::size_t t) { return hash_of(mesh.tetrahedra[t], mesh.regions[t]); });
  Hash all;
  for (const std::uint64_t word : {std::uint64_t{mesh.vertices.size()}, std::uint64_t{mesh.tetrahedra.size()},
                                   vertices.a, vertices.b, tetrahedra.a, tetrahedra.b})
    all.add(word);
  std::array<char, 33> text{};
  std::snprintf(text.data(), text.size(), "%016llx%016llx", static_cast<unsigned long long>(all.a),
                static_cast<unsigned long long>(all.b));
  return text.data();
}

}  // namespace ccdt::bench
