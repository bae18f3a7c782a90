#include "bench/fingerprint.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstdio>

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
  Sum vertices, tetrahedra;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) vertices.add(hash_of(v, mesh.vertices[v]));
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) tetrahedra.add(hash_of(mesh.tetrahedra[t], mesh.regions[t]));
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
