#include "engine/tets/crossing_faces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "engine/geometry/contacts.h"
#include "engine/tests/improve/improve_checks.h"
#include "engine/tets/shake_cells.h"

namespace ccdt {
namespace {

using namespace improve_test;

const tets::QualityGoal any_positive{tets::Objective::r, 1, 1};

/// Two tetrahedra below a valley between the vertices 0 and 2. With the other diagonal, from 1 to 3, the faces would be
/// a ridge at the height 20, 20 above the valley.
Model valley(bool is_facet_reversed) {
  Model model;
  model.points = {{0, 0, 0}, {100, 0, 20}, {100, 100, 0}, {0, 100, 20}, {50, 50, -100}};
  model.cells = {{0, 1, 2, 4}, {0, 2, 3, 4}};
  model.faces = {{0, 1, 2}, {0, 2, 3}};
  if (is_facet_reversed)
    for (Triangle& face : model.faces) std::swap(face[1], face[2]);
  model.facet_of_face = {0, 0};
  return model;
}

/// Adds a tetrahedron of its own.
void add(const std::array<Point3, 4>& corners, Model& model) {
  const auto first = static_cast<std::uint32_t>(model.points.size());
  model.points.insert(model.points.end(), corners.begin(), corners.end());
  model.cells.push_back({first, first + 1, first + 2, first + 3});
}

/// Can the edge from 0 to 2 be flipped?
bool can_flip(const Model& model) {
  const tets::CellComplex x = complex_of(model, any_positive);
  tets::Change change;
  return tets::plan_edge_removal(x, CellId(0), edge_of_cell(x, CellId(0), 0, 2), 0, change);
}

TEST(CrossingFaces, TakeOnlySpaceThatIsFree) {
  for (const bool is_facet_reversed : {false, true}) {
    EXPECT_TRUE(can_flip(valley(is_facet_reversed)));
    for (const double height : {1.0, 10.0, 19.0, 20.0, 21.0, 50.0}) {
      SCOPED_TRACE(height);
      Model model = valley(is_facet_reversed);
      add({Point3{50, 50, height}, {30, 50, 200}, {70, 40, 200}, {50, 80, 200}}, model);
      EXPECT_EQ(can_flip(model), height > 20);
    }
  }
}

TEST(CrossingFaces, DoNotEncloseAnotherPartOfTheDomain) {
  for (const double height : {5.0, 30.0}) {
    Model model = valley(false);
    const Point3 tip{50, 50, height};
    add({tip, tip + Point3{4, 0, 2}, tip + Point3{0, 4, 2}, tip + Point3{0, 0, 4}}, model);
    EXPECT_EQ(can_flip(model), height > 20);
  }
}

TEST(CrossingFaces, DoNotEncloseAPartAtTheirEnds) {
  Model model = valley(false);
  model.points.push_back({45, 50, 10});
  model.points.push_back({55, 50, 10});
  model.cells.push_back({1, 3, 5, 6});
  EXPECT_FALSE(can_flip(model));
}

/// Two plates, one above the other, with a gap that is smaller than their bumps.
class Plates {
 public:
  static constexpr std::uint32_t size = 6;  ///< vertices of a side

  explicit Plates(std::mt19937& random) {
    for (std::uint32_t y = 0; y < size; ++y)
      for (std::uint32_t x = 0; x < size; ++x) {
        const double height = static_cast<double>(random() % 12);
        const double gap = 1 + static_cast<double>(random() % 3);
        for (const double z : {-100.0, height, height + gap, 200.0}) model.points.push_back({10.0 * x, 10.0 * y, z});
      }
    for (std::uint32_t y = 0; y + 1 < size; ++y)
      for (std::uint32_t x = 0; x + 1 < size; ++x) {
        const std::uint32_t a = y * size + x, b = a + 1, c = a + size, d = c + 1;
        if (random() % 2 == 0) {
          add_columns({a, b, d}), add_columns({a, d, c});
        } else {
          add_columns({a, b, c}), add_columns({b, d, c});
        }
      }
  }

  Model model;

 private:
  static std::uint32_t at(std::uint32_t column, std::uint32_t layer) { return 4 * column + layer; }

  /// The prisms of both plates over a triangle, each as three tetrahedra whose diagonals depend on the numbers of the
  /// corners.
  void add_columns(Triangle t) {
    model.faces.push_back({at(t[0], 1), at(t[1], 1), at(t[2], 1)});
    model.faces.push_back({at(t[0], 2), at(t[1], 2), at(t[2], 2)});
    model.facet_of_face.insert(model.facet_of_face.end(), {0, 1});
    std::ranges::sort(t);
    for (const std::uint32_t low : {0u, 2u}) {
      const std::uint32_t high = low + 1;
      model.cells.push_back({at(t[0], low), at(t[1], low), at(t[2], low), at(t[0], high)});
      model.cells.push_back({at(t[1], low), at(t[2], low), at(t[0], high), at(t[1], high)});
      model.cells.push_back({at(t[2], low), at(t[0], high), at(t[1], high), at(t[2], high)});
    }
  }
};

/// Do two faces meet in more than their common corners and edges?
bool meet(const tets::CellComplex& x, Triangle s, Triangle t) {
  const auto is_common = [](const Triangle& other) {
    return [&other](std::uint32_t v) { return std::ranges::find(other, v) != other.end(); };
  };
  std::ranges::partition(s, is_common(t));
  std::ranges::partition(t, is_common(s));
  const auto points = [&](const Triangle& f) { return std::array{x.point(f[0]), x.point(f[1]), x.point(f[2])}; };
  const auto common = std::ranges::count_if(s, is_common(t));
  if (common > 1) return common > 2;
  return common == 1 ? meet_triangles_at_corner(points(s), points(t)).has_value()
                     : meet_triangles(points(s), points(t)).has_value();
}

TEST(CrossingFaces, AreNotMadeByRandomChanges) {
  std::mt19937 random(4);
  std::size_t flipped = 0;
  for (int i = 0; i < 20; ++i) {
    tets::CellComplex x = complex_of(Plates(random).model, any_positive);
    const std::vector<Triangle> before = x.faces();
    for (std::size_t f = 0; f < before.size(); ++f)
      for (std::size_t g = 0; g < f; ++g) ASSERT_FALSE(meet(x, before[f], before[g])) << f << " " << g;
    std::vector<CellId> made;
    std::mt19937 shakes(2);
    for (std::uint32_t v = 0; v < x.vertex_count(); ++v) tets::shake_cells(x, v, 20, 0, shakes, made);
    expect_consistent(x);
    for (std::size_t f = 0; f < before.size(); ++f) {
      flipped += x.faces()[f] != before[f];
      for (std::size_t g = 0; g < f; ++g) EXPECT_FALSE(meet(x, x.faces()[f], x.faces()[g])) << f << " " << g;
    }
  }
  EXPECT_GT(flipped, 300u);
}

}  // namespace
}  // namespace ccdt
