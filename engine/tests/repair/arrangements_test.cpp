#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <deque>
#include <numeric>
#include <string>
#include <vector>

#include "engine/repair/find_faults.h"
#include "engine/repair/repair_input.h"

// Solids that cross, touch or cover each other, whose arrangement is known exactly: the volume and the regions of the
// repaired input are compared with whole and rational numbers.

namespace ccdt {
namespace {

using plc::InputPlc;
using repair::Diagnosis;

using Whole = std::array<int, 3>;
/// Three vectors of whole numbers, of equal length and at right angles.
using Basis = std::array<Whole, 3>;
constexpr Basis upright = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
constexpr Basis tilted = {{{1, 2, 2}, {2, 1, -2}, {-2, 2, -1}}};
constexpr Basis turned = {{{3, 4, 0}, {-4, 3, 0}, {0, 0, 5}}};

Whole place(const Basis& basis, const Whole& p) {
  Whole sum = {0, 0, 0};
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t axis = 0; axis < 3; ++axis) sum[axis] += p[k] * basis[k][axis];
  return sum;
}

/// Of a cell of the lattice.
double cell_volume(const Basis& basis) {
  const int squared = basis[0][0] * basis[0][0] + basis[0][1] * basis[0][1] + basis[0][2] * basis[0][2];
  return std::pow(squared, 1.5);
}

class Soup {
 public:
  explicit Soup(InputPlc::Inside inside) { input.inside = inside; }

  void add_polygon(const std::vector<Whole>& corners) {
    std::vector<std::uint32_t> polygon;
    for (const auto& [x, y, z] : corners) {
      polygon.push_back(static_cast<std::uint32_t>(input.vertices.size()));
      input.vertices.push_back({double(x), double(y), double(z)});
    }
    const auto number = static_cast<std::uint32_t>(input.polygon_facets.size());
    input.polygon_facets.push_back({{polygon}, {}, 0, number});
  }

  InputPlc input;
};

Diagnosis repaired(const InputPlc& input) {
  const repair::Repaired result = repair::repair_input(input);
  EXPECT_TRUE(result.refused.empty());
  return repair::find_faults(result.input);
}

// On a lattice: rectangles across an axis, among cells that are counted.

struct Rectangle {
  std::size_t axis;
  Whole low, high;  ///< equal along the axis
  bool is_backward = false;
};

struct LatticeBox {
  Whole low, high;

  bool holds(const Whole& cell) const {
    const auto between = [&](std::size_t axis) { return low[axis] <= cell[axis] && cell[axis] < high[axis]; };
    return between(0) && between(1) && between(2);
  }
};

std::vector<Rectangle> sides_of(const LatticeBox& box) {
  std::vector<Rectangle> sides;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Rectangle low{axis, box.low, box.high, true}, high{axis, box.low, box.high};
    low.high[axis] = box.low[axis], high.low[axis] = box.high[axis];
    sides.insert(sides.end(), {low, high});
  }
  return sides;
}

InputPlc soup_of(const std::vector<Rectangle>& rectangles, const Basis& basis, InputPlc::Inside inside) {
  Soup soup(inside);
  for (const auto& [axis, low, high, is_backward] : rectangles) {
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    std::vector<Whole> corners = {low, low, high, low};
    corners[1][u] = high[u], corners[3][v] = high[v];
    if (is_backward) std::ranges::reverse(corners);
    for (Whole& corner : corners) corner = place(basis, corner);
    soup.add_polygon(corners);
  }
  return soup.input;
}

/// The cells of a lattice, with walls between them, in a layer of cells that are outside.
class Cells {
 public:
  explicit Cells(const std::vector<Rectangle>& rectangles) {
    for (const Rectangle& r : rectangles)
      for (std::size_t axis = 0; axis < 3; ++axis) size_[axis] = std::max(size_[axis], r.high[axis] + 2);
    region_.assign(static_cast<std::size_t>(size_[0]) * size_[1] * size_[2], -1);
    for (auto& walls : walls_) walls.assign(region_.size(), false);
    for (const Rectangle& r : rectangles)
      for (int x = r.low[0]; x < r.high[0] + (r.axis == 0); ++x)
        for (int y = r.low[1]; y < r.high[1] + (r.axis == 1); ++y)
          for (int z = r.low[2]; z < r.high[2] + (r.axis == 2); ++z) walls_[r.axis][index({x, y, z})] = true;
    for (std::size_t cell = 0; cell < region_.size(); ++cell)
      if (region_[cell] < 0) fill(cell);
  }

