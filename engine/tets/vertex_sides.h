#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/point.h"

namespace ccdt::tets {

/// One of a few vertices, by number, and a set of them, by bit.
using Corner = std::uint8_t;
using CornerSet = std::uint32_t;

constexpr CornerSet corner_bit(Corner v) {
  return CornerSet{1} << v;
}

/// Three of the vertices.
using CornerTriangle = std::array<Corner, 3>;

/// The vertices strictly on the two sides of a plane.
struct Sides {
  CornerSet above = 0, below = 0;

  Sides flipped() const { return {below, above}; }
  /// \return 1 if the vertex is above, -1 if it is below
  int side(Corner v) const { return static_cast<int>(above >> v & 1) - static_cast<int>(below >> v & 1); }
};

/// The exact sides of a few vertices relative to all triangles between them.
class VertexSides {
 public:
  static constexpr std::size_t most_vertices = 32;

  /// \param points  at most `most_vertices`, on the grid
  void find(std::span<const Point3> points);

  /// The vertices above and below a triangle. From above, its corners are in counterclockwise order.
  Sides of(Corner a, Corner b, Corner c) const { return a < b ? of_row(a, b)[c] : of_row(b, a)[c].flipped(); }
  /// Does the edge pq pass through the inside of the triangle rst? Its ends are on different sides of the triangle.
  bool is_around(const CornerTriangle& triangle, Corner p, Corner q) const;

 private:
  void load(std::span<const Point3> points);
  void find_all();
  Sides find_sides(Corner a, Corner b, Corner c) const;
  void find_certain_sides(const Point3& origin, const Point3& normal, Sides& sides) const;

  static std::size_t row(Corner a, Corner b) { return b * (b - std::size_t{1}) / 2 + a; }
  const Sides* of_row(Corner a, Corner b) const { return &sides_[row(a, b) * points_.size()]; }

  std::vector<Point3> points_;
  std::array<double, most_vertices> x_{}, y_{}, z_{};
  double error_ = 0;          // of six volumes in floating point
  std::vector<Sides> sides_;  // in a row for each pair a < b, by the third corner
};

}  // namespace ccdt::tets
