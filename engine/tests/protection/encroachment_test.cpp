#include "engine/protection/encroachment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "engine/delaunay/delaunay.h"
#include "engine/delaunay/insertion.h"
#include "engine/geometry/grid.h"
#include "engine/tests/delaunay/delaunay_point_sets.h"

namespace ccdt {
namespace {

using protection::WorstVertex;

WorstVertex worst_of_all(const delaunay::Delaunay& d, std::uint32_t a, std::uint32_t b) {
  WorstVertex worst(d.point(a), d.point(b));
  for (std::uint32_t v = 0; v < d.vertices.size(); ++v) worst.examine(v, d.point(v));
  return worst;
}

std::size_t vertices_in_diametral_ball(const delaunay::Delaunay& d, std::uint32_t a, std::uint32_t b) {
  return static_cast<std::size_t>(std::ranges::count_if(d.vertices, [&](const delaunay::DelaunayVertex& v) {
    return dot(d.point(a) - v.point, d.point(b) - v.point) < 0;
  }));
}

/// Is the point on the grid? If not, it would be rounded, perhaps to a place beyond the hull.
bool is_on_grid(const Point3& p) {
  return p == Point3{round_to_unit(p.x), round_to_unit(p.y), round_to_unit(p.z)};
}

/// Calls visit(a, b) for some pairs of different vertices.
template <class Visit>
void visit_random_pairs(const delaunay::Delaunay& d, const Visit& visit) {
  std::mt19937 random(1);
  std::uniform_int_distribution<std::uint32_t> vertex(0, static_cast<std::uint32_t>(d.vertices.size() - 1));
  for (int i = 0; i < 500; ++i)
    if (const std::uint32_t a = vertex(random), b = vertex(random); a != b) visit(a, b);
}

TEST(Encroachment, SearchFindsTheWorstVertexOfAll) {
  std::size_t found_among_few = 0, found_among_many = 0;
  for (const auto& [name, points] : test::small_sets()) {
    const delaunay::Delaunay d = delaunay::build_delaunay(points);
    protection::DiametralSearch search(d);
    visit_random_pairs(d, [&](std::uint32_t a, std::uint32_t b) {
      WorstVertex worst(d.point(a), d.point(b));
      if (!search.find_worst(a, b, worst)) return;
      EXPECT_EQ(worst.vertex(), worst_of_all(d, a, b).vertex()) << name << " " << a << " " << b;
      ++(vertices_in_diametral_ball(d, a, b) <= 16 ? found_among_few : found_among_many);
    });
  }
  EXPECT_GT(found_among_few, 100u);
  EXPECT_GT(found_among_many, 100u);
}

TEST(Encroachment, NewVertexIsJoinedAsForetold) {
  std::size_t joined = 0;
  for (const auto& [name, points] : test::small_sets()) {
    delaunay::Delaunay d = delaunay::build_delaunay(points);
    delaunay::Insertion insertion(d);
    visit_random_pairs(d, [&](std::uint32_t a, std::uint32_t b) {
      const auto v = worst_of_all(d, a, b).vertex();
      const Point3 p = 0.5 * (d.point(a) + d.point(b));
      if (!v || !is_on_grid(p) || !protection::would_be_joined(d, *v, p)) return;
      ASSERT_TRUE(insertion.find_cavity(d.add_vertex(p), d.cell_at[a])) << name;
      std::set<std::uint32_t> border;
      for (const delaunay::CavityFace& face : insertion.cavity_faces())
        border.insert(face.vertices.begin(), face.vertices.end());
      EXPECT_TRUE(border.contains(*v)) << name << " " << a << " " << b;
      insertion.discard_cavity();
      d.remove_last_vertex();
      ++joined;
    });
  }
  EXPECT_GT(joined, 100u);
}

}  // namespace
}  // namespace ccdt