  /// Those that are not outside.
  std::size_t regions() const { return volumes_.size() - 1; }
  std::size_t enclosed() const { return std::accumulate(volumes_.begin() + 1, volumes_.end(), std::size_t{0}); }

 private:
  /// Cells begin at -1.
  std::size_t index(const Whole& cell) const {
    return (static_cast<std::size_t>(cell[0] + 1) * size_[1] + (cell[1] + 1)) * size_[2] + (cell[2] + 1);
  }

  void fill(std::size_t first) {
    const auto number = static_cast<int>(volumes_.size());
    volumes_.push_back(0);
    std::deque<std::size_t> cells = {first};
    region_[first] = number;
    const std::array<std::size_t, 3> step = {static_cast<std::size_t>(size_[1]) * size_[2],
                                             static_cast<std::size_t>(size_[2]), 1};
    const auto enter = [&](std::size_t cell) {
      if (region_[cell] >= 0) return;
      region_[cell] = number;
      cells.push_back(cell);
    };
    for (; !cells.empty(); cells.pop_front()) {
      const std::size_t cell = cells.front();
      ++volumes_.back();
      const std::array<std::size_t, 3> at = {cell / step[0], cell / step[1] % size_[1], cell % size_[2]};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        if (at[axis] > 0 && !walls_[axis][cell]) enter(cell - step[axis]);
        if (at[axis] + 1 < static_cast<std::size_t>(size_[axis]) && !walls_[axis][cell + step[axis]])
          enter(cell + step[axis]);
      }
    }
  }

  Whole size_ = {2, 2, 2};
  std::array<std::vector<bool>, 3> walls_;  // by cell: is there one on its lower side?
  std::vector<int> region_;                 // by cell
  std::vector<std::size_t> volumes_;        // of each region; the first one is outside
};

std::size_t count_cells_in_union(const std::vector<LatticeBox>& boxes) {
  std::size_t count = 0;
  for (int x = 0; x < 60; ++x)
    for (int y = 0; y < 16; ++y)
      for (int z = 0; z < 16; ++z)
        count += std::ranges::any_of(boxes, [&](const LatticeBox& box) { return box.holds({x, y, z}); });
  return count;
}

struct Boxes {
  std::string name;
  std::vector<LatticeBox> boxes;
  std::size_t regions_of_union;  ///< solids that only touch stay apart
};

std::vector<LatticeBox> coplanar_overlaps() {
  std::vector<LatticeBox> boxes;
  for (int i = 0; i < 50; ++i) boxes.push_back({{i, i % 4, 0}, {i + 3, 5 + i % 3, 1 + i % 5}});
  return boxes;
}

std::vector<LatticeBox> screw() {
  std::vector<LatticeBox> boxes;
  for (int i = 0; i < 8; ++i) {
    const int z = i;
    constexpr std::array<std::array<int, 4>, 4> arms = {{{4, 4, 10, 6}, {4, 4, 6, 10}, {0, 4, 6, 6}, {4, 0, 6, 6}}};
    const auto& [x0, y0, x1, y1] = arms[static_cast<std::size_t>(i % 4)];
    boxes.push_back({{x0, y0, z}, {x1, y1, z + 2}});
  }
  return boxes;
}

