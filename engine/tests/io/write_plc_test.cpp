#include <sys/resource.h>

#include <csignal>

#include "engine/tests/io/io_test_files.h"

namespace ccdt {
namespace {

using namespace io_test;

plc::InputPlc written_and_read(const plc::InputPlc& plc, const std::string& name) {
  const Folder folder;
  io::write_plc(plc, folder / name);
  EXPECT_EQ(folder.files(), 1u);
  return io::read_plc(folder / name);
}

/// \param why  for people
void expect_not_writable(const plc::InputPlc& plc, const std::string& name, std::string_view why) {
  const Folder folder;
  try {
    io::write_plc(plc, folder / name);
    ADD_FAILURE() << name << ": not refused: " << why;
  } catch (const OutputError& error) {
    EXPECT_FALSE(error.remedy().empty()) << why;
  }
  EXPECT_EQ(folder.files(), 0u) << name;
}

TEST(WritePlc, PolyKeepsEverything) {
  expect_same_plc(written_and_read(rich_plc(), "a.poly"), rich_plc());
}

TEST(WritePlc, SmeshKeepsAllButHolesInFacets) {
  plc::InputPlc plc = rich_plc();
  plc.polygon_facets[0].polygons.resize(1);
  plc.polygon_facets[0].holes.clear();
  expect_same_plc(written_and_read(plc, "a.smesh"), plc);
}

TEST(WritePlc, MeditKeepsMarkersAndSegments) {
  plc::InputPlc plc = awkward_surface();
  plc.inside = plc::InputPlc::Inside::seeds;
  plc.triangle_markers = {5, -7, 0};
  plc.polygon_facets[0].marker = 9;
  plc.segments = {{0, 4}, {1, 3}};
  plc.segment_markers = {0, 3};
  // Medit has a list of triangles and one of quadrilaterals, so the facets get other numbers.
  plc.triangle_numbers.clear();
  plc::InputPlc expected = plc;
  expected.polygon_facets[0].number = 3;
  plc.polygon_facets[0].number = 1;
  expect_same_plc(written_and_read(plc, "a.mesh"), expected);
  expect_same_plc(written_and_read(plc, "a.meshb"), expected);
}

TEST(WritePlc, FormatsWithSeedsKeepTheEvenOddRule) {
  for (const char* name : {"a.poly", "a.smesh"})
    expect_same_plc(written_and_read(awkward_surface(), name), awkward_surface());
  for (const char* name : {"a.mesh", "a.meshb"})
    EXPECT_EQ(written_and_read(awkward_surface(), name).inside, plc::InputPlc::Inside::even_odd);
}

TEST(WritePlc, SurfaceFormatsKeepEveryBitAndTheOrderOfFacets) {
  for (const char* name : {"a.off", "a.obj", "a.ply", "A.OFF"}) {
    SCOPED_TRACE(name);
    expect_same_plc(written_and_read(awkward_surface(), name), awkward_surface());
  }
}

TEST(WritePlc, ObjAndPlyKeepMarkers) {
  plc::InputPlc plc = awkward_surface();
  plc.triangle_markers = {5, -7, 0};
  plc.polygon_facets[0].marker = 2000000000;
  for (const char* name : {"a.obj", "a.ply"}) {
    SCOPED_TRACE(name);
    expect_same_plc(written_and_read(plc, name), plc);
  }
}

TEST(WritePlc, PlyHoldsFacetsOfManyCorners) {
  plc::InputPlc plc;
  std::vector<std::uint32_t> corners;
  for (std::uint32_t i = 0; i < 300; ++i) {
    plc.vertices.push_back({std::cos(i), std::sin(i), 0});
    corners.push_back(i);
  }
  plc.polygon_facets.push_back({{corners}, {}, 0, 0});
  expect_same_plc(written_and_read(plc, "a.ply"), plc);
}

TEST(WritePlc, StlRoundsToSinglePrecision) {
  plc::InputPlc plc;
  plc.vertices = {{0.1, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  plc.triangles = {{0, 1, 2}, {3, 1, 0}};
  const plc::InputPlc read = written_and_read(plc, "a.stl");
  EXPECT_EQ(read.vertices.size(), 4u);
  EXPECT_EQ(read.triangles, plc.triangles);
  EXPECT_EQ(read.vertices[0].x, static_cast<double>(0.1f));
  EXPECT_EQ(read.inside, plc::InputPlc::Inside::even_odd);
}

TEST(WritePlc, RefusesWhatTheFormatCannotHold) {
  const auto with = [](auto change) {
    plc::InputPlc plc = awkward_surface();
    change(plc);
    return plc;
  };
  for (const std::string name : {"a.off", "a.obj", "a.ply"}) {
    expect_not_writable(with([](plc::InputPlc& p) { p.segments = {{0, 1}}; }), name, "segments");
    expect_not_writable(with([](plc::InputPlc& p) { p.holes = {{0, 1, 0}}; }), name, "holes");
    expect_not_writable(with([](plc::InputPlc& p) { p.regions = {{{0, 1, 0}, 1, 0}}; }), name, "regions");
    expect_not_writable(with([](plc::InputPlc& p) { p.polygon_facets[0].holes = {{0, 0, 0}}; }), name, "holes");
    expect_not_writable(with([](plc::InputPlc& p) {
                          p.polygon_facets[0].polygons.push_back({0, 1, 2});
                        }),
                        name, "polygons");
  }
  expect_not_writable(awkward_surface(), "a.stl", "more than 3 corners");
  expect_not_writable(with([](plc::InputPlc& p) { p.polygon_facets[0].polygons[0].push_back(2); }), "a.mesh",
                      "4 corners");
  expect_not_writable(with([](plc::InputPlc& p) { p.holes = {{0, 1, 0}}; }), "a.mesh", "holes");
  expect_not_writable(with([](plc::InputPlc& p) { p.polygon_facets[0].polygons.push_back({0}); }), "a.smesh",
                      "several polygons");
  expect_not_writable(with([](plc::InputPlc& p) { p.polygon_facets.clear(); }), "a.stl", "too large");
  expect_not_writable(
      with([](plc::InputPlc& p) { p.polygon_facets.clear(), p.triangles.resize(1), p.triangle_numbers.resize(1); }),
      "a.stl", "no facet has");
  expect_not_writable(plc::InputPlc(), "a.off", "no vertices");
  expect_not_writable(awkward_surface(), "a.step", "unknown ending '.step'");
}

TEST(WritePlc, LeavesAnOlderFileAloneWhenItFails) {
  const Folder folder;
  put(folder / "a.stl", "older");
  EXPECT_THROW(io::write_plc(awkward_surface(), folder / "a.stl"), OutputError);
  EXPECT_EQ(bytes_of(folder / "a.stl"), "older");
  io::write_plc(awkward_surface(), put(folder / "a.off", "older"));
  EXPECT_EQ(io::read_plc(folder / "a.off").facet_count(), 4u);
  EXPECT_EQ(folder.files(), 2u);
}

TEST(WritePlc, RefusesPlacesThatCannotBeWritten) {
  const Folder folder;
  std::filesystem::create_directory(folder / "d.off");
  EXPECT_THROW(io::write_plc(awkward_surface(), folder / "d.off"), OutputError);
  EXPECT_THROW(io::write_plc(awkward_surface(), folder / "missing/a.off"), OutputError);
  std::filesystem::create_symlink("/dev/null", folder / "null.off");
  EXPECT_THROW(io::write_plc(awkward_surface(), folder / "null.off"), OutputError);
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
  EXPECT_EQ(folder.files(), 2u);
}

TEST(WritePlc, LeavesNothingWhenTheDiskIsFull) {
  const Folder folder;
  plc::InputPlc plc = awkward_surface();
  plc.vertices.resize(100000, {0.1, 0.2, 0.3});
  rlimit before;
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const rlimit small{20000, before.rlim_max};
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);  // writing then fails as on a full disk
  setrlimit(RLIMIT_FSIZE, &small);
  EXPECT_THROW(io::write_plc(plc, folder / "a.off"), OutputError);
  EXPECT_THROW(io::write_plc(awkward_surface(), folder / "missing/a.off"), OutputError);
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, old_handler);
  EXPECT_EQ(folder.files(), 0u);
}

}  // namespace
}  // namespace ccdt
