#include "engine/repair/arrange_cuts.h"

#include <algorithm>
#include <optional>
#include <tuple>

#include "engine/base/box.h"
#include "engine/base/index_lists.h"
#include "engine/base/parallel.h"
#include "engine/geometry/box_tree.h"
#include "engine/geometry/integer_points.h"

namespace ccdt::repair {
namespace {

using plc::VertexTriple;
using Triangle = std::array<Point3, 3>;

/// Divides the cuts of one triangle.
class TriangleArranger {
 public:
  TriangleArranger(std::span<const Point3> vertices, const plc::TriangleSet& triangles, std::span<const Cut> cuts,
                   std::span<const std::uint32_t> own)
      : corners_(plc::points_of(vertices, triangles.corners[cuts[own[0]].triangle])), axis_(dominant_axis(corners_)) {
    result_.triangle = cuts[own[0]].triangle;
    for (const std::uint32_t c : own) add(cuts[c], plc::points_of(vertices, triangles.corners[cuts[c].by]));
  }

  Arrangement run() && {
    divide_cuts();
    for (const Line& line : lines_) collect(line);
    std::ranges::sort(result_.on_edges, {},
                      [](const auto& p) { return std::tuple(p.first, p.second.x, p.second.y, p.second.z); });
    const auto again = std::ranges::unique(result_.on_edges);
    result_.on_edges.erase(again.begin(), again.end());
    return std::move(result_);
  }

 private:
  /// The line of a cut in the plane of the triangle.
  struct Line {
    bool is_edge;  ///< of a triangle in the same plane, through a and b; otherwise the line is in `plane`
    Point3 a, b;
    ExactPlane plane;
    std::vector<std::uint32_t> points;  ///< of the cut: at first its two ends
  };

  struct Place {
    ExactPoint exact;
    Point3 rounded;
    std::optional<unsigned> edges;  ///< of the triangle that the point is on: a bit for each
  };

  void add(const Cut& cut, const Triangle& by) {
    Line line{cut.edge != Cut::in_plane, {}, {}, {}, {}};
    if (line.is_edge) {
      const auto k = static_cast<std::size_t>(cut.edge);
      line.a = by[k], line.b = by[plc::next_corner(k)];
    } else {
      line.plane = plane_of(by);
    }
    for (const ExactPoint& end : cut.ends) line.points.push_back(add_place(end));
    lines_.push_back(std::move(line));
  }

  std::uint32_t add_place(ExactPoint point) {
    const Point3 rounded_point = rounded(point);
    places_.push_back({std::move(point), rounded_point, {}});
    return static_cast<std::uint32_t>(places_.size() - 1);
  }

  int side_of(const Line& line, std::uint32_t point) const {
    const ExactPoint& p = places_[point].exact;
    return line.is_edge ? side_of_line(axis_, line.a, line.b, p) : side_of_plane(line.plane, p);
  }

  void divide_cuts() {
    const auto box = [&](const Line& line) {
      const auto end = [&](std::size_t i) { return box_of(places_[line.points[i]].rounded); };
      return expanded(hull(end(0), end(1)), DyadicGrid::quantum);  // more than the rounding
    };
    BoxTree(lines_, box).for_each_pair([&](std::uint32_t i, std::uint32_t j) { divide(lines_[i], lines_[j]); });
  }

  void divide(Line& one, Line& other) {
    const std::array<std::uint32_t, 2> p = {one.points[0], one.points[1]}, q = {other.points[0], other.points[1]};
    const std::array<int, 2> at_p = {side_of(other, p[0]), side_of(other, p[1])};
    if (at_p[0] * at_p[1] > 0) return;
    const std::array<int, 2> at_q = {side_of(one, q[0]), side_of(one, q[1])};
    if (at_q[0] * at_q[1] > 0) return;
    if (at_p[0] * at_p[1] < 0 && at_q[0] * at_q[1] < 0) {
      const std::uint32_t point = add_place(crossing(one, other));
      one.points.push_back(point);
      other.points.push_back(point);
      return;
    }
    for (std::size_t end = 0; end < 2; ++end) {
      if (at_p[end] == 0 && is_between(p[end], q)) other.points.push_back(p[end]);
      if (at_q[end] == 0 && is_between(q[end], p)) one.points.push_back(q[end]);
    }
  }

