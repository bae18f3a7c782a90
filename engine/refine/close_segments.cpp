#include "engine/refine/close_segments.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "engine/base/box_tree.h"
#include "engine/base/closest_on_segment.h"
#include "engine/base/index_lists.h"
#include "engine/base/union_find.h"
#include "engine/protection/segment_chains.h"

namespace ccdt::refine {
namespace {

/// Segments are too close if they are at most this many steps apart. A step is the distance between the places for
/// vertices on the longer one.
constexpr double close_steps = 1;

/// Squared sine of a small angle between segments: 30 degrees.
constexpr double small_angle = 0.25;

class CloseSegmentSearch {
 public:
  explicit CloseSegmentSearch(const plc::Plc& plc)
      : plc_(plc), least_(plc.segments.size(), {no_small_angle, no_small_angle}) {
    segments_of_vertex_ = make_index_lists(plc.vertices.size(), [&](const auto& emit) {
      for (std::uint32_t s = 0; s < plc_.segments.size(); ++s)
        for (const VertexId v : plc_.segments[s].ends) emit(v, s);
    });
  }

  std::vector<LeastDistances> run() {
    for (std::uint32_t v = 0; v < plc_.vertices.size(); ++v) compare_at(v);
    compare_at_distance();
    return std::move(least_);
  }

 private:
  const Point3& point(std::uint32_t v) const { return plc_.vertices[v]; }
  double length_of(std::uint32_t s) const {
    const auto& [a, b] = plc_.segments[s].ends;
    return length(point(b) - point(a));
  }
  /// The distance between neighboring places for vertices.
  double step_of(std::uint32_t s) const { return length_of(s) * protection::usual_step / protection::whole_segment; }
  std::uint32_t other_end(std::uint32_t s, std::uint32_t v) const {
    const auto& [a, b] = plc_.segments[s].ends;
    return a == v ? b : a;
  }
  double& least_at(std::uint32_t s, std::uint32_t v) { return least_[s][plc_.segments[s].ends[0] == v ? 0 : 1]; }

  /// Compares the segments that meet at a vertex. Those that are joined by small angles form a fan. A vertex on one of
  /// these encroaches on all others, so the closest two decide for the whole fan.
  void compare_at(std::uint32_t v) {
    const auto around = segments_of_vertex_.of(v);
    UnionFind fans(around.size());
    std::vector<double> least(around.size(), no_small_angle);
    for (std::uint32_t i = 0; i < around.size(); ++i) {
      for (std::uint32_t j = 0; j < i; ++j) {
        const double distance = least_distance(around[i], around[j], v);
        if (distance == no_small_angle) continue;
        fans.join(i, j);
        least[i] = std::max(least[i], distance);
      }
    }
    for (std::uint32_t i = 0; i < around.size(); ++i) {
      double& of_fan = least[fans.find(i)];
      of_fan = std::max(of_fan, least[i]);
    }
    for (std::uint32_t i = 0; i < around.size(); ++i) least_at(around[i], v) = least[fans.find(i)];
  }

  /// The least distance from the common end of two segments at which they are so far apart that places on both fit each
  /// other.
  double least_distance(std::uint32_t s, std::uint32_t t, std::uint32_t v) const {
    const Point3 a = point(other_end(s, v)) - point(v), b = point(other_end(t, v)) - point(v);
    const double squared_sine = squared_length(cross(a, b)) / (squared_length(a) * squared_length(b));
    if (dot(a, b) <= 0 || squared_sine >= small_angle) return no_small_angle;
    const double step = std::max(step_of(s), step_of(t));
    // Only protected segments are split because of each other.
    if (!plc_.segments[s].grazeable || !plc_.segments[t].grazeable) return step;
    // At a distance r they are r sin apart. Vertices there fit each other if their distances differ by at most a
    // multiple of (r sin)^2 / r.
    return squared_sine > 0 ? close_steps * step / squared_sine : no_vertices;
  }

  /// Compares segments without a common end.
  void compare_at_distance() {
    double longest_step = 0;
    for (std::uint32_t s = 0; s < plc_.segments.size(); ++s) longest_step = std::max(longest_step, step_of(s));
    std::vector<Box> boxes;
    for (const Point3& p : plc_.vertices) boxes.push_back(expanded(box_of(p), close_steps * longest_step));
    const BoxTree tree(std::move(boxes));
    for (std::uint32_t s = 0; s < plc_.segments.size(); ++s) {
      const auto& [a, b] = plc_.segments[s].ends;
      tree.for_each_meeting(LineSegment{point(a), point(b) - point(a)}, [&](std::uint32_t v) {
        if (v == a || v == b) return;
        for (const std::uint32_t other : segments_of_vertex_.of(v))
          if (run_side_by_side(s, other)) least_[s] = least_[other] = {no_vertices, no_vertices};
      });
    }
  }

  /// Are at least two of the four ends close to the other segment?
  bool run_side_by_side(std::uint32_t s, std::uint32_t t) const {
    const double most = close_steps * std::max(step_of(s), step_of(t));
    const auto is_close = [&](std::uint32_t v, std::uint32_t segment) {
      const auto& [a, b] = plc_.segments[segment].ends;
      return squared_length(closest_on_segment(point(v), point(a), point(b)) - point(v)) <= most * most;
    };
    int count = 0;
    for (const VertexId v : plc_.segments[s].ends)
      if (v != plc_.segments[t].ends[0] && v != plc_.segments[t].ends[1]) count += is_close(v, t) ? 1 : 0;
    for (const VertexId v : plc_.segments[t].ends) count += is_close(v, s) ? 1 : 0;  // a common end counts here
    return count >= 2;
  }

  const plc::Plc& plc_;
  IndexLists segments_of_vertex_;
  std::vector<LeastDistances> least_;
};

}  // namespace

std::vector<LeastDistances> find_close_segments(const plc::Plc& plc) {
  return CloseSegmentSearch(plc).run();
}

}  // namespace ccdt::refine
