#include "tests/fuzz/structured_plc.h"

#include <cmath>

namespace ccdt::fuzz {

namespace {

constexpr std::array bodies = {box_body,  box_body,   voxel_body,  voxel_body,    hollow_body,
                               comb_body, screw_body, plates_body, bipyramid_body};
constexpr std::array things = {
    loose_rectangle, loose_triangle,   fan, bundle_of_segments, comb, screw, stacked_plates, star_of_segments,
    loose_vertices,  chain_of_segments};

using Matrix = std::array<std::array<double, 3>, 3>;

/// From a quaternion of whole numbers: no functions whose last bits differ between machines.
Matrix random_turn(Random& random) {
  std::array<double, 4> q{};
  double squared = 0;
  while (squared == 0) {
    squared = 0;
    for (double& part : q) {
      part = static_cast<double>(random.between(-9, 9));
      squared += part * part;
    }
  }
  const auto [w, x, y, z] = q;
  const double s = 1 / squared;
  return {{{s * (w * w + x * x - y * y - z * z), s * 2 * (x * y - w * z), s * 2 * (x * z + w * y)},
           {s * 2 * (x * y + w * z), s * (w * w - x * x + y * y - z * z), s * 2 * (y * z - w * x)},
           {s * 2 * (x * z - w * y), s * 2 * (y * z + w * x), s * (w * w - x * x - y * y + z * z)}}};
}

Matrix random_squeeze(Random& random) {
  Matrix m{};
  for (int axis = 0; axis < 3; ++axis) m[axis][axis] = std::ldexp(1, -static_cast<int>(random.between(0, 8)));
  return m;
}

void transform(const Matrix& m, plc::InputPlc& plc) {
  const auto move = [&](Point3& p) {
    const auto row = [&](int i) { return m[i][0] * p.x + m[i][1] * p.y + m[i][2] * p.z; };
    p = {row(0), row(1), row(2)};
  };
  for (Point3& p : plc.vertices) move(p);
  for (Point3& p : plc.holes) move(p);
  for (auto& region : plc.regions) move(region.seed);
}

/// Moves coordinates a little, so that facets are flat only within the tolerance.
void roughen(Random& random, plc::InputPlc& plc) {
  const double largest = std::ldexp(16, -static_cast<int>(random.between(28, 34)));
  for (Point3& p : plc.vertices)
    for (double* x : {&p.x, &p.y, &p.z}) *x += largest * static_cast<double>(random.between(-1000, 1000)) / 1000;
}

}  // namespace

plc::InputPlc structured_plc(std::uint64_t seed) {
  Random random(seed);
  plc::InputPlc plc = structured_plc(random);
  plc.name = "structured " + std::to_string(seed);
  return plc;
}

plc::InputPlc structured_plc(Random& random) {
  Scene scene(random);
  if (!scene.add(bodies[random.below(bodies.size())])) scene.add(box_body);
  const std::uint64_t tries = scene.chance(3) ? 0 : random.below(7);
  for (std::uint64_t i = 0; i < tries; ++i) scene.add(things[random.below(things.size())]);
  plc::InputPlc plc = scene.plc();
  if (scene.chance(4)) transform(random_squeeze(random), plc);
  if (tries > 0) return plc;
  if (scene.chance(2)) transform(random_turn(random), plc);
  if (scene.chance(2)) roughen(random, plc);
  return plc;
}

}  // namespace ccdt::fuzz