const std::vector<Boxes> assemblies = {
    {"two boxes", {{{0, 0, 0}, {4, 4, 4}}, {{2, 2, 2}, {6, 6, 6}}}, 1},
    {"a bar through a box", {{{0, 0, 2}, {6, 6, 8}}, {{2, 2, 0}, {4, 4, 10}}}, 1},
    {"three bars", {{{0, 3, 3}, {9, 6, 6}}, {{3, 0, 3}, {6, 9, 6}}, {{3, 3, 0}, {6, 6, 9}}}, 1},
    {"a frame of four bars",
     {{{0, 0, 0}, {9, 2, 2}}, {{0, 7, 0}, {9, 9, 2}}, {{0, 0, 1}, {2, 9, 3}}, {{7, 0, 1}, {9, 9, 3}}},
     1},
    {"a side in common", {{{0, 0, 0}, {3, 3, 3}}, {{3, 0, 0}, {6, 3, 3}}}, 2},
    {"a part of a side in common", {{{0, 0, 0}, {3, 3, 3}}, {{3, 1, 1}, {6, 5, 5}}}, 2},
    {"the same box twice", {{{0, 0, 0}, {3, 3, 3}}, {{0, 0, 0}, {3, 3, 3}}}, 1},
    {"sides that cover each other from inside", {{{0, 0, 0}, {6, 6, 6}}, {{0, 2, 2}, {8, 4, 4}}}, 1},
    {"fifty on one plane", coplanar_overlaps(), 1},
    {"a screw", screw(), 1}};

std::vector<Rectangle> rectangles_of(const std::vector<LatticeBox>& boxes) {
  std::vector<Rectangle> all;
  for (const LatticeBox& box : boxes) {
    const std::vector<Rectangle> sides = sides_of(box);
    all.insert(all.end(), sides.begin(), sides.end());
  }
  return all;
}

TEST(Arrangements, OfBoxesAreTheirUnion) {
  for (const auto& [name, boxes, regions] : assemblies)
    for (const Basis& basis : {upright, tilted, turned}) {
      const Diagnosis found = repaired(soup_of(rectangles_of(boxes), basis, InputPlc::Inside::even_odd));
      EXPECT_TRUE(found.is_valid()) << name;
      EXPECT_EQ(found.regions, regions) << name;
      const double wanted = cell_volume(basis) * static_cast<double>(count_cells_in_union(boxes));
      EXPECT_NEAR(found.volume, wanted, 1e-9 * wanted) << name;
    }
}

void expect_regions_of_cells(const std::string& name, const std::vector<Rectangle>& rectangles) {
  const Cells cells(rectangles);
  for (const Basis& basis : {upright, tilted, turned}) {
    const Diagnosis found = repaired(soup_of(rectangles, basis, InputPlc::Inside::seeds));
    EXPECT_TRUE(found.is_valid()) << name;
    EXPECT_EQ(found.regions, cells.regions()) << name;
    const double wanted = cell_volume(basis) * static_cast<double>(cells.enclosed());
    EXPECT_NEAR(found.volume, wanted, 1e-9 * wanted) << name;
  }
}

TEST(Arrangements, OfFacetsHaveTheRegionsOfTheirCells) {
  for (const auto& [name, boxes, regions] : assemblies) expect_regions_of_cells(name, rectangles_of(boxes));
  for (const auto& [name, boxes] : std::vector<std::pair<std::string, std::vector<LatticeBox>>>{
           {"nested", {{{0, 0, 0}, {9, 9, 9}}, {{2, 2, 2}, {7, 7, 7}}, {{3, 3, 3}, {6, 6, 6}}}},
           {"nested, and one across", {{{0, 0, 0}, {9, 9, 9}}, {{2, 2, 2}, {7, 7, 7}}, {{4, 4, 4}, {5, 5, 12}}}},
           {"an edge in common", {{{0, 0, 0}, {3, 3, 3}}, {{3, 3, 0}, {6, 6, 3}}}},
           {"a corner in common", {{{0, 0, 0}, {3, 3, 3}}, {{3, 3, 3}, {6, 6, 6}}}}})
    expect_regions_of_cells(name, rectangles_of(boxes));
}

