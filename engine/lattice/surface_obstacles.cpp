#include "engine/lattice/surface_obstacles.h"

#include <cstdint>
#include <vector>

#include "engine/base/count_work.h"
#include "engine/base/parallel.h"
#include "engine/geometry/balls.h"
#include "engine/geometry/closest_point.h"
#include "engine/lattice/clear_sites.h"

namespace ccdt::lattice {
namespace {

constexpr std::size_t obstacle_grain = 1024;  ///< of loops on several threads

}  // namespace

RawVector<Obstacle> list_obstacles(const DomainSurface& surface, double sphere_factor) {
  const auto obstacle = [&](const std::array<VertexId, 3>& vertices, bool needs_clearance, Ball ball) {
    ball.radius *= sphere_factor;
    return Obstacle{vertices, needs_clearance, ball, sphere_factor > 0 ? ball.radius * ball.radius : -1};
  };
  std::vector<bool> in_triangle(surface.vertices.size(), false);
  for (const SurfaceTriangle& t : surface.triangles)
    for (const VertexId v : t.vertices) in_triangle[v] = true;
  const std::size_t triangles = surface.triangles.size(), subsegments = surface.subsegments.size();
  RawVector<Obstacle> obstacles(triangles + subsegments);
  parallel_for(triangles, obstacle_grain, [&](std::size_t t) {
    obstacles[t] =
        obstacle(surface.triangles[t].vertices, true, smallest_ball(surface.corners(static_cast<std::uint32_t>(t))));
  });
  parallel_for(subsegments, obstacle_grain, [&](std::size_t s) {
    const auto& [a, b] = surface.subsegments[s];
    obstacles[triangles + s] = obstacle({a, b, b}, !in_triangle[a] || !in_triangle[b],
                                        smallest_ball(surface.vertices[a], surface.vertices[b]));
  });
  for (std::size_t i = 0; i < in_triangle.size(); ++i)
    if (const VertexId v(i); !in_triangle[i]) obstacles.push_back(obstacle({v, v, v}, true, {surface.vertices[v], 0}));
  return obstacles;
}

SurfaceObstacles::SurfaceObstacles(const DomainSurface& surface, double sphere_factor)
    : surface_(surface), obstacles_(list_obstacles(surface, sphere_factor)), tree_(obstacles_, [&](const Obstacle& o) {
        const Box box = bounding_box(surface.corners(o.vertices));
        return o.squared_ball_radius < 0 ? box : hull(box, expanded(box_of(o.ball.center), o.ball.radius));
      }) {}

bool SurfaceObstacles::reach(const Point3& p, double clearance) const {
  bool is_reached = false;
  std::uint64_t tested = 0;
  const double squared_clearance = clearance * clearance;
  tree_.for_each_meeting(Ball{p, clearance}, [&](std::uint32_t i) {
    if (is_reached) return;
    const Obstacle& o = obstacles_[i];
    ++tested;
    is_reached = squared_length(p - o.ball.center) <= o.squared_ball_radius ||
                 (o.needs_clearance && squared_distance(surface_.corners(o.vertices), p) <= squared_clearance);
  });
  ++work_done.sites_tested;
  work_done.obstacles_tested += tested;
  return is_reached;
}

}  // namespace ccdt::lattice
