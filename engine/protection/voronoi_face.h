#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "engine/base/box.h"
#include "engine/delaunay/delaunay.h"

namespace ccdt::protection {

/// The cells around a Delaunay edge, and in increasing order their vertices that are not on the edge, without the ghost
/// vertex. What is computed from the vertices, and rounded, does not depend on the order of the cells in memory.
struct EdgeRing {
  std::vector<std::uint32_t> cells, vertices;
};

/// \param first  one of the cells around the edge ab
void gather_ring(const delaunay::Delaunay& d, std::uint32_t a, std::uint32_t b, std::uint32_t first, EdgeRing& ring);

/// The face of the Voronoi diagram that is dual to a Delaunay edge: the centers of the empty spheres through the edge's
/// ends. It is a convex polygon in the plane that bisects the edge. It is computed in floating point, but all spheres
/// that it offers are empty by a margin. So it offers none if the polygon is too small.
class VoronoiFace {
 public:
  /// \param d     points in grid units
  /// \param ring  of the edge ab
  void make(const delaunay::Delaunay& d, std::uint32_t a, std::uint32_t b, const EdgeRing& ring);

  /// Empty by a margin, like all balls that are visited.
  bool smallest_ball_is_empty() const { return is_empty({}); }

  /// Calls visit(ball) for a few of the empty spheres, the smallest one first, until `visit` returns false. The balls
  /// are enlarged by much more than their rounding, so a point outside a ball is outside the true sphere.
  template <class Visit>
  void visit_empty_balls(const Visit& visit) {
    if (is_empty({}) && !visit(ball({}))) return;
    make_polygon(farthest * std::sqrt(squared_half_), 0);
    if (polygon_.empty()) return;
    const Place center = center_of_polygon();
    const auto visit_near = [&](const Place& p) {
      const Place inner = p + inward * (center - p);
      return !is_empty(inner) || visit(ball(inner));
    };
    if (!visit_near(nearest_to_middle()) || !visit_near(center)) return;
    for (const Place& corner : polygon_)
      if (!visit_near(corner)) return;
  }

  /// A ball that holds the spheres of all cells around the edge.
  Ball covering_ball();

 private:
  /// A place in the plane of the face, seen from the middle of the edge.
  struct Place {
    double x = 0, y = 0;

    friend Place operator+(const Place& a, const Place& b) { return {a.x + b.x, a.y + b.y}; }
    friend Place operator-(const Place& a, const Place& b) { return {a.x - b.x, a.y - b.y}; }
    friend Place operator*(double s, const Place& a) { return {s * a.x, s * a.y}; }
    friend double dot(const Place& a, const Place& b) { return a.x * b.x + a.y * b.y; }
  };
  /// The centers that are not nearer to a vertex than to the edge's ends: the places p with normal . p <= bound.
  struct HalfPlane {
    Place normal;
    double bound;
  };
  /// Centers farther from the edge than this many times half its length are left out: their spheres are nearly
  /// half-spaces.
  static constexpr double farthest = 100;
  static constexpr double margin = 1e-9;  ///< of squared radii
  static constexpr double inward = 1e-3;  ///< by this share of the way, a place of the polygon is moved to the center

  double squared_radius(const Place& center) const { return squared_half_ + dot(center, center); }
  bool is_empty(const Place& center) const;
  Ball ball(const Place& center) const;
  void make_polygon(double far, double slack);
  Place center_of_polygon() const;
  void clip(const HalfPlane& half);
  Place nearest_to_middle() const;

  Point3 middle_, u_, w_;    ///< of the edge; unit vectors of the plane
  double squared_half_ = 0;  ///< of the edge's length
  std::vector<HalfPlane> halves_;
  std::vector<Place> polygon_, clipped_;
};

}  // namespace ccdt::protection