/// A box whose neck leaves it at the top, comes back through a side, and ends at a hole in the bottom. Its outside is
/// its inside.
std::vector<Rectangle> klein_bottle() {
  std::vector<Rectangle> bottle = {
      {0, {2, 2, 0}, {2, 8, 8}}, {0, {8, 2, 0}, {8, 8, 8}}, {1, {2, 2, 0}, {8, 2, 8}}, {1, {2, 8, 0}, {8, 8, 8}}};
  for (const int z : {0, 8})  // around the holes
    bottle.insert(
        bottle.end(),
        {{2, {2, 2, z}, {8, 4, z}}, {2, {2, 6, z}, {8, 8, z}}, {2, {2, 4, z}, {4, 6, z}}, {2, {6, 4, z}, {8, 6, z}}});
  const std::vector<LatticeBox> neck = {{{4, 4, 8}, {6, 6, 12}},
                                        {{4, 4, 10}, {12, 6, 12}},
                                        {{10, 4, 4}, {12, 6, 12}},
                                        {{4, 4, 4}, {12, 6, 6}},
                                        {{4, 4, 0}, {6, 6, 6}}};
  const auto in_neck = [&](const Whole& cell) {
    return std::ranges::any_of(neck, [&](const LatticeBox& box) { return box.holds(cell); });
  };
  for (int x = 0; x <= 12; ++x)
    for (int y = 0; y <= 12; ++y)
      for (int z = 0; z <= 12; ++z)
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const Whole cell = {x, y, z};
          Whole before = cell, high = {x + 1, y + 1, z + 1};
          --before[axis], high[axis] = cell[axis];
          const bool is_end = axis == 2 && (z == 0 || z == 8);
          if (in_neck(cell) != in_neck(before) && !is_end) bottle.push_back({axis, cell, high});
        }
  return bottle;
}

TEST(Arrangements, OfAKleinBottleHaveOneRegion) {
  const std::vector<Rectangle> bottle = klein_bottle();
  EXPECT_EQ(Cells(bottle).regions(), 1u);
  expect_regions_of_cells("Klein bottle", bottle);
}

// In general position: convex solids, whose union follows from their intersections.

using Rational = boost::multiprecision::cpp_rational;
using Exact = std::array<Rational, 3>;
using Tetrahedron = std::array<Exact, 4>;

