#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/index.h"

namespace ccdt::planar {

struct Point2 {
  double x = 0, y = 0;
};

/// Points in a plane as a model of `Predicates`: vertex i is point i.
///
/// The points are rounded to a square grid of 2^26 cells across their bounding box (a relative change of at most 2^-27;
/// points closer than this may coincide). On the grid both predicates are exact. Where they would be zero, `incircle`
/// is decided by the ids (the lifted height of a vertex is raised by an infinitesimal amount, infinitely more for a
/// smaller id), so the constrained Delaunay triangulation is unique.
class Points {
 public:
  explicit Points(std::span<const Point2> points);

  int orient(VertexId a, VertexId b, VertexId c) const;
  int incircle(VertexId a, VertexId b, VertexId c, VertexId d) const;

  std::size_t size() const { return grid_.size(); }

 private:
  struct GridPoint {
    std::int64_t x, y;
  };
  std::vector<GridPoint> grid_;
};

}  // namespace ccdt::planar
