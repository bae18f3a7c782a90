#include "engine/refine/close_segments.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "engine/base/index_lists.h"
#include "engine/geometry/box_tree.h"
#include "engine/geometry/closest_point.h"
#include "engine/protection/segment_chains.h"
#include "engine/refine/segment_fans.h"

namespace ccdt::refine {
namespace {

/// Segments are too close if they are at most this many steps apart. A step is the distance between possible vertices
/// on the longer one.
constexpr double close_steps = 1;

/// Near the common vertex of a fan, where possible vertices do not fit each other exactly, protection may split a piece
/// about this often. On pleated cones with angles of 0.003 to 0.00003, protection adds 0.5 to 2.6 vertices for each
/// vertex of refinement. With 1, pieces stay so long that the mean r is up to 2,600 times as large; without a limit,
/// splitting might not end.
constexpr double most_splits = 100;

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
  /// The distance between neighboring possible vertices.
  double step_of(std::uint32_t s) const { return length_of(s) * protection::usual_step / protection::whole_segment; }
  std::uint32_t other_end(std::uint32_t s, std::uint32_t v) const {
    const auto& [a, b] = plc_.segments[s].ends;
    return a == v ? b : a;
  }
  double& least_at(std::uint32_t s, std::uint32_t v) { return least_[s][plc_.segments[s].ends[0] == v ? 0 : 1]; }

  /// Compares the segments that meet at a vertex.
  void compare_at(std::uint32_t v) {
    const auto around = segments_of_vertex_.of(v);
    std::vector<Spoke> spokes;
    for (const std::uint32_t s : around)
      spokes.push_back({point(other_end(s, v)) - point(v), step_of(s), plc_.segments[s].grazeable});
    const std::vector<double> distances = find_fan_distances(spokes);
    for (std::uint32_t i = 0; i < around.size(); ++i) least_at(around[i], v) = distances[i] / most_splits;
  }

  /// Compares segments without a common end.
  void compare_at_distance() {
    double longest_step = 0;
    for (std::uint32_t s = 0; s < plc_.segments.size(); ++s) longest_step = std::max(longest_step, step_of(s));
    const BoxTree tree(plc_.vertices, [&](const Point3& p) { return expanded(box_of(p), close_steps * longest_step); });
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
