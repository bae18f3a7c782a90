#include "engine/plc/triangulate_polygons.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>

#include "engine/base/box_tree.h"
#include "engine/numbers/predicates.h"
#include "engine/planar/triangulation.h"
#include "engine/plc/gather_parts.h"
#include "engine/plc/input_faults.h"
#include "engine/plc/integer_points.h"

namespace ccdt::plc {

namespace {

// The plane of a facet, seen along the axis that it is least parallel to. In this projection all answers are exact,
// also for a facet that is planar only within the tolerance.
struct ProjectedPlane {
  std::span<const Point3> vertices;
  std::span<const Point3> seeds;  // their ids follow those of the vertices
  int axis = 2;

  const Point3& point(VertexId v) const {
    return v < vertices.size() ? vertices[v] : seeds[v - static_cast<std::uint32_t>(vertices.size())];
  }
  int orient(VertexId a, VertexId b, VertexId c) const { return orient_along(axis, point(a), point(b), point(c)); }
  int incircle(VertexId a, VertexId b, VertexId c, VertexId d) const {
    return numbers::incircle_perturbed(flat(a), flat(b), flat(c), above(a), flat(d), {a, b, c, d});
  }

 private:
  // In the plane z = 0, turned so that counterclockwise stays so.
  Point3 flat(VertexId v) const {
    const auto p = as_array(point(v));
    return {p[(axis + 1) % 3], p[(axis + 2) % 3], 0};
  }
  Point3 above(VertexId v) const {
    Point3 p = flat(v);
    p.z = numbers::DyadicGrid::quantum;
    return p;
  }
};

class FacetTriangulator {
 public:
  FacetTriangulator(const InputPlc& input, const Plc& plc, double tolerance, TriangleSet& triangles,
                    SegmentSet& segments)
      : plc_(plc),
        tolerance_(tolerance),
        triangles_(triangles),
        segments_(segments),
        plane_{plc.vertices, {}, 2},
        world_box_(bounding_box(plc.world)) {
    const std::uint32_t given = segments.size();
    segments_at_.resize(plc.vertices.size());
    for (std::uint32_t s = 0; s < given; ++s)
      segments_at_[std::min(segments.ends[s][0], segments.ends[s][1])].push_back(s);
    for (const PolygonFacet& facet : input.polygon_facets) add(facet);
  }

 private:
  void add(const PolygonFacet& facet) {
    facet_ = &facet;
    gather();
    if (vertices_.empty()) fail("a facet has no vertices", {}, "remove it");
    if (!find_plane()) {
      const bool only_segments = std::all_of(facet.polygons.begin(), facet.polygons.end(),
                                             [](const auto& polygon) { return polygon.size() <= 2; });
      if (only_segments) return;  // dangling segments and vertices, written as a facet
      fail("the corners of a facet are on one line", vertices_, "remove this facet");
    }
    const bool plain = facet.polygons.size() == 1 && facet.holes.empty();
    if (plain && vertices_.size() == 3 && edges_.size() == 3)
      return add_triangle(edges_[0][0], edges_[1][0], edges_[2][0]);
    if (plain && vertices_.size() == 4 && edges_.size() == 4 && split_quadrilateral()) return;
    triangulate();
  }

  void add_triangle(VertexId a, VertexId b, VertexId c) { triangles_.add({a, b, c}, facet_->marker, facet_->number); }

  [[noreturn]] void fail(const std::string& what, const std::vector<VertexId>& corners,
                         const std::string& remedy) const {
    constexpr std::size_t most_points = 6;
    std::vector<Point3> points;
    for (std::size_t i = 0; i < std::min(most_points, corners.size()); ++i) points.push_back(plc_.world[corners[i]]);
    throw_input_error(plc_, what, remedy, points, {facet_->number});
  }

  // The different vertices of the facet, and its edges between different vertices.
  void gather() {
    vertices_.clear();
    edges_.clear();
    for (const auto& polygon : facet_->polygons) {
      for (std::size_t i = 0; i < polygon.size(); ++i) {
        const VertexId a = plc_.vertex_of_input[polygon[i]];
        const VertexId b = plc_.vertex_of_input[polygon[(i + 1) % polygon.size()]];
        vertices_.push_back(a);
        const bool way_back = polygon.size() == 2 && i == 1;
        if (a != b && !way_back) edges_.push_back({a, b});
      }
      if (polygon.size() == 2) segments_.add(plc_.vertex_of_input[polygon[0]], plc_.vertex_of_input[polygon[1]], 0);
    }
    std::sort(vertices_.begin(), vertices_.end());
    vertices_.erase(std::unique(vertices_.begin(), vertices_.end()), vertices_.end());
  }

  template <class Measure>
  VertexId farthest(Measure&& measure) const {
    return *std::max_element(vertices_.begin(), vertices_.end(), [&](VertexId u, VertexId v) {
      return measure(plc_.vertices[u]) < measure(plc_.vertices[v]);
    });
  }

