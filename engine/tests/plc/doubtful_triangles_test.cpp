#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include "engine/base/errors.h"
#include "engine/base/simplex_map.h"
#include "engine/delaunay/delaunay.h"
#include "engine/front/find_delaunay_faces.h"
#include "engine/geometry/grid.h"
#include "engine/plc/build_plc.h"

// Triangles that are faces of the Delaunay tetrahedralization of all vertices are not tested with each other. The
// verdict on the input must be the same.

namespace ccdt {
namespace {

/// Some of the points of a small grid, which are often in one plane or on one line.
std::vector<Point3> random_vertices(std::mt19937& random, std::size_t count) {
  std::vector<Point3> points;
  while (points.size() < count) {
    const Point3 p{double(random() % 4), double(random() % 4), double(random() % 4)};
    if (std::ranges::find(points, p) == points.end()) points.push_back(p);
  }
  return points;
}

/// A closed surface of Delaunay faces, around about half of the cells, and a few random triangles, or none.
plc::InputPlc random_input(std::mt19937& random) {
  plc::InputPlc input;
  input.inside = plc::InputPlc::Inside::seeds;
  input.vertices = random_vertices(random, 12);
  std::vector<Point3> snapped = input.vertices;
  const DyadicGrid grid = make_grid(snapped);
  for (Point3& p : snapped) p = grid.snap(p);
  const delaunay::Delaunay d = delaunay::build_delaunay(snapped);
  std::map<FaceKey, int> sides;
  for (std::uint32_t c = 0; c < d.cells.size(); ++c) {
    if (!d.is_finite(c) || random() % 2 == 0) continue;
    for (std::uint32_t f = 0; f < 4; ++f) {
      const auto [u, v, w] = delaunay::corners_of_face(d.cells[c].vertices, f);
      ++sides[face_key(u, v, w)];
    }
  }
  for (const auto& [face, count] : sides)
    if (count == 1) input.triangles.push_back(face);
  for (std::uint32_t more = random() % 3; more > 0; --more) {
    std::array<std::uint32_t, 3> t{};
    for (std::uint32_t& v : t) v = static_cast<std::uint32_t>(random() % input.vertices.size());
    input.triangles.push_back(t);
  }
  return input;
}

struct Verdict {
  std::optional<plc::Plc> plc;
  delaunay::Delaunay delaunay = {};  // of its vertices, if there is a proof
  std::vector<long long> wrong_facets = {};
};

Verdict verdict_on(const plc::InputPlc& input, bool with_proof, std::size_t& proved) {
  try {
    plc::UncheckedPlc gathered = plc::gather_plc(input);
    delaunay::Delaunay delaunay;
    if (with_proof) {
      delaunay = delaunay::build_delaunay(gathered.plc.vertices);
      std::vector<std::uint32_t>& faces = gathered.triangles.faces;
      faces = front::find_delaunay_faces(gathered.triangles.corners, delaunay);
      proved += faces.size() - static_cast<std::size_t>(std::ranges::count(faces, plc::no_face));
    }
    return {.plc = plc::check_plc(input, std::move(gathered)), .delaunay = std::move(delaunay)};
  } catch (const InputError& error) {
    return {.plc = {}, .wrong_facets = error.place().facets};
  }
}

void expect_same(const plc::Plc& a, const plc::Plc& b) {
  ASSERT_EQ(a.facets.size(), b.facets.size());
  for (std::size_t f = 0; f < a.facets.size(); ++f) EXPECT_EQ(a.facets[f].triangle_count, b.facets[f].triangle_count);
  EXPECT_EQ(a.triangles, b.triangles);
  ASSERT_EQ(a.segments.size(), b.segments.size());
  for (std::size_t s = 0; s < a.segments.size(); ++s) EXPECT_EQ(a.segments[s].ends, b.segments[s].ends);
}

/// \return  how many segments are known to be edges
std::size_t count_right_edges(const Verdict& verdict) {
  std::size_t known = 0;
  for (const plc::Segment& s : verdict.plc->segments) {
    if (s.face == plc::no_face) continue;
    EXPECT_TRUE(delaunay::has_edge(verdict.delaunay, s.ends[0], s.ends[1]));
    ++known;
  }
  EXPECT_EQ(verdict.plc->faces.size(), verdict.plc->triangles.size());
  for (std::size_t t = 0; t < verdict.plc->triangles.size(); ++t) {
    const auto& [a, b, c] = verdict.plc->triangles[t];
    const std::uint32_t code = verdict.plc->faces[t];
    if (code == plc::no_face) continue;
    const std::uint32_t found = delaunay::find_face(verdict.delaunay, a, b, c);
    EXPECT_TRUE(code == found || code == verdict.delaunay.across(found));
  }
  return known;
}

TEST(PlcDoubtfulTriangles, AreAllThatNeedsATest) {
  std::mt19937 random(5);
  std::size_t valid = 0, wrong = 0, proved = 0, edges = 0;
  for (int i = 0; i < 2000; ++i) {
    const plc::InputPlc input = random_input(random);
    const Verdict all = verdict_on(input, false, proved), some = verdict_on(input, true, proved);
    ASSERT_EQ(all.plc.has_value(), some.plc.has_value()) << "input " << i;
    EXPECT_EQ(all.wrong_facets, some.wrong_facets) << "input " << i;
    if (all.plc) {
      expect_same(*all.plc, *some.plc);
      edges += count_right_edges(some);
    }
    ++(all.plc ? valid : wrong);
  }
  // All three kinds of inputs are there.
  EXPECT_GT(valid, 200u);
  EXPECT_GT(wrong, 200u);
  EXPECT_GT(proved, 10000u);
  EXPECT_GT(edges, 10000u);
}

}  // namespace
}  // namespace ccdt