  ExactPoint crossing(const Line& one, const Line& other) const {
    if (one.is_edge && other.is_edge) return meet_line(axis_, one.a, one.b, other.a, other.b);
    if (one.is_edge) return meet_plane(one.a, one.b, other.plane);
    if (other.is_edge) return meet_plane(other.a, other.b, one.plane);
    return meet_planes(plane_of(corners_), one.plane, other.plane);
  }

  /// Is a point on the line of a cut between the cut's ends, or one of them?
  bool is_between(std::uint32_t point, const std::array<std::uint32_t, 2>& ends) const {
    for (int axis = 0; axis < 3; ++axis) {
      const int from = compare_along(axis, places_[point].exact, places_[ends[0]].exact);
      const int to = compare_along(axis, places_[point].exact, places_[ends[1]].exact);
      if (from * to > 0) return false;
    }
    return true;
  }

  /// Sorts the points of a cut from one end to the other, each once.
  std::vector<std::uint32_t> in_order(const Line& line) const {
    std::vector<std::uint32_t> points = line.points;
    int axis = 0;
    while (axis < 2 && compare_along(axis, places_[points[0]].exact, places_[points[1]].exact) == 0) ++axis;
    const auto compare = [&](std::uint32_t p, std::uint32_t q) {
      return compare_along(axis, places_[p].exact, places_[q].exact);
    };
    std::ranges::stable_sort(points, [&](std::uint32_t p, std::uint32_t q) { return compare(p, q) < 0; });
    const auto again =
        std::ranges::unique(points, [&](std::uint32_t p, std::uint32_t q) { return compare(p, q) == 0; });
    points.erase(again.begin(), again.end());
    return points;
  }

  unsigned edges_at(std::uint32_t point) {
    std::optional<unsigned>& edges = places_[point].edges;
    if (!edges) {
      edges = 0;
      for (std::size_t k = 0; k < 3; ++k)
        if (side_of_line(axis_, corners_[k], corners_[plc::next_corner(k)], places_[point].exact) == 0)
          *edges |= 1u << k;
    }
    return *edges;
  }

  void collect(const Line& line) {
    const std::vector<std::uint32_t> points = in_order(line);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const unsigned edges = edges_at(points[i]);
      for (std::size_t k = 0; k < 3; ++k)
        if (edges == 1u << k) result_.on_edges.emplace_back(k, places_[points[i]].rounded);
      if (i > 0 && (edges & edges_at(points[i - 1])) == 0)
        result_.pieces.push_back({places_[points[i - 1]].rounded, places_[points[i]].rounded});
    }
  }

  Triangle corners_;
  int axis_;
  std::vector<Line> lines_;
  std::vector<Place> places_;
  Arrangement result_;
};

}  // namespace

std::vector<Arrangement> arrange_cuts(std::span<const Point3> vertices, const plc::TriangleSet& triangles,
                                      std::span<const Cut> cuts) {
  const IndexLists cuts_of =
      group_indices(triangles.size(), cuts.size(), [&](std::size_t c) { return cuts[c].triangle; });
  std::vector<std::uint32_t> cut_triangles;
  for (std::uint32_t t = 0; t < triangles.size(); ++t)
    if (!cuts_of.of(t).empty()) cut_triangles.push_back(t);
  std::vector<Arrangement> arrangements(cut_triangles.size());
  parallel_for(cut_triangles.size(), 16, [&](std::size_t i) {
    arrangements[i] = TriangleArranger(vertices, triangles, cuts, cuts_of.of(cut_triangles[i])).run();
  });
  return arrangements;
}

}  // namespace ccdt::repair
