#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/delaunay/delaunay.h"

namespace ccdt::protection {

/// The vertex that sees a piece of a segment at the largest obtuse angle, so far.
class WorstVertex {
 public:
  WorstVertex(const Point3& a, const Point3& b) : a_(a), b_(b) {}
  void examine(std::uint32_t v, const Point3& p) {
    const Point3 to_a = a_ - p, to_b = b_ - p;
    const double product = dot(to_a, to_b);
    if (product >= 0) return;
    const double cosine = product / std::sqrt(squared_length(to_a) * squared_length(to_b));
    // Among equal ones, the least vertex, whatever the order of the cells.
    if (cosine > least_cosine_ || (cosine == least_cosine_ && v >= vertex_.value_or(0))) return;
    least_cosine_ = cosine;
    vertex_ = v;
  }
  /// None if no vertex is in the diametral sphere.
  std::optional<std::uint32_t> vertex() const { return vertex_; }
  /// How far from the piece can a point be that sees it at an angle at least as large? With room for rounding.
  double width() const;

 private:
  Point3 a_, b_;  ///< the ends of the piece
  std::optional<std::uint32_t> vertex_;
  double least_cosine_ = 0;
};

/// Searches the diametral balls of pieces; keeps its working memory between searches.
class DiametralSearch {
 public:
  explicit DiametralSearch(const delaunay::Delaunay& delaunay) : d_(delaunay) {}

  /// Finds the worst of all vertices.
  ///
  /// \param a, b  the ends of the piece
  /// \return false if there are too many vertices around the piece
  bool find_worst(std::uint32_t a, std::uint32_t b, WorstVertex& worst);

 private:
  std::uint32_t cell_at(std::uint32_t v) const;
  template <class IsInside>
  bool spread(std::uint32_t first, WorstVertex& worst, const IsInside& is_inside);

  enum class Where : std::uint8_t { unknown, inside, outside };

  const delaunay::Delaunay& d_;
  std::vector<std::uint32_t> cells_;    ///< those with a vertex inside
  std::vector<std::uint8_t> is_found_;  ///< by cell: is it one of these?
  std::vector<Where> where_;            ///< by vertex
  std::vector<std::uint32_t> met_;      ///< vertices of these cells
};

/// Would the vertex v be joined to a new vertex at p, which is in the convex hull?
bool would_be_joined(const delaunay::Delaunay& d, std::uint32_t v, const Point3& p);

}  // namespace ccdt::protection
