#include "engine/delaunay/sphere_pencil.h"

#include <algorithm>

#include "engine/geometry/predicates.h"

namespace ccdt::delaunay {
namespace {

constexpr double unit = 0x1p-53;  // of roundings

Point3 magnitudes(const Point3& p) {
  return {std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)};
}

double largest(const Point3& p) {
  return filter::larger(filter::larger(p.x, p.y), p.z);
}

/// The sums of magnitudes in a cross product, for its error bound.
Point3 cross_magnitudes(const Point3& p, const Point3& q) {
  return {std::fabs(p.y * q.z) + std::fabs(p.z * q.y), std::fabs(p.z * q.x) + std::fabs(p.x * q.z),
          std::fabs(p.x * q.y) + std::fabs(p.y * q.x)};
}

/// Finds heights, which are positive for vertices certainly above the face, and for these vertices values that grow
/// with the height of the sphere's center above the face. (There is no selection here: it would be a branch, and
/// prevent vectorization.)
CCDT_WIDE_LANES void find_lifts(VertexBatch& batch, Point3 normal, double normal_error, Point3 twice_to_center) {
  const std::size_t size = batch.size;
  for (std::size_t i = 0; i < size; ++i) {
    const double x = batch.x[i], y = batch.y[i], z = batch.z[i];
    const double height = normal.x * x + normal.y * y + normal.z * z;
    batch.height[i] = height - normal_error * (std::fabs(x) + std::fabs(y) + std::fabs(z));
    batch.value[i] = (x * (x - twice_to_center.x) + y * (y - twice_to_center.y) + z * (z - twice_to_center.z)) / height;
  }
}

/// Values that are negative for vertices certainly outside the sphere.
CCDT_WIDE_LANES void find_powers(VertexBatch& batch, Point3 weight, double volume, double weight_error,
                                 double volume_error) {
  const std::size_t size = batch.size;
  for (std::size_t i = 0; i < size; ++i) {
    const double x = batch.x[i], y = batch.y[i], z = batch.z[i];
    const double length = std::fabs(x) + std::fabs(y) + std::fabs(z), square = x * x + y * y + z * z;
    batch.value[i] = (weight.x * x + weight.y * y + weight.z * z) - volume * square +
                     2 * (weight_error * length + volume_error * square);
  }
}

}  // namespace

SpherePencil::SpherePencil(std::span<const GridVertex> vertices, const std::array<std::uint32_t, 3>& face)
    : v_(vertices),
      face_(face),
      origin_(vertices[face[0]].point),
      b_(vertices[face[1]].point - origin_),
      c_(vertices[face[2]].point - origin_),
      normal_(cross(b_, c_)),
      normal_terms_(cross_magnitudes(b_, c_)),
      bb_(squared_length(b_)),
      cc_(squared_length(c_)),
      size_(filter::larger(largest(magnitudes(b_)), largest(magnitudes(c_)))),
      normal_error_(8 * unit * largest(normal_terms_)),
      normal_length_(std::sqrt(squared_length(normal_))) {
  find_circle();
}

void SpherePencil::find_circle() {
  if (!(normal_length_ > 64 * normal_error_)) return;
  const double relative_error = normal_error_ / normal_length_;
  const double half = 0.5 / (normal_length_ * normal_length_);
  const Point3 to_center = half * (bb_ * cross(c_, normal_) + cc_ * cross(normal_, b_));
  const double radius = std::sqrt(squared_length(to_center));
  const double terms = half * normal_length_ * (bb_ * std::sqrt(cc_) + cc_ * std::sqrt(bb_));
  circle_ = {origin_ + to_center, radius, 4 * (relative_error + 16 * unit) * (terms + radius)};
}

void SpherePencil::accept(std::uint32_t v) {
  apex_ = v;
  const Point3 d = v_[v].point - origin_;
  const double dd = squared_length(d);
  weight_ = bb_ * cross(c_, d) + cc_ * cross(d, b_) + dd * normal_;
  volume_ = dot(normal_, d);
  // Each product has at most eleven roundings.
  weight_error_ =
      16 * unit * largest(bb_ * cross_magnitudes(c_, d) + cc_ * cross_magnitudes(d, b_) + dd * normal_terms_);
  volume_error_ = 16 * unit * dot(normal_terms_, magnitudes(d));
}

void SpherePencil::consider_first(VertexBatch& batch) {
  find_lifts(batch, normal_, normal_error_, 2.0 * (circle_.center - origin_));
  std::size_t best = batch.size;
  double lowest = infinity;
  for (std::size_t i = 0; i < batch.size; ++i)
    if (batch.height[i] > 0 && batch.value[i] < lowest) best = i, lowest = batch.value[i];
  if (best < batch.size) {
    accept(batch.vertices[best]);
    find_powers(batch, weight_, volume_, weight_error_, volume_error_);
  } else {
    batch.value.fill(0);
  }
  // A vertex that passed the other tests may still be slightly better.
  for (std::size_t i = 0; i < batch.size; ++i)
    if (batch.value[i] >= 0) consider(batch.vertices[i]);
}

bool SpherePencil::is_better(std::uint32_t v) const {
  if (v == apex_ || v == face_[0] || v == face_[1] || v == face_[2]) return false;
  const GridVertex &a = v_[face_[0]], &b = v_[face_[1]], &c = v_[face_[2]], &e = v_[v];
  if (orient3d(a.point, b.point, c.point, e.point) <= 0) return false;
  if (apex_ == ghost_vertex) return true;
  const GridVertex& d = v_[apex_];
  return insphere_perturbed(a.point, b.point, c.point, d.point, e.point, {a.rank, b.rank, c.rank, d.rank, e.rank}) > 0;
}

SpherePencil::Cap SpherePencil::cap() const {
  if (!(volume_ > 64 * volume_error_)) return {};
  const double half = 0.5 / volume_;
  const Point3 to_center = half * weight_;
  const double error = 1.1 * half * (weight_error_ + largest(magnitudes(weight_)) * volume_error_ / volume_);
  const double radius = std::sqrt(squared_length(to_center));
  double lift = infinity;
  if (circle_.radius < lift) {
    const double lift_error = 2 * error + (16 * unit + 2 * normal_error_ / normal_length_) * radius;
    lift = std::max(0.0, dot(normal_, to_center) / normal_length_ + lift_error);
    // If the center of the sphere is below the face, the part above it is in the ball of the circle.
    if (lift == 0) return {circle_.center, circle_.radius * (1 + 1e-12) + 2 * circle_.error, lift};
  }
  // The error of the center, in each of three axes, acts on where the ball is and on its radius.
  return {origin_ + to_center, radius * (1 + 1e-12) + 4 * error, lift};
}

}  // namespace ccdt::delaunay
