#include "bench/tests/verify_cases.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace ccdt {

namespace {

int left_and_right(int i, int, int) {
  return i < 2 ? 1 : 2;
}

}  // namespace

std::string all_lines(const verify::Verification& verification) {
  std::string s;
  for (const verify::Check& check : verification.checks) {
    s += check.name + ": " + std::to_string(check.failed) + " of " + std::to_string(check.checked) + " failed\n";
    for (const std::string& example : check.examples) s += "  " + example + "\n";
  }
  return s;
}

const verify::Check& check_named(const verify::Verification& verification, const std::string& name) {
  const auto found = std::find_if(verification.checks.begin(), verification.checks.end(),
                                  [&](const verify::Check& c) { return c.name == name; });
  if (found == verification.checks.end()) throw std::runtime_error("no check is called " + name);
  return *found;
}

void expect_ok(const MeshedInput& m, verify::VerifyOptions options) {
  options.lists = tetrahedra_alone.lists;
  const verify::Verification v = verify::verify(m.input, m.mesh, options);
  EXPECT_TRUE(v.ok()) << all_lines(v);
}

void expect_failure(const MeshedInput& m, const std::string& name, verify::VerifyOptions options) {
  options.lists = tetrahedra_alone.lists;
  const verify::Verification v = verify::verify(m.input, m.mesh, options);
  EXPECT_FALSE(v.ok());
  const verify::Check& check = check_named(v, name);
  EXPECT_GT(check.failed, 0u) << all_lines(v);
  EXPECT_FALSE(check.examples.empty());
}

int everywhere(int, int, int) {
  return 0;
}
int around_a_hole(int i, int j, int k) {
  return i == 1 && j == 1 && k == 1 ? outside : 0;
}

MeshedInput cube() {
  return make_grid_mesh({3, 3, 3}, everywhere, false, unmoved);
}

MeshedInput two_regions(bool turned, const Transform& transform) {
  MeshedInput m = make_grid_mesh({4, 3, 3}, left_and_right, turned, transform);
  m.input.inside = plc::InputPlc::Inside::seeds;
  m.input.regions = {{transform({0.4, 0.3, 0.6}), 1, 0}, {transform({3.4, 0.3, 0.6}), 2, 0}};
  return m;
}

std::uint32_t vertex_at(const mesh::TetMesh& mesh, const Point3& p) {
  const auto found = std::find(mesh.vertices.begin(), mesh.vertices.end(), p);
  return static_cast<std::uint32_t>(found - mesh.vertices.begin());
}

plc::InputPlc unit_cube() {
  plc::InputPlc input;
  for (int i = 0; i < 8; ++i) input.vertices.push_back({double(i & 1), double(i >> 1 & 1), double(i >> 2)});
  for (const auto& q : std::vector<std::vector<std::uint32_t>>{
           {0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
    plc::PolygonFacet facet;
    facet.polygons = {q};
    facet.number = static_cast<std::uint32_t>(input.polygon_facets.size());
    input.polygon_facets.push_back(facet);
  }
  return input;
}

MeshedInput cube_in_five() {
  MeshedInput m{unit_cube(), {}};
  m.mesh.vertices = m.input.vertices;
  m.mesh.tetrahedra = {{0, 1, 2, 4}, {3, 2, 1, 7}, {5, 4, 7, 1}, {6, 7, 4, 2}, {1, 2, 4, 7}};
  m.mesh.regions.assign(5, 0);
  return m;
}

MeshedInput bipyramid(bool delaunay) {
  MeshedInput m;
  m.input.vertices = {{1, 0, 0}, {-0.5, 0.8, 0}, {-0.5, -0.8, 0}, {0, 0, 2}, {0, 0, -2}};
  m.input.triangles = {{0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {1, 0, 4}, {2, 1, 4}, {0, 2, 4}};
  m.mesh.vertices = m.input.vertices;
  if (delaunay)
    m.mesh.tetrahedra = {{0, 1, 2, 3}, {1, 0, 2, 4}};
  else
    m.mesh.tetrahedra = {{4, 0, 1, 3}, {4, 1, 2, 3}, {4, 2, 0, 3}};
  m.mesh.regions.assign(m.mesh.tetrahedra.size(), 0);
  m.mesh.constrained_delaunay = true;
  return m;
}

MeshedInput plate() {
  MeshedInput m = make_grid_mesh(
      {3, 3, 1}, [](int i, int j, int) { return i == 1 && j == 1 ? outside : 0; }, false, unmoved);
  m.input.inside = plc::InputPlc::Inside::seeds;
  m.input.triangles.clear();
  const auto facet = [&](std::vector<std::vector<Point3>> loops, std::vector<Point3> holes) {
    plc::PolygonFacet f;
    for (const auto& loop : loops) {
      f.polygons.emplace_back();
      for (const Point3& p : loop) f.polygons.back().push_back(vertex_at(m.mesh, p));
    }
    f.holes = std::move(holes);
    f.number = static_cast<std::uint32_t>(m.input.polygon_facets.size());
    m.input.polygon_facets.push_back(f);
  };
  for (const double z : {0.0, 1.0})
    facet({{{0, 0, z}, {3, 0, z}, {3, 3, z}, {0, 3, z}}, {{1, 1, z}, {2, 1, z}, {2, 2, z}, {1, 2, z}}},
          {{1.5, 1.5, z}});
  for (const auto& [low, high] : {std::pair{0.0, 3.0}, std::pair{1.0, 2.0}})
    for (const double at : {low, high}) {
      facet({{{low, at, 0}, {high, at, 0}, {high, at, 1}, {low, at, 1}}}, {});
      facet({{{at, low, 0}, {at, high, 0}, {at, high, 1}, {at, low, 1}}}, {});
    }
  return m;
}

}  // namespace ccdt
