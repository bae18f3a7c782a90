#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/io/plc_files.h"
#include "engine/tests/shared/plc_test_solids.h"
#include "engine/tests/shared/real_parts.h"

namespace ccdt {
namespace {

using namespace plc_test;

double surface_volume(const plc::InputPlc& input) {
  double sixfold = 0;
  for (const auto& [a, b, c] : input.triangles)
    sixfold += dot(input.vertices[a], cross(input.vertices[b], input.vertices[c]));
  return sixfold / 6;
}

TEST(PlcParts, RealSurfacesAreValidAndKeepTheirVolume) {
  const auto files = real_parts();
  if (files.empty()) GTEST_SKIP() << "no parts here; CCDT_PARTS names their folder";
  for (const auto& file : files) {
    SCOPED_TRACE(file.filename().string());
    const plc::InputPlc input = io::read_plc(file);
    const plc::Plc plc = plc::build_plc(input);
    EXPECT_EQ(plc.triangles.size(), input.triangles.size());
    EXPECT_EQ(plc.vertices.size(), input.vertices.size());
    EXPECT_GE(inside_count(plc), 1u);
    // These surfaces are oriented outward, and their components are not nested.
    EXPECT_NEAR(inside_volume(plc), surface_volume(input), 1e-6 * std::abs(surface_volume(input)));
    EXPECT_LT(grazeable_count(plc), plc.segments.size());
    for (const plc::Facet& f : plc.facets) EXPECT_NE(plc.regions[f.above].inside, plc.regions[f.below].inside);
  }
}

}  // namespace
}  // namespace ccdt
