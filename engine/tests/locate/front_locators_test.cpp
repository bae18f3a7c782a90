#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "engine/io/plc_files.h"
#include "engine/locate/cavity_locator.h"
#include "engine/tests/front/front_stages.h"
#include "engine/tests/shared/mesh_test_solids.h"
#include "engine/tests/shared/real_parts.h"
#include "engine/tests/shared/sanitized.h"
#include "models/solids.h"

// The front makes the same tetrahedra with every locator and both tests of visibility, with and without the check.

namespace ccdt {
namespace {

using namespace mesh_test;

void expect_same_tetrahedra(const Stages& stages) {
  const front::FrontResult checked = stages.advance({locate::LocatorKind::grid}),
                           all = stages.advance_all({locate::LocatorKind::grid});
  for (const front::FrontOptions& locator :
       {front::FrontOptions{locate::LocatorKind::grid, 0.5}, front::FrontOptions{locate::LocatorKind::grid, 2},
        front::FrontOptions{locate::LocatorKind::octree}, front::FrontOptions{locate::LocatorKind::cavity},
        front::FrontOptions{.locator = locate::LocatorKind::cavity, .small_chamber = 0},
        front::FrontOptions{.locator = locate::LocatorKind::grid, .visibility = front::Visibility::faces},
        front::FrontOptions{.locator = locate::LocatorKind::octree, .visibility = front::Visibility::faces},
        front::FrontOptions{.locator = locate::LocatorKind::cavity, .visibility = front::Visibility::faces}}) {
    SCOPED_TRACE("locator " + std::to_string(static_cast<int>(locator.locator)) + ", visibility " +
                 std::to_string(static_cast<int>(locator.visibility)));
    const front::FrontResult other = stages.advance(locator), all_by_other = stages.advance_all(locator);
    EXPECT_EQ(sorted(checked.tetrahedra), sorted(other.tetrahedra));
    EXPECT_EQ(sorted(all.tetrahedra), sorted(all_by_other.tetrahedra));
    EXPECT_EQ(checked.undelaunay_faces, other.undelaunay_faces);
    EXPECT_EQ(checked.open.size(), other.open.size());
    EXPECT_TRUE(all_by_other.open.empty());
  }
}

void expect_same_tetrahedra(const plc::InputPlc& input) {
  expect_same_tetrahedra(Stages(input));
}

TEST(FrontLocators, AgreeOnSmallInputs) {
  for (const plc::InputPlc& input :
       {unit_cube(), l_shape(), plc_test::schoenhardt(), cube_with_cubic_hole(), cube_within_cube(), two_cubes(),
        two_cubes_as_surface(), cube_with_slit(), cube_with_dangling_facet(), cube_with_dangling_segment(),
        cube_with_floating_segment(), cube_with_turnstile(), two_bars()})
    for (const plc::InputPlc& plc : {input, rotated(oblique, input)}) expect_same_tetrahedra(plc);
}

TEST(FrontLocators, AgreeOnModels) {
  for (const char* name : {"piston", "bracket", "stepping-pole"})
    for (const double edge_length : {7.0, 11.0}) {
      SCOPED_TRACE(name);
      expect_same_tetrahedra(rotated(oblique, models::make_solid(name, edge_length)));
    }
}

TEST(FrontLocators, AgreeOnRandomVoxelsInPerspective) {
  std::mt19937 random(1);
  for (int i = 0; i < 20; ++i) {
    SCOPED_TRACE(i);
    const int n = 2 + i % 3;
    const plc::InputPlc plc = in_perspective(random_voxels(n, 2 + i % 2, random), n);
    expect_same_tetrahedra(plc);
    expect_same_tetrahedra(rotated(random_rotation(random), plc));
  }
}

TEST(FrontLocators, AgreeOnRandomRoughSurfaces) {
  std::mt19937 random(2);
  std::size_t undelaunay = 0;
  for (int i = 0; i < 20; ++i) {
    SCOPED_TRACE(i);
    const Stages stages(roughened(models::make_solid("sphere", i % 3 == 0 ? 0.35 : 0.7), i % 2 ? 0.6 : 0.2, random));
    undelaunay += stages.undelaunay();
    expect_same_tetrahedra(stages);
  }
  EXPECT_GT(undelaunay, 100u);
}

TEST(FrontLocators, AgreeOnRandomlyTwistedPrismsAndThinPlates) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> turn(-0.95, 0.3), height(0.05, 3);
  for (std::uint32_t i = 0; i < 20; ++i) {
    SCOPED_TRACE(i);
    const double t = turn(random), h = height(random);
    expect_same_tetrahedra(rotated(random_rotation(random), twisted_prism(3 + i % 6, t, h)));
  }
  for (const double thickness : {0.1, 0.001}) expect_same_tetrahedra(rotated(oblique, gridded_plate(5, thickness)));
}

TEST(FrontLocators, AgreeOnRealParts) {
  if (!there_are_parts()) GTEST_SKIP() << "no parts here; CCDT_PARTS names their folder";
  for (const std::string name : {"joint.off", "anchor.off", "fandisk.off"}) {
    if (is_sanitized && name == "fandisk.off") continue;
    SCOPED_TRACE(name);
    const Stages stages(io::read_plc(folder_of_parts() / name));
    EXPECT_GT(stages.undelaunay(), 0u);
    expect_same_tetrahedra(stages);
  }
}

/// Weights of a point in a cell, times the cell's sixfold volume, in floating point.
std::array<double, 4> weights(const std::array<Point3, 4>& cell, const Point3& p) {
  const auto volume = [](const Point3& a, const Point3& b, const Point3& c, const Point3& d) {
    return dot(cross(b - a, c - a), d - a);
  };
  const auto& [a, b, c, d] = cell;
  return {volume(p, b, c, d), volume(a, p, c, d), volume(a, b, p, d), volume(a, b, c, p)};
}

/// Brute force: where random points of the missing faces are.
void expect_cells_of_missing_faces(const Stages& stages, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> part(0, 1);
  const delaunay::Delaunay& d = stages.delaunay;
  const locate::CavityLocator locator(stages.plc, stages.facets, stages.codes, d);
  std::size_t inside = 0;
  for (std::uint32_t f = 0; f < stages.codes.size(); ++f) {
    const std::uint32_t cavity = locator.cavity_of_triangle(f);
    EXPECT_EQ(cavity == none, stages.codes[f] != delaunay::no_neighbor);
    if (cavity == none) continue;
    const auto& t = stages.facets.triangles[f];
    const double s = part(random), r = part(random) * (1 - s);
    const Point3 p = s * d.point(t[0]) + r * d.point(t[1]) + (1 - s - r) * d.point(t[2]);
    for (std::uint32_t cell = 0; cell < d.cells.size(); ++cell) {
      if (!d.is_finite(cell)) continue;
      const auto& v = d.cells[cell].vertices;
      const auto w = weights({d.point(v[0]), d.point(v[1]), d.point(v[2]), d.point(v[3])}, p);
      const double sum = w[0] + w[1] + w[2] + w[3];
      if (std::any_of(w.begin(), w.end(), [&](double x) { return x < 1e-6 * sum; })) continue;
      EXPECT_EQ(locator.cavity_of_cell(cell), cavity);
      ++inside;
    }
  }
  EXPECT_GT(inside, 0u);
}

TEST(CavityLocator, HasTheCellsThatMissingFacesGoThrough) {
  expect_cells_of_missing_faces(Stages(two_bars()), 1);
  std::mt19937 random(4);
  for (unsigned i = 0; i < 5; ++i)
    expect_cells_of_missing_faces(Stages(roughened(models::make_solid("sphere", 0.35), 0.2, random)), i);
}

TEST(CavityLocator, HasNoCavityWhereNothingIsMissing) {
  const Stages cube(unit_cube());
  const locate::CavityLocator locator(cube.plc, cube.facets, cube.codes, cube.delaunay);
  EXPECT_EQ(locator.cavity_count(), 0u);
  EXPECT_TRUE(locator.triangles().empty());
}

TEST(CavityLocator, LooksForFacesWhoseCodesAreNotTold) {
  const Stages bars(two_bars());
  const locate::CavityLocator told(bars.plc, bars.facets, bars.codes, bars.delaunay);
  const locate::CavityLocator untold(
      bars.plc, bars.facets, std::vector<std::uint32_t>(bars.codes.size(), delaunay::no_neighbor), bars.delaunay);
  EXPECT_GT(told.cavity_count(), 0u);
  EXPECT_EQ(told.cavity_count(), untold.cavity_count());
  EXPECT_EQ(told.triangles(), untold.triangles());
  for (std::uint32_t cell = 0; cell < bars.delaunay.cells.size(); ++cell)
    EXPECT_EQ(told.cavity_of_cell(cell), untold.cavity_of_cell(cell));
}

}  // namespace
}  // namespace ccdt
