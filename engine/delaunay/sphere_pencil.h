#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

#include "engine/delaunay/delaunay.h"
#include "engine/geometry/filters.h"

namespace ccdt::delaunay {

inline constexpr double infinity = std::numeric_limits<double>::infinity();

/// A vertex in the searches of the grid.
struct GridVertex {
  Point3 point;  ///< relative to the low corner of all points, exactly
  std::uint32_t rank = 0;
  std::uint32_t id = 0;
};

/// Vertices that are looked at together, in lanes: relative to the first corner of the face.
struct VertexBatch {
  static constexpr std::size_t capacity = 256;

  std::size_t size = 0;
  std::array<double, capacity> x, y, z, height, value;
  std::array<std::uint32_t, capacity> vertices;
};

/// The spheres through the corners of a face. The candidate for the fourth vertex determines one of them.
/// Floating-point tests with certified error bounds precede the exact ones. For a vertex e relative to the first corner
/// (an exact difference):
///   normal . e > 0                      e is above the face
///   weight . e - volume * e^2 > 0       e is inside the sphere
class SpherePencil {
 public:
  SpherePencil(std::span<const GridVertex> vertices, const std::array<std::uint32_t, 3>& face);

  /// The candidate; `ghost_vertex` if there is none yet.
  std::uint32_t apex() const { return apex_; }
  const Point3& origin() const { return origin_; }
  const Point3& normal() const { return normal_; }
  double normal_length() const { return normal_length_; }
  /// Error of normal . e for an e whose coordinates' magnitudes sum to 1.
  double normal_error() const { return normal_error_; }
  /// The largest distance of corners from the first one, along an axis.
  double size() const { return size_; }

  /// Makes the vertex the candidate if it is above the face and inside the sphere.
  CCDT_ALWAYS_INLINE void consider(std::uint32_t v) {
    const Point3 e = v_[v].point - origin_;
    const double length = std::fabs(e.x) + std::fabs(e.y) + std::fabs(e.z), square = squared_length(e);
    const double power = dot(weight_, e) - volume_ * square,
                 power_error = weight_error_ * length + volume_error_ * square;
    if (power < -power_error) return;
    const double height = dot(normal_, e), height_error = normal_error_ * length;
    if (height < -height_error) return;
    if ((power > power_error && height > height_error) || is_better(v)) accept(v);
  }

  /// Considers all vertices at once, if there is no candidate yet and the circle is known. Overwrites the values.
  void consider_first(VertexBatch& batch);

  /// Makes a vertex strictly above the face the candidate.
  void accept(std::uint32_t v);

  /// The circle through the corners, in their plane.
  struct Circle {
    Point3 center;
    double radius = infinity;  ///< infinite: not known
    double error = 0;          ///< at most this, of center and radius
  };
  const Circle& circle() const { return circle_; }

  /// The part of the sphere that is above the face.
  struct Cap {
    Point3 center;  ///< of a ball that holds it
    double radius = infinity;
    /// An upper bound of the height of the sphere's center above the face, at least zero.
    double lift = infinity;
  };
  Cap cap() const;

 private:
  bool is_better(std::uint32_t v) const;
  void find_circle();

  std::span<const GridVertex> v_;
  std::array<std::uint32_t, 3> face_;
  Point3 origin_, b_, c_, normal_, normal_terms_;
  double bb_, cc_, size_, normal_error_, normal_length_;
  Circle circle_;
  std::uint32_t apex_ = ghost_vertex;
  // Without a candidate every vertex is inside.
  Point3 weight_;
  double volume_ = 0, weight_error_ = 0, volume_error_ = 0;
};

}  // namespace ccdt::delaunay
