#include <cmath>
#include <cstdint>

#include "models/parts.h"

namespace ccdt::models {
namespace {

/// A pseudorandom number from 0 to 1 for each index (SplitMix64; Steele, Lea and Flood 2014).
double scattered(std::uint64_t index) {
  std::uint64_t z = (index + 1) * 0x9e3779b97f4a7c15;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
  z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
  return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

}  // namespace

plc::InputPlc make_rough_sphere(double edge_length) {
  plc::InputPlc input = make_sphere(edge_length);
  // Each ray from the center still meets the surface once, so even a very rough surface does not cross itself.
  for (std::size_t i = 0; i < input.vertices.size(); ++i)
    input.vertices[i] = std::exp(rough_sphere_range * edge_length * (scattered(i) - 0.5)) * input.vertices[i];
  return input;
}

}  // namespace ccdt::models
