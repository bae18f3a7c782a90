#include "engine/circumcenters/surface_obstacles.h"

#include <cmath>
#include <cstdint>

#include "engine/base/count_work.h"
#include "engine/base/parallel.h"
#include "engine/geometry/balls.h"
#include "engine/geometry/closest_point.h"

namespace ccdt::circumcenters {
namespace {

constexpr std::size_t obstacle_grain = 2048;  ///< of loops on several threads

}  // namespace

SurfaceObstacles::SurfaceObstacles(const lattice::DomainSurface& surface, double sphere_factor)
    : obstacles_(list(surface, sphere_factor)), tree_(boxes_of(obstacles_)) {}

bool SurfaceObstacles::reach(const Point3& p, double clearance) const {
  bool is_reached = false;
  std::uint64_t tested = 0;
  const double squared_clearance = clearance * clearance;
  tree_.for_each_meeting(Ball{p, clearance}, [&](std::uint32_t i) {
    if (is_reached) return;
    const Obstacle& o = obstacles_[i];
    ++tested;
    is_reached = squared_length(p - o.ball_center) <= o.squared_ball_radius ||
                 (o.needs_clearance && squared_distance(o.corners, p) <= squared_clearance);
  });
  ++work_done.sites_tested;
  work_done.obstacles_tested += tested;
  return is_reached;
}

RawVector<SurfaceObstacles::Obstacle> SurfaceObstacles::list(const lattice::DomainSurface& surface,
                                                             double sphere_factor) {
  constexpr double no_ball = -1;
  const auto obstacle = [&](const lattice::TrianglePoints& corners, const Ball& ball, bool needs_clearance) {
    const double radius = ball.radius * sphere_factor;
    return Obstacle{corners, ball.center, sphere_factor > 0 ? radius * radius : no_ball, needs_clearance};
  };
  std::vector<bool> in_triangle(surface.vertices.size(), false);
  for (const lattice::SurfaceTriangle& t : surface.triangles)
    for (const VertexId v : t.vertices) in_triangle[v] = true;
  const std::size_t triangles = surface.triangles.size(), subsegments = surface.subsegments.size();
  RawVector<Obstacle> obstacles(triangles + subsegments);
  parallel_for(triangles, obstacle_grain, [&](std::size_t t) {
    const lattice::TrianglePoints corners = surface.corners(static_cast<std::uint32_t>(t));
    obstacles[t] = obstacle(corners, smallest_ball(corners), true);
  });
  parallel_for(subsegments, obstacle_grain, [&](std::size_t s) {
    const auto& [a, b] = surface.subsegments[s];
    const Point3 &from = surface.vertices[a], &to = surface.vertices[b];
    obstacles[triangles + s] = obstacle({from, to, to}, smallest_ball(from, to), !in_triangle[a] || !in_triangle[b]);
  });
  for (std::size_t v = 0; v < in_triangle.size(); ++v) {
    const Point3& p = surface.vertices[v];
    if (!in_triangle[v]) obstacles.push_back(obstacle({p, p, p}, {p, 0}, true));
  }
  return obstacles;
}

RawVector<Box> SurfaceObstacles::boxes_of(const RawVector<Obstacle>& obstacles) {
  RawVector<Box> boxes(obstacles.size());
  parallel_for(obstacles.size(), obstacle_grain, [&](std::size_t i) {
    const Obstacle& o = obstacles[i];
    const double radius = o.squared_ball_radius > 0 ? std::sqrt(o.squared_ball_radius) : 0;
    boxes[i] = hull(bounding_box(o.corners), expanded(box_of(o.ball_center), radius));
  });
  return boxes;
}

}  // namespace ccdt::circumcenters
