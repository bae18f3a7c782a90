#include "engine/protection/voronoi_face.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace ccdt::protection {

using delaunay::Delaunay;

void gather_ring(const Delaunay& d, std::uint32_t a, std::uint32_t b, std::uint32_t first, EdgeRing& ring) {
  ring.cells.clear(), ring.vertices.clear();
  walk_around_edge(d, a, b, first, [&](std::uint32_t here, std::uint32_t, std::uint32_t staying) {
    ring.cells.push_back(here);
    const std::uint32_t v = d.cells[here].vertices[staying];
    if (v != delaunay::ghost_vertex) ring.vertices.push_back(v);
    return true;
  });
  std::ranges::sort(ring.vertices);
}

void VoronoiFace::make(const Delaunay& d, std::uint32_t a, std::uint32_t b, const EdgeRing& ring) {
  const Point3 along = d.point(b) - d.point(a);
  middle_ = 0.5 * (d.point(a) + d.point(b));
  squared_half_ = 0.25 * squared_length(along);
  const Point3 across = std::abs(along.x) < std::abs(along.y) ? Point3{1, 0, 0} : Point3{0, 1, 0};
  u_ = normalized(cross(along, across)), w_ = normalized(cross(along, u_));
  halves_.clear();
  for (const std::uint32_t v : ring.vertices) {
    const Point3 to = d.point(v) - middle_;
    halves_.push_back({{ccdt::dot(u_, to), ccdt::dot(w_, to)}, 0.5 * (squared_length(to) - squared_half_)});
  }
}

bool VoronoiFace::is_empty(const Place& center) const {
  const double slack = margin * squared_radius(center);
  return std::ranges::all_of(halves_, [&](const HalfPlane& h) { return dot(h.normal, center) + slack < h.bound; });
}

Ball VoronoiFace::ball(const Place& center) const {
  return {middle_ + center.x * u_ + center.y * w_, std::sqrt(squared_radius(center) * (1 + margin))};
}

Ball VoronoiFace::covering_ball() {
  // An edge much shorter than those around it has centers far away. Small distances are tried first: the nearer all
  // centers are, the smaller the allowance for rounding.
  for (const double half_lengths : {farthest, 1e2 * farthest, 1e4 * farthest, 1e6 * farthest}) {
    const double far = half_lengths * std::sqrt(squared_half_);
    make_polygon(far, margin * far * far);  // contains all of the true polygon that is not too far away
    const auto is_inside = [&](const Place& p) { return std::max(std::abs(p.x), std::abs(p.y)) < far; };
    if (polygon_.empty() || !std::ranges::all_of(polygon_, is_inside)) continue;
    const Place center = center_of_polygon();
    double reach = 0;
    for (const Place& p : polygon_)
      reach = std::max(reach, std::sqrt(dot(p - center, p - center)) + std::sqrt(squared_radius(p)));
    return {middle_ + center.x * u_ + center.y * w_, (1 + margin) * reach};
  }
  return {middle_, HUGE_VAL};
}

/// \param far    places farther from the edge are left out
/// \param slack  added to the bounds
void VoronoiFace::make_polygon(double far, double slack) {
  polygon_.assign({{far, far}, {-far, far}, {-far, -far}, {far, -far}});
  for (const HalfPlane& half : halves_) clip({half.normal, half.bound + slack});
}

VoronoiFace::Place VoronoiFace::center_of_polygon() const {
  Place center;
  for (const Place& p : polygon_) center = center + (1.0 / static_cast<double>(polygon_.size())) * p;
  return center;
}

void VoronoiFace::clip(const HalfPlane& half) {
  clipped_.clear();
  for (std::size_t i = 0; i < polygon_.size(); ++i) {
    const Place &a = polygon_[i], &b = polygon_[i + 1 < polygon_.size() ? i + 1 : 0];
    const double over_a = dot(half.normal, a) - half.bound, over_b = dot(half.normal, b) - half.bound;
    if (over_a <= 0) clipped_.push_back(a);
    if ((over_a < 0 && over_b > 0) || (over_a > 0 && over_b < 0))
      clipped_.push_back(a + (over_a / (over_a - over_b)) * (b - a));
  }
  polygon_.swap(clipped_);
}

VoronoiFace::Place VoronoiFace::nearest_to_middle() const {
  Place best = polygon_[0];
  for (std::size_t i = 0; i < polygon_.size(); ++i) {
    const Place &a = polygon_[i], along = polygon_[i + 1 < polygon_.size() ? i + 1 : 0] - a;
    const double squared = dot(along, along);
    const Place p = a + (squared > 0 ? std::clamp(-dot(a, along) / squared, 0.0, 1.0) : 0) * along;
    if (dot(p, p) < dot(best, best)) best = p;
  }
  return best;
}

}  // namespace ccdt::protection
