#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "engine/io/read_plc.h"
#include "engine/tests/plc_test_solids.h"

namespace ccdt {
namespace {

using namespace plc_test;

/// Real surfaces, where there are any: the folder of the variable CCDT_PARTS, or one beside the checkout.
std::vector<std::filesystem::path> parts() {
  const char* told = std::getenv("CCDT_PARTS");
  const std::filesystem::path folder =
      told ? std::filesystem::path(told) : std::filesystem::path(CCDT_SOURCE_DIR) / ".." / "shared" / "parts";
  std::vector<std::filesystem::path> files;
  if (!std::filesystem::is_directory(folder)) return files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".off") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

double surface_volume(const InputPlc& input) {
  double sixfold = 0;
  for (const auto& [a, b, c] : input.triangles)
    sixfold += dot(input.vertices[a], cross(input.vertices[b], input.vertices[c]));
  return sixfold / 6;
}

TEST(PlcParts, RealSurfacesAreValidAndKeepTheirVolume) {
  const auto files = parts();
  if (files.empty()) GTEST_SKIP() << "no parts here; CCDT_PARTS names their folder";
  for (const auto& file : files) {
    SCOPED_TRACE(file.filename().string());
    const InputPlc input = read_plc(file);
    const Plc plc = build_plc(input);
    std::size_t triangles = 0;
    for (const Facet& f : plc.facets) triangles += f.triangles.size();
    EXPECT_EQ(triangles, input.triangles.size());
    EXPECT_EQ(plc.vertices.size(), input.vertices.size());
    EXPECT_GE(inside_count(plc), 1u);
    // These surfaces are oriented outwards, and their components are not nested.
    EXPECT_NEAR(inside_volume(plc), surface_volume(input), 1e-6 * std::abs(surface_volume(input)));
    EXPECT_LT(grazeable_count(plc), plc.segments.size());
    for (const Facet& f : plc.facets) EXPECT_NE(plc.chambers[f.above].inside, plc.chambers[f.below].inside);
  }
}

}  // namespace
}  // namespace ccdt