  // Takes the plane through three vertices that are far apart and fails if the facet leaves it. False if all are
  // on one line.
  bool find_plane() {
    const auto& points = plc_.vertices;
    const Point3 a = points[vertices_.front()];
    const Point3 b = points[farthest([&](const Point3& p) { return squared_length(p - a); })];
    const Point3 c = points[farthest([&](const Point3& p) { return squared_length(rounded_normal({a, b, p})); })];
    const Point3 normal = rounded_normal({a, b, c});
    if (normal == Point3{}) return false;
    plane_.axis = dominant_axis(normal);

    const double length = std::sqrt(squared_length(normal));
    double low = 0, high = 0;
    VertexId worst = vertices_.front();
    for (const VertexId v : vertices_) {
      const double distance = dot(normal, points[v] - a) / length;
      if (std::max(-distance, distance) > std::max(-low, high)) worst = v;
      low = std::min(low, distance);
      high = std::max(high, distance);
    }
    const double deviation = 0.5 * (high - low);
    if (deviation > tolerance_) {
      std::ostringstream what;
      what << "a facet is not planar: its vertices are up to " << deviation * plc_.grid.unit
           << " away from a plane, and " << tolerance_ * plc_.grid.unit << " is allowed";
      fail(what.str(), {worst}, "split this facet into triangles, or give its vertices with more digits");
    }
    return true;
  }

  // Most facets of surface files; along the shorter of the diagonals that are within.
  bool split_quadrilateral() {
    const VertexId a = edges_[0][0], b = edges_[1][0], c = edges_[2][0], d = edges_[3][0];
    const auto is_within = [&](VertexId p, VertexId q, VertexId r, VertexId s) {
      const int sign = plane_.orient(p, q, r);
      return sign != 0 && sign == plane_.orient(p, r, s);
    };
    const auto length = [&](VertexId p, VertexId q) { return squared_length(plc_.vertices[p] - plc_.vertices[q]); };
    const bool ac = is_within(a, b, c, d), bd = is_within(b, c, d, a);
    if (!segments_at_[std::min(a, c)].empty() || !segments_at_[std::min(b, d)].empty() || (!ac && !bd)) return false;
    if (ac && (!bd || length(a, c) <= length(b, d))) {
      add_triangle(a, b, c);
      add_triangle(a, c, d);
    } else {
      add_triangle(b, c, d);
      add_triangle(b, d, a);
    }
    return true;
  }

  void triangulate() {
    planar::Carving carving;
    std::vector<Point3> seeds;
    for (const Point3& hole : facet_->holes) {
      if (!contains(world_box_, box_of(hole)))
        fail("the seed of a hole in a facet is outside of it", {}, "move the seed into the hole, or remove it");
      carving.hole_seeds.push_back(VertexId(plc_.vertices.size() + seeds.size()));
      seeds.push_back(plc_.grid.snap(hole));
    }
    plane_.seeds = seeds;
    planar::TriangulationResult result = planar::triangulate(std::span<const VertexId>(vertices_),
                                                             std::span<const planar::Edge>(edges_), plane_, carving);
    using Status = planar::TriangulationResult::Status;
    if (result.status == Status::crossing) {
      const planar::Edge &e = edges_[result.crossing[0]], &f = edges_[result.crossing[1]];
      fail("two edges of a facet cross each other (their ends follow)", {e[0], e[1], f[0], f[1]},
           "correct the order of the facet's vertices, or add the point where the edges cross");
    }
    if (result.status != Status::ok)
      fail("a facet has vertices at the same place, or all on one line, within the tolerance", vertices_,
           "remove this facet");
    if (!result.lost_seeds.empty())
      fail("the seed of a hole in a facet is outside of it", {}, "move the seed into the hole, or remove it");
    planar::Triangulation& t = result.triangulation;
    if (t.triangles.empty())
      fail("the outline of a facet is not closed, or its holes leave nothing", vertices_,
           "close the outline, or remove the facet");
    for (const VertexId v : result.unused)
      if (!is_end_of_edge(v))
        fail("a vertex of a facet is outside its outline", {v}, "take the vertex out of the facet");

    insert_given_segments(t);
    for (std::uint32_t i = 0; i < t.triangles.size(); ++i) {
      const auto& [a, b, c] = t.triangles[i];
      add_triangle(a, b, c);
      for (std::uint32_t k = 0; k < 3; ++k)
        if (t.constrained[i][k] && t.neighbors[i][k] != planar::Triangulation::none && t.neighbors[i][k] > i)
          segments_.add(t.triangles[i][(k + 1) % 3], t.triangles[i][(k + 2) % 3], 0);
    }
    plane_.seeds = {};
  }

  bool is_end_of_edge(VertexId v) const {
    return std::any_of(edges_.begin(), edges_.end(), [&](const planar::Edge& e) { return e[0] == v || e[1] == v; });
  }

  // A segment that leaves the facet or crosses its edges is left to the checks of all segments.
  void insert_given_segments(planar::Triangulation& t) {
    for (const VertexId v : vertices_)
      for (const std::uint32_t s : segments_at_[v]) {
        const auto [a, b] = segments_.ends[s];
        if (a != b && planar::has_vertex(t, a) && planar::has_vertex(t, b)) planar::insert_constraint(t, a, b, plane_);
      }
  }

  const Plc& plc_;
  double tolerance_;
  TriangleSet& triangles_;
  SegmentSet& segments_;
  ProjectedPlane plane_;
  std::vector<std::vector<std::uint32_t>> segments_at_;  // of each vertex: the given segments whose smaller end it is
  Box world_box_;                                        // of all vertices, in the units of the input
  const PolygonFacet* facet_ = nullptr;
  std::vector<VertexId> vertices_;  // of the current facet, sorted
  std::vector<planar::Edge> edges_;
};

}  // namespace

void triangulate_polygons(const InputPlc& input, const Plc& plc, double tolerance, TriangleSet& triangles,
                          SegmentSet& segments) {
  if (!input.polygon_facets.empty()) FacetTriangulator(input, plc, tolerance, triangles, segments);
}

}  // namespace ccdt::plc
