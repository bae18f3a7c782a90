#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>

#include "engine/base/union_find.h"
#include "engine/tests/shared/plc_test_solids.h"

namespace ccdt {
namespace {

using namespace plc_test;

/// Small cubes with random labels. The facets are where labels differ, so there are edges and vertices of every kind,
/// and everything about segments and regions can be counted from the labels.
struct Voxels {
  int n;
  std::vector<int> labels;  // of cubes; all beyond them have label 0

  int label(int x, int y, int z) const {
    return x < 0 || y < 0 || z < 0 || x >= n || y >= n || z >= n ? 0 : labels[(z * n + y) * n + x];
  }
  int label(const std::array<int, 3>& c) const { return label(c[0], c[1], c[2]); }
};

Voxels random_voxels(int n, int kinds, std::mt19937& random) {
  Voxels voxels{n, std::vector<int>(n * n * n)};
  for (int& label : voxels.labels) label = static_cast<int>(random() % kinds);
  voxels.labels[0] = 1;  // so that not all labels are 0
  return voxels;
}

plc::InputPlc surface_of(const Voxels& voxels, std::mt19937& random) {
  plc::InputPlc plc;
  plc.name = "voxels";
  plc.inside = plc::InputPlc::Inside::seeds;
  const int m = voxels.n + 1;
  for (int i = 0; i < m * m * m; ++i) plc.vertices.push_back({double(i % m), double(i / m % m), double(i / m / m)});
  const auto vertex = [&](const std::array<int, 3>& p) { return std::uint32_t((p[2] * m + p[1]) * m + p[0]); };
  for (int axis = 0; axis < 3; ++axis)
    for (int i = 0; i < m * m * m; ++i) {
      const std::array<int, 3> here = {i % m, i / m % m, i / m / m};
      std::array<int, 3> before = here, u = here, v = here, w = here;
      --before[axis];
      ++u[(axis + 1) % 3];
      ++v[(axis + 2) % 3];
      ++w[(axis + 1) % 3];
      ++w[(axis + 2) % 3];
      if (voxels.label(here) == voxels.label(before)) continue;
      std::vector<std::uint32_t> square = {vertex(here), vertex(u), vertex(w), vertex(v)};
      std::rotate(square.begin(), square.begin() + random() % 4, square.end());
      if (random() % 2) std::reverse(square.begin(), square.end());
      append_fan(plc, square);
    }
  return plc;
}

/// The volumes of the regions of equal labels that do not reach the outside.
struct Regions {
  std::vector<double> volumes;  // sorted
  std::vector<bool> inside;     // of each voxel
};

Regions expected_regions(const Voxels& voxels) {
  const int n = voxels.n, outside = n * n * n;
  UnionFind sets(outside + 1);
  const auto index = [&](int x, int y, int z) {
    return x < 0 || y < 0 || z < 0 || x >= n || y >= n || z >= n ? outside : (z * n + y) * n + x;
  };
  for (int z = -1; z < n; ++z)
    for (int y = -1; y < n; ++y)
      for (int x = -1; x < n; ++x)
        for (const auto& [dx, dy, dz] : {std::array{1, 0, 0}, {0, 1, 0}, {0, 0, 1}})
          if (voxels.label(x, y, z) == voxels.label(x + dx, y + dy, z + dz))
            sets.join(index(x, y, z), index(x + dx, y + dy, z + dz));
  std::map<std::uint32_t, double> volumes;
  Regions regions;
  for (int i = 0; i < outside; ++i) {
    regions.inside.push_back(sets.find(i) != sets.find(outside));
    if (regions.inside.back()) volumes[sets.find(i)] += 1;
  }
  for (const auto& [root, volume] : volumes) regions.volumes.push_back(volume);
  std::sort(regions.volumes.begin(), regions.volumes.end());
  return regions;
}

struct Segments {
  std::size_t all = 0, grazeable = 0;
  std::size_t with_270 = 0;  // grazeable, and by more than 180 degrees
};

/// Around an edge are four voxels. It is a segment if any two neighbors differ, except where just two opposite facets
/// meet: those are one facet.
Segments expected_segments(const Voxels& voxels, const std::vector<bool>& is_inside) {
  const Voxels inside{voxels.n, {is_inside.begin(), is_inside.end()}};
  Segments count;
  const int m = voxels.n + 1;
  for (int axis = 0; axis < 3; ++axis)
    for (int i = 0; i < m * m * m; ++i) {
      const std::array<int, 3> here = {i % m, i / m % m, i / m / m};
      if (here[axis] == voxels.n) continue;
      std::array<std::array<int, 3>, 4> around;
      around.fill(here);
      for (int k : {1, 2}) --around[k][(axis + 1) % 3];
      for (int k : {2, 3}) --around[k][(axis + 2) % 3];
      std::array<bool, 4> facet;  // between voxel k and k + 1
      int facets = 0;
      for (int k = 0; k < 4; ++k) {
        facet[k] = voxels.label(around[k]) != voxels.label(around[(k + 1) % 4]);
        facets += facet[k];
      }
      if (facets == 0 || (facets == 2 && facet[0] == facet[2])) continue;
      ++count.all;
      bool grazeable = false, with_270 = false;
      for (int k = 0; k < 4; ++k) {
        const bool two_quarters = !facet[k] && inside.label(around[k]) != 0;
        grazeable = grazeable || two_quarters;
        with_270 = with_270 || (two_quarters && !facet[(k + 1) % 4]);
      }
      count.grazeable += grazeable;
      count.with_270 += with_270;
    }
  return count;
}

TEST(PlcVoxels, RegionsAndSegmentsAreThoseThatTheLabelsGive) {
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  for (int round = 0; round < 60; ++round) {
    const Voxels voxels = random_voxels(2 + round % 4, 2 + round % 3, random);
    const plc::InputPlc input = surface_of(voxels, random);
    const bool turn = round % 2;
    const plc::Plc plc = plc::build_plc(
        turn ? rotated(rotation(normal(random), normal(random), normal(random), normal(random)), input) : input);

    std::vector<double> volumes;
    for (std::uint32_t c = 1; c < plc.regions.size(); ++c) volumes.push_back(volume(plc, c));
    std::sort(volumes.begin(), volumes.end());
    const Regions expected = expected_regions(voxels);
    ASSERT_EQ(volumes.size(), expected.volumes.size()) << "round " << round;
    for (std::size_t i = 0; i < volumes.size(); ++i) EXPECT_NEAR(volumes[i], expected.volumes[i], 1e-6);

    const Segments segments = expected_segments(voxels, expected.inside);
    EXPECT_EQ(plc.segments.size(), segments.all) << "round " << round;
    if (!turn) {
      EXPECT_EQ(grazeable_count(plc), segments.grazeable) << "round " << round;
    }
    // After rotation, 180 degrees become a little more or less, and both are right.
    EXPECT_GE(grazeable_count(plc), segments.with_270) << "round " << round;
    EXPECT_LE(grazeable_count(plc), segments.grazeable) << "round " << round;
  }
}

}  // namespace
}  // namespace ccdt