Rational dot(const Exact& a, const Exact& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Exact minus(const Exact& a, const Exact& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Exact cross(const Exact& a, const Exact& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Exact exact(const Whole& p) {
  return {p[0], p[1], p[2]};
}

Rational six_volumes(const Tetrahedron& t) {
  return abs(dot(cross(minus(t[1], t[0]), minus(t[2], t[0])), minus(t[3], t[0])));
}

struct Convex {
  std::vector<Whole> corners;
  std::vector<std::vector<std::size_t>> sides;  ///< counterclockwise seen from outside
};

Convex box_in(const Basis& basis, const Whole& origin, const Whole& size) {
  Convex box;
  for (int i = 0; i < 8; ++i) {
    Whole corner = place(basis, {size[0] * (i & 1), size[1] * (i >> 1 & 1), size[2] * (i >> 2)});
    for (std::size_t axis = 0; axis < 3; ++axis) corner[axis] += origin[axis];
    box.corners.push_back(corner);
  }
  box.sides = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  return box;
}

Convex tetrahedron(const std::array<Whole, 4>& corners) {
  return {{corners.begin(), corners.end()}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
}

/// Tetrahedra from one corner to the sides.
std::vector<Tetrahedron> divided(const Convex& solid) {
  std::vector<Tetrahedron> parts;
  const auto at = [&](std::size_t corner) { return exact(solid.corners[corner]); };
  for (const auto& side : solid.sides)
    for (std::size_t k = 2; k < side.size(); ++k) parts.push_back({at(0), at(side[0]), at(side[k - 1]), at(side[k])});
  return parts;
}

/// The part of a tetrahedron where `height` is at most zero.
template <class Height>
void clip(const Tetrahedron& t, const Height& height, std::vector<Tetrahedron>& parts) {
  std::vector<Exact> below, above;
  for (const Exact& p : t) (height(p) <= 0 ? below : above).push_back(p);
  const auto between = [&](const Exact& a, const Exact& b) {
    const Rational part = height(a) / (height(a) - height(b));
    Exact p = minus(b, a);
    for (std::size_t axis = 0; axis < 3; ++axis) p[axis] = a[axis] + part * p[axis];
    return p;
  };
  // A prism with these two triangles.
  const auto add_prism = [&](const std::array<Exact, 3>& a, const std::array<Exact, 3>& b) {
    parts.insert(parts.end(), {{a[0], a[1], a[2], b[2]}, {a[0], a[1], b[1], b[2]}, {a[0], b[0], b[1], b[2]}});
  };
  if (below.size() == 4) parts.push_back(t);
  if (below.size() == 1)
    parts.push_back({below[0], between(below[0], above[0]), between(below[0], above[1]), between(below[0], above[2])});
  if (below.size() == 2)
    add_prism({below[0], between(below[0], above[0]), between(below[0], above[1])},
              {below[1], between(below[1], above[0]), between(below[1], above[1])});
  if (below.size() == 3)
    add_prism({below[0], below[1], below[2]},
              {between(below[0], above[0]), between(below[1], above[0]), between(below[2], above[0])});
}

std::vector<Tetrahedron> within(std::vector<Tetrahedron> parts, const Convex& solid) {
  for (const auto& side : solid.sides) {
    const Exact a = exact(solid.corners[side[0]]);
    const Exact normal = cross(minus(exact(solid.corners[side[1]]), a), minus(exact(solid.corners[side[2]]), a));
    std::vector<Tetrahedron> left;
    for (const Tetrahedron& t : parts)
      clip(
          t, [&](const Exact& p) { return dot(normal, minus(p, a)); }, left);
    parts = std::move(left);
  }
  return parts;
}

/// By inclusion and exclusion.
double volume_of_union(const std::vector<Convex>& solids) {
  Rational six_times = 0;
  for (std::size_t set = 1; set < std::size_t{1} << solids.size(); ++set) {
    std::vector<Tetrahedron> common;
    std::size_t count = 0;
    for (std::size_t i = 0; i < solids.size(); ++i) {
      if ((set >> i & 1) == 0) continue;
      common = count++ == 0 ? divided(solids[i]) : within(std::move(common), solids[i]);
    }
    for (const Tetrahedron& t : common) six_times += (count % 2 == 1 ? 1 : -1) * six_volumes(t);
  }
  return static_cast<double>(six_times / 6);
}

struct Solids {
  std::string name;
  std::vector<Convex> solids;
  std::size_t regions;  ///< of the arrangement
};

const std::vector<Solids> crossing_solids = {
    {"two tetrahedra in a cube",
     {tetrahedron({{{0, 0, 0}, {6, 6, 0}, {6, 0, 6}, {0, 6, 6}}}),
      tetrahedron({{{6, 6, 6}, {0, 0, 6}, {0, 6, 0}, {6, 0, 0}}})},
     9},
    {"a star of two prisms", {box_in(upright, {0, 0, 0}, {70, 70, 20}), box_in(turned, {45, -15, 0}, {14, 10, 4})}, 0},
    {"two boxes", {box_in(upright, {0, 0, 0}, {40, 40, 40}), box_in(tilted, {20, 20, 20}, {10, 10, 10})}, 0},
    {"three boxes",
     {box_in(upright, {0, 0, 0}, {40, 40, 40}), box_in(tilted, {20, 20, 20}, {10, 10, 10}),
      box_in(turned, {30, 10, 30}, {5, 6, 7})},
     0},
    {"a tetrahedron through a box",
     {box_in(tilted, {0, 0, 0}, {9, 9, 9}), tetrahedron({{{-20, 15, 3}, {60, 11, 7}, {55, 30, 1}, {50, 12, 30}}})},
     0}};

InputPlc soup_of(const std::vector<Convex>& solids, InputPlc::Inside inside) {
  Soup soup(inside);
  for (const Convex& solid : solids)
    for (const auto& side : solid.sides) {
      std::vector<Whole> corners;
      for (const std::size_t corner : side) corners.push_back(solid.corners[corner]);
      soup.add_polygon(corners);
    }
  return soup.input;
}

TEST(Arrangements, OfConvexSolidsHaveTheVolumeOfTheirUnion) {
  for (const auto& [name, solids, regions] : crossing_solids) {
    const double wanted = volume_of_union(solids);
    const Diagnosis as_surface = repaired(soup_of(solids, InputPlc::Inside::even_odd));
    const Diagnosis as_plc = repaired(soup_of(solids, InputPlc::Inside::seeds));
    for (const Diagnosis& found : {as_surface, as_plc}) {
      EXPECT_TRUE(found.is_valid()) << name;
      EXPECT_NEAR(found.volume, wanted, 1e-8 * wanted) << name;
    }
    EXPECT_EQ(as_surface.regions, 1u) << name;
    if (regions > 0) {
      EXPECT_EQ(as_plc.regions, regions) << name;
    }
  }
}

}  // namespace
}  // namespace ccdt
