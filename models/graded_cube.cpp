#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include "models/curves.h"
#include "models/parts.h"

namespace ccdt::models {
namespace {

/// How often the squares are halved on the way to the origin: from 1/2 of the cube to 1/256.
constexpr int halvings = 8;

/// A face of the cube that is laid out in whole steps: the smallest edges are one step long.
struct Face {
  ModelSurface& surface;
  Axis axis;
  std::int64_t height;  ///< along the axis: 0 or `size`
  std::int64_t size;    ///< steps along an edge of the cube
  int marker;
};

std::uint32_t vertex(const Face& face, std::int64_t u, std::int64_t v) {
  // Of whole steps, so that the faces on both sides of an edge have the same bits.
  const auto coordinate = [&](std::int64_t steps) {
    return static_cast<double>(steps) / static_cast<double>(face.size);
  };
  return corner(face.surface, to_model(face.axis, {coordinate(u), coordinate(v), coordinate(face.height)}));
}

void triangle(const Face& face, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  if (face.height == 0) std::swap(b, c);
  add_triangle(face.surface, a, b, c, face.marker);
}

/// Which side of a square meets smaller ones, and so has a vertex in its middle.
enum class SplitSide { none, left, bottom };

void add_square(const Face& face, std::int64_t u, std::int64_t v, std::int64_t side, SplitSide split) {
  const std::uint32_t a = vertex(face, u, v), b = vertex(face, u + side, v);
  const std::uint32_t c = vertex(face, u + side, v + side), d = vertex(face, u, v + side);
  if (split == SplitSide::none) {
    triangle(face, a, b, c);
    triangle(face, a, c, d);
  } else if (split == SplitSide::left) {
    const std::uint32_t middle = vertex(face, u, v + side / 2);
    triangle(face, a, b, middle);
    triangle(face, middle, b, c);
    triangle(face, middle, c, d);
  } else {
    const std::uint32_t middle = vertex(face, u + side / 2, v);
    triangle(face, a, middle, d);
    triangle(face, middle, c, d);
    triangle(face, middle, b, c);
  }
}

/// Squares of one size, `count` by `count`; those of the first column or row may be split at their outer side.
void add_block(const Face& face, std::int64_t u, std::int64_t v, std::int64_t side, int count, SplitSide border) {
  for (int i = 0; i < count; ++i) {
    for (int j = 0; j < count; ++j) {
      const bool at_border = (border == SplitSide::left && i == 0) || (border == SplitSide::bottom && j == 0);
      add_square(face, u + i * side, v + j * side, side, at_border ? border : SplitSide::none);
    }
  }
}

/// A face opposite the origin, in equal squares.
void add_even_face(const Face& face, int count) {
  add_block(face, 0, 0, face.size / (2 * count), 2 * count, SplitSide::none);
}

/// A face at the origin:
///
///     +-------+-------+
///     |       |       |    Three of the quarters have squares of one size; the fourth is divided as the face is, into
///     |       |       |    three quarters with squares of half that size, and so on.
///     +---+---+-------+
///     +---+---+       |
///     +-+-+---+       |
///     +-+-+---+-------+
void add_graded_face(const Face& face, int count) {
  for (int level = 1; level <= halvings; ++level) {
    const std::int64_t quarter = face.size >> level, side = quarter / count;
    const bool is_last = level == halvings;  // what is left has squares of the same size
    add_block(face, quarter, 0, side, count, is_last ? SplitSide::none : SplitSide::left);
    add_block(face, quarter, quarter, side, count, SplitSide::none);
    add_block(face, 0, quarter, side, count, is_last ? SplitSide::none : SplitSide::bottom);
    if (is_last) add_block(face, 0, 0, side, count, SplitSide::none);
  }
}

}  // namespace

plc::InputPlc make_graded_cube(double edge_length) {
  const int count = std::max(1, static_cast<int>(std::lround(0.5 / edge_length)));
  const std::int64_t size = static_cast<std::int64_t>(count) << halvings;
  ModelSurface surface;
  int marker = 0;
  for (const Axis axis : {Axis::x, Axis::y, Axis::z}) {
    add_graded_face({surface, axis, 0, size, ++marker}, count);
    add_even_face({surface, axis, size, size, ++marker}, count);
  }
  return to_input(std::move(surface), plc::InputPlc::Inside::even_odd);
}

}  // namespace ccdt::models
