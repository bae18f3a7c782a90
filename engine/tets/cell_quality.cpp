#include "engine/tets/cell_quality.h"

#include <algorithm>
#include <limits>

#include "engine/base/count_work.h"
#include "engine/geometry/filters.h"

namespace ccdt::tets {

namespace {

// The edges u, v, w of a tetrahedron lead from its apex to the corners of its base.

CCDT_ALWAYS_INLINE double inverse_r_from(const Point3& u, const Point3& v, const Point3& w) {
  const double det = dot(u, cross(w, v));
  const double mean =
      0.5 * (squared_length(u) + squared_length(v) + squared_length(w)) - (dot(u, v) + dot(v, w) + dot(w, u)) / 3;
  return inverse_r_of(det, mean);
}

CCDT_ALWAYS_INLINE double least_sine_from(const Point3& u, const Point3& v, const Point3& w) {
  const Point3 vw = cross(w, v), wu = cross(u, w), uv = cross(v, u);
  const double det = dot(u, vw);
  // Inverted squares of twice the areas of the faces opposite a, b, c, d.
  const double fa = 1 / squared_length(vw), fb = 1 / squared_length(wu), fc = 1 / squared_length(uv);
  const double fd = 1 / squared_length(vw + wu + uv);
  const auto smaller = [](double a, double b) { return b < a ? b : a; };
  double least = smaller(squared_length(u) * fb * fc, squared_length(v) * fa * fc);
  least = smaller(least, squared_length(w) * fa * fb);
  least = smaller(least, squared_length(v - u) * fc * fd);
  least = smaller(least, squared_length(w - v) * fa * fd);
  least = smaller(least, squared_length(u - w) * fb * fd);
  return det * std::sqrt(least);
}

constexpr std::size_t lanes = 8;  ///< tetrahedra that are measured at the same time

/// Coordinates of the edges of several tetrahedra.
struct Edges {
  std::array<double, lanes> ux, uy, uz, vx, vy, vz, wx, wy, wz;
};

/// Without branches. For a tetrahedron with a shape below the least shape, the quality is this shape.
CCDT_WIDE_LANES void measure(const Edges& e, double least_shape, double offset, std::array<double, lanes>& qualities) {
  for (std::size_t i = 0; i < lanes; ++i) {
    const Point3 u{e.ux[i], e.uy[i], e.uz[i]}, v{e.vx[i], e.vy[i], e.vz[i]}, w{e.wx[i], e.wy[i], e.wz[i]};
    const double shape = inverse_r_from(u, v, w), sine = offset + least_sine_from(u, v, w);
    qualities[i] = shape < least_shape ? shape : sine;
  }
}

}  // namespace

double inverse_r(const Point3& a, const Point3& b, const Point3& c, const Point3& d) {
  return inverse_r_from(a - d, b - d, c - d);
}

double least_sine(const Point3& a, const Point3& b, const Point3& c, const Point3& d) {
  return least_sine_from(a - d, b - d, c - d);
}

double cell_quality(const QualityGoal& goal, const Point3& a, const Point3& b, const Point3& c, const Point3& d) {
  ++work_done.quality_evaluations;
  if (goal.is_of_r())
    if (const double shape = inverse_r(a, b, c, d); shape < goal.inverse_r) return shape;
  return goal.offset() + least_sine(a, b, c, d);
}

void compute_qualities(const QualityGoal& goal, std::span<const Point3> points, std::span<const delaunay::Cell> cells,
                       std::span<double> qualities) {
  work_done.quality_evaluations += cells.size();
  const double least_shape = goal.is_of_r() ? goal.inverse_r : -std::numeric_limits<double>::infinity();
  Edges e{};
  std::array<double, lanes> some;
  for (std::size_t first = 0; first < cells.size(); first += lanes) {
    const std::size_t count = std::min(lanes, cells.size() - first);
    for (std::size_t i = 0; i < count; ++i) {
      const auto& cell = cells[first + i].vertices;
      const Point3& d = points[cell[3]];
      const Point3 u = points[cell[0]] - d, v = points[cell[1]] - d, w = points[cell[2]] - d;
      e.ux[i] = u.x, e.uy[i] = u.y, e.uz[i] = u.z;
      e.vx[i] = v.x, e.vy[i] = v.y, e.vz[i] = v.z;
      e.wx[i] = w.x, e.wy[i] = w.y, e.wz[i] = w.z;
    }
    measure(e, least_shape, goal.offset(), some);
    std::copy_n(some.begin(), count, qualities.begin() + static_cast<std::ptrdiff_t>(first));
  }
}

}  // namespace ccdt::tets
