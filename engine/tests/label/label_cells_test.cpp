#include "engine/label/label_cells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <utility>

#include "engine/base/errors.h"
#include "engine/tests/front/front_stages.h"
#include "engine/tests/shared/mesh_test_solids.h"

namespace ccdt {
namespace {

using namespace mesh_test;
using delaunay::no_neighbor;

/// How many cells have a region.
std::size_t labeled(const RawVector<RegionId>& regions) {
  return static_cast<std::size_t>(std::ranges::count_if(regions, [](RegionId r) { return !r.is_none(); }));
}

RawVector<RegionId> label_cells(const Stages& s, const std::vector<front::FrontFace>& open,
                                const std::vector<std::uint32_t>& codes) {
  return label::label_cells(s.plc, s.delaunay, open, codes);
}

std::size_t finite_cells(const delaunay::Delaunay& d) {
  std::size_t count = 0;
  for (std::uint32_t c = 0; c < d.cells.size(); ++c) count += d.is_finite(c);
  return count;
}

/// A bipyramid whose triangle is a facet and a Delaunay face: two regions of one cell each.
plc::InputPlc tall_bipyramid() {
  plc::InputPlc plc;
  plc.inside = plc::InputPlc::Inside::seeds;
  plc.vertices = {{4, 0, 0}, {-2, 3, 0}, {-2, -3, 0}, {0, 0, 8}, {0, 0, -8}};
  for (const auto& [a, b] : {std::array{0u, 1u}, {1u, 2u}, {2u, 0u}}) {
    plc.triangles.push_back({a, b, 3});
    plc.triangles.push_back({b, a, 4});
  }
  plc.triangles.push_back({0, 1, 2});
  return plc;
}

TEST(LabelCells, OfAConvexBodyAreAllItsCells) {
  for (const plc::InputPlc& input : {unit_cube(), gridded_plate(4, 1)}) {
    const Stages s(input);
    ASSERT_EQ(s.undelaunay(), 0u);
    EXPECT_EQ(labeled(label_cells(s, s.advance().open, s.codes)), finite_cells(s.delaunay));
  }
}

TEST(LabelCells, OfTwoRegionsDifferAndTheOutsideHasNone) {
  const Stages s(tall_bipyramid());
  ASSERT_EQ(s.undelaunay(), 0u);
  const front::FrontResult front = s.advance();
  const RawVector<RegionId> region_of_cell = label_cells(s, front.open, s.codes);
  EXPECT_EQ(labeled(region_of_cell), 2u);
  std::set<RegionId> regions;
  for (std::uint32_t c = 0; c < s.delaunay.cells.size(); ++c) {
    EXPECT_EQ(region_of_cell[c].is_none(), !s.delaunay.is_finite(c)) << "cell " << c;
    if (s.delaunay.is_finite(c)) regions.insert(region_of_cell[c]);
  }
  EXPECT_EQ(regions.size(), 2u);
}

TEST(LabelCells, SpreadFromOneFaceAcrossAllFacesThatAreNoWalls) {
  const Stages s(unit_cube());
  const front::FrontResult front = s.advance();
  for (std::size_t i = 0; i < front.open.size(); ++i) {
    // A single face is open. All others are walls that are not open on their inner side, so this is a leak.
    EXPECT_THROW(label_cells(s, {front.open[i]}, s.codes), MeshError) << "face " << i;
  }
}

TEST(LabelCells, DoNotReachWhatTheFrontHasReplaced) {
  const Stages s(tall_bipyramid());
  const front::FrontResult front = s.advance();
  ASSERT_EQ(front.open.size(), 8u);  // three sides and the triangle, of both cells
  const std::vector<std::uint32_t> none(s.codes.size(), no_neighbor);
  for (std::size_t i = 0; i < front.open.size(); ++i) {
    std::vector<front::FrontFace> open = front.open;
    open.erase(open.begin() + static_cast<std::ptrdiff_t>(i));
    EXPECT_THROW(label_cells(s, open, s.codes), MeshError) << "without face " << i;
    EXPECT_THROW(label_cells(s, open, none), MeshError) << "without face " << i << ", which is of the front alone";
  }
}

TEST(LabelCells, OfTwoRegionsMayNotMeet) {
  const Stages s(tall_bipyramid());
  const front::FrontResult front = s.advance();
  for (std::size_t i = 0; i < front.open.size(); ++i) {
    std::vector<front::FrontFace> open = front.open;
    open[i].region = RegionId(3 - open[i].region);  // those of the two cells are 1 and 2
    EXPECT_THROW(label_cells(s, open, s.codes), MeshError) << "face " << i;
  }
}

TEST(LabelCells, MayNotReachTheOutside) {
  const Stages s(unit_cube());
  const front::FrontResult front = s.advance();
  for (std::size_t i = 0; i < s.codes.size(); ++i) {
    std::vector<std::uint32_t> codes = s.codes;
    const std::uint32_t code = std::exchange(codes[i], no_neighbor);
    std::vector<front::FrontFace> open = front.open;
    std::erase_if(open, [&](const front::FrontFace& f) { return f.code == code || f.code == s.delaunay.across(code); });
    ASSERT_EQ(open.size(), front.open.size() - 1);
    EXPECT_THROW(label_cells(s, open, codes), MeshError) << "without the wall " << i;
  }
}

TEST(LabelCells, MayNotReachTheOutsideWhereNoWallIsNearEither) {
  const Stages s(cube_within_cube());
  ASSERT_EQ(s.undelaunay(), 0u);
  const auto is_of_hull = [&](std::uint32_t code) {
    return s.delaunay.is_ghost(delaunay::cell_of(code)) ||
           s.delaunay.is_ghost(delaunay::cell_of(s.delaunay.across(code)));
  };
  std::vector<front::FrontFace> open = s.advance().open;
  std::erase_if(open, [&](const front::FrontFace& f) { return is_of_hull(f.code); });
  std::vector<std::uint32_t> codes = s.codes;
  std::erase_if(codes, is_of_hull);
  ASSERT_EQ(codes.size(), 12u);  // those of the inner cube
  EXPECT_THROW(label_cells(s, open, codes), MeshError);
}

/// A face of the front need not be one of the PLC: it is a wall on both sides all the same.
TEST(LabelCells, StopAtFacesOfTheFront) {
  const Stages s(tall_bipyramid());
  const front::FrontResult front = s.advance();
  const std::vector<std::uint32_t> none(s.codes.size(), no_neighbor);
  EXPECT_EQ(labeled(label_cells(s, front.open, none)), 2u);
  // The upper cell alone: its faces are walls for the lower one, too.
  std::vector<front::FrontFace> upper = front.open;
  const RegionId region = upper[0].region;
  std::erase_if(upper, [&](const front::FrontFace& f) { return f.region != region; });
  EXPECT_EQ(labeled(label_cells(s, upper, none)), 1u);
}

}  // namespace
}  // namespace ccdt
