#include "engine/plc/gather_parts.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "engine/base/errors.h"
#include "engine/base/flatness.h"
#include "engine/base/hash_table.h"
#include "engine/base/morton.h"
#include "engine/base/parallel.h"
#include "engine/base/raw_vector.h"
#include "engine/geometry/box_tree.h"
#include "engine/geometry/contacts.h"
#include "engine/geometry/integer_points.h"
#include "engine/planar/triangulation.h"
#include "engine/plc/input_faults.h"
#include "engine/plc/projected_plane.h"
#include "engine/plc/warped_facets.h"

namespace ccdt::plc {

namespace {

void check_coordinates(const InputPlc& input) {
  for (std::size_t i = 0; i < input.vertices.size(); ++i) {
    if (is_finite(input.vertices[i])) continue;
    throw InputError("vertex " + std::to_string(i) + " (counted from 0) has a coordinate that is not a finite number",
                     {.file = input.name},
                     "export the model again, or correct or remove this vertex and the facets that use it");
  }
}

double largest_difference(const Point3& a, const Point3& b) {
  return std::max({std::fabs(a.x - b.x), std::fabs(a.y - b.y), std::fabs(a.z - b.z)});
}

// Each vertex splits the triangle that contains it into three, or into two if it is on an edge.
class TriangleSplitter {
 public:
  TriangleSplitter(std::span<const Point3> vertices, const VertexTriple& t)
      : vertices_(vertices), axis_(dominant_axis(points_of(vertices, t))), sense_(orient(t[0], t[1], t[2])) {}

  void split(const VertexTriple& t, const std::vector<VertexId>& inner, std::vector<VertexTriple>& parts) const {
    if (inner.empty()) {
      parts.push_back(t);
      return;
    }
    const std::size_t middle = inner.size() / 2;  // consecutive vertices have consecutive ids, so the list is halved
    const VertexId v = inner[middle];
    for (int k = 0; k < 3; ++k) {
      const VertexTriple part = {t[k], t[(k + 1) % 3], v};
      if (orient(part[0], part[1], part[2]) == 0) continue;
      std::vector<VertexId> left;
      for (std::size_t i = 0; i < inner.size(); ++i)
        if (i != middle && holds(part, inner[i])) left.push_back(inner[i]);
      split(part, left, parts);
    }
  }

 private:
  int orient(VertexId a, VertexId b, VertexId c) const {
    return orient_along(axis_, vertices_[a], vertices_[b], vertices_[c]);
  }
  bool holds(const VertexTriple& t, VertexId v) const {
    for (int k = 0; k < 3; ++k)
      if (orient(t[k], t[(k + 1) % 3], v) == -sense_) return false;
    return true;
  }

  std::span<const Point3> vertices_;
  int axis_;
  int sense_;
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
        world_box_(bounding_box(plc.world)),
        inside_(input.inside) {
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
    // No area, as in `drop_triangles_without_area`; or dangling segments and vertices, written as a facet.
    if (!take_plane()) return;
    const bool plain = is_one_loop(facet);
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

  // Gathers the distinct vertices of the facet, and its edges between distinct vertices.
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

  // Finds the plane of the facet, and fails if the facet leaves it. False if all vertices are on one line.
  bool take_plane() {
    std::vector<Point3> points;
    for (const VertexId v : vertices_) points.push_back(plc_.vertices[v]);
    const FacetPlane plane = find_plane(points);
    if (plane.normal == Point3{}) return false;
    plane_.axis = dominant_axis(plane.normal);
    if (plane.deviation > tolerance_) {
      std::ostringstream what;
      what << "a facet is not planar: its vertices are up to " << plane.deviation * plc_.grid.unit
           << " away from a plane, and " << tolerance_ * plc_.grid.unit << " is allowed";
      fail(what.str(), {vertices_[plane.farthest]},
           "split this facet into triangles, or give its vertices with more digits");
    }
    return true;
  }

  // The most common case; uses the shorter of the inner diagonals.
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
    const bool is_outline = inside_ == InputPlc::Inside::even_odd && is_one_loop(*facet_);
    carving.nested = is_outline;
    std::vector<Point3> seeds;
    for (const Point3& hole : facet_->holes) {
      if (!contains(world_box_, box_of(hole)))
        fail("the hole seed of a facet is outside the facet", {}, "move the seed into the hole, or remove it");
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
      fail("the hole seed of a facet is outside the facet", {}, "move the seed into the hole, or remove it");
    planar::Triangulation& t = result.triangulation;
    if (t.triangles.empty())
      fail("the outline of a facet is not closed, or its holes remove everything", vertices_,
           "close the outline, or remove the facet");
    for (const VertexId v : result.unused)
      if (!is_end_of_edge(v))
        fail("a vertex of a facet is outside its outline", {v}, "take the vertex out of the facet");

    insert_given_segments(t);
    for (std::uint32_t i = 0; i < t.triangles.size(); ++i) {
      const auto& [a, b, c] = t.triangles[i];
      add_triangle(a, b, c);
      for (std::uint32_t k = 0; k < 3; ++k)
        if (!is_outline && t.constrained[i][k] && t.neighbors[i][k] != none && t.neighbors[i][k] > i)
          segments_.add(t.triangles[i][(k + 1) % 3], t.triangles[i][(k + 2) % 3], 0);
    }
    plane_.seeds = {};
  }

  bool is_end_of_edge(VertexId v) const {
    return std::any_of(edges_.begin(), edges_.end(), [&](const planar::Edge& e) { return e[0] == v || e[1] == v; });
  }

  // A segment that leaves the facet or crosses its edges is left to the check of all segments.
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
  std::vector<std::vector<std::uint32_t>> segments_at_;  // by vertex: the given segments whose smaller end it is
  Box world_box_;                                        // of all vertices, in the units of the input
  InputPlc::Inside inside_;
  const PolygonFacet* facet_ = nullptr;
  std::vector<VertexId> vertices_;  // of the current facet, sorted
  std::vector<planar::Edge> edges_;
};

// For each point, the first point equal to it. After sorting by hash values, equal points are near each other.
std::vector<std::uint32_t> find_first_equal(std::span<const Point3> points) {
  RawVector<KeyedIndex> keyed(points.size());
  parallel_for(points.size(), 4096, [&](std::size_t i) {
    keyed[i] = {HashTraits<IntegerPoint>::hash(to_integers(points[i])), static_cast<std::uint32_t>(i)};
  });
  const std::vector<std::uint32_t> order = sorted_by_key(keyed);
  std::vector<std::uint32_t> first_equal(points.size());
  const auto is_new = [&](std::size_t k) { return k == 0 || keyed[order[k]].key != keyed[order[k - 1]].key; };
  parallel_ranges(order.size(), 4096, [&](std::size_t k, std::size_t end) {
    std::size_t first = k;  // of the points with this hash value
    while (!is_new(first)) --first;
    for (; k < end; ++k) {
      if (is_new(k)) first = k;
      std::size_t same = first;
      while (points[order[same]] != points[order[k]]) ++same;
      first_equal[order[k]] = order[same];
    }
  });
  return first_equal;
}

}  // namespace

bool has_usual_extent(std::span<const Point3> points) {
  const double extent = largest_extent(points);
  return extent == 0 || (extent >= least_extent && extent <= most_extent);
}

void check_extent(const InputPlc& input) {
  if (has_usual_extent(input.vertices)) return;
  std::ostringstream words;
  words << "the bounding box has an extent of " << largest_extent(input.vertices) << "; the limits are " << least_extent
        << " and " << most_extent;
  throw InputError(words.str(), {.file = input.name}, "use another unit of length");
}

void snap_vertices(const InputPlc& input, Plc& plc) {
  check_coordinates(input);
  check_extent(input);
  plc.grid = make_grid(input.vertices);
  const auto count = static_cast<std::uint32_t>(input.vertices.size());
  RawVector<Point3> snapped(count);
  const auto roundings = parallel_chunks(count, 4096, [&](std::size_t i, std::size_t end) {
    double largest = 0;
    for (; i < end; ++i) {
      snapped[i] = plc.grid.snap(input.vertices[i]);
      largest = std::max(largest, largest_difference(plc.grid.to_world(snapped[i]), input.vertices[i]));
    }
    return largest;
  });
  for (const double rounding : roundings) plc.largest_rounding = std::max(plc.largest_rounding, rounding);

  const std::vector<std::uint32_t> first_equal = find_first_equal(snapped);
  std::size_t different = 0;
  for (std::uint32_t i = 0; i < count; ++i) different += first_equal[i] == i;
  plc.vertex_of_input.resize(count);
  plc.vertices.reserve(different);
  plc.world.reserve(different);
  for (std::uint32_t i = 0; i < count; ++i) {
    if (first_equal[i] != i) {
      plc.vertex_of_input[i] = plc.vertex_of_input[first_equal[i]];
      continue;
    }
    plc.vertex_of_input[i] = VertexId(plc.vertices.size());
    plc.vertices.push_back(snapped[i]);
    plc.world.push_back(input.vertices[i]);
  }
}

double tolerance_of(const Plc& plc, double flatness) {
  return flatness_for(plc.world, flatness) * largest_extent(plc.vertices);
}

TriangleSet gather_triangles(const InputPlc& input, const Plc& plc) {
  TriangleSet triangles;
  triangles.reserve(input.triangles.size());
  for (std::uint32_t t = 0; t < input.triangles.size(); ++t) {
    const auto [a, b, c] = input.triangles[t];
    triangles.add({plc.vertex_of_input[a], plc.vertex_of_input[b], plc.vertex_of_input[c]},
                  input.triangle_markers.empty() ? 0 : input.triangle_markers[t],
                  input.triangle_numbers.empty() ? t : input.triangle_numbers[t]);
  }
  return triangles;
}

SegmentSet gather_segments(const InputPlc& input, const Plc& plc) {
  SegmentSet segments;
  for (std::uint32_t s = 0; s < input.segments.size(); ++s)
    segments.add(plc.vertex_of_input[input.segments[s][0]], plc.vertex_of_input[input.segments[s][1]],
                 input.segment_markers.empty() ? 0 : input.segment_markers[s]);
  return segments;
}

void triangulate_polygons(const InputPlc& input, const Plc& plc, double tolerance, TriangleSet& triangles,
                          SegmentSet& segments) {
  if (!input.polygon_facets.empty()) FacetTriangulator(input, plc, tolerance, triangles, segments);
}

void keep_triangles(std::span<const char> is_kept, TriangleSet& triangles) {
  TriangleSet kept;
  for (std::uint32_t t = 0; t < triangles.size(); ++t)
    if (is_kept[t] != 0) kept.add(triangles.corners[t], triangles.markers[t], triangles.numbers[t], triangles.faces[t]);
  triangles = std::move(kept);
}

void drop_triangles_without_area(std::span<const Point3> vertices, TriangleSet& triangles) {
  std::vector<char> has_area(triangles.size());
  parallel_for(triangles.size(), 4096, [&](std::size_t t) {
    const auto [a, b, c] = triangles.corners[t];
    has_area[t] = a != b && b != c && c != a && !has_no_area(points_of(vertices, triangles.corners[t]));
  });
  if (std::ranges::find(has_area, 0) != has_area.end()) keep_triangles(has_area, triangles);
}

namespace {

/// A triangle and a vertex on it that is not a corner.
using VertexOnTriangle = std::pair<std::uint32_t, VertexId>;

std::vector<VertexOnTriangle> find_vertices_on_triangles(std::span<const Point3> vertices,
                                                         std::span<const TrianglePair> close,
                                                         const TriangleSet& triangles) {
  const auto test = [&](std::span<const VertexId> those, std::uint32_t t, std::vector<VertexOnTriangle>& found) {
    const auto corners = points_of(vertices, triangles.corners[t]);
    const Box box = hull(hull(box_of(corners[0]), box_of(corners[1])), box_of(corners[2]));
    for (const VertexId v : those)
      if (box.meets(box_of(vertices[v])) && !has_corner(triangles.corners[t], v) &&
          is_on_triangle(dominant_axis(corners), vertices[v], corners))
        found.emplace_back(t, v);
  };
  std::vector<VertexOnTriangle> found = parallel_collect<VertexOnTriangle>(
      close.size(), 1024, [&](std::size_t begin, std::size_t end, std::vector<VertexOnTriangle>& some) {
        for (const auto& [s, t] : close.subspan(begin, end - begin)) {
          test(triangles.corners[s], t, some);
          test(triangles.corners[t], s, some);
        }
      });
  std::vector<bool> is_corner(vertices.size(), false);
  for (const VertexTriple& t : triangles.corners)
    for (const VertexId v : t) is_corner[v] = true;
  std::optional<BoxTree> tree;  // mostly not needed
  for (std::uint32_t i = 0; i < vertices.size(); ++i) {
    const VertexId v(i);
    if (is_corner[i]) continue;
    if (!tree) tree = tree_of(vertices, triangles);
    tree->for_each_meeting(box_of(vertices[i]), [&](std::uint32_t t) { test({&v, 1}, t, found); });
  }
  std::ranges::sort(found);
  const auto again = std::ranges::unique(found);
  found.erase(again.begin(), again.end());
  return found;
}

}  // namespace

bool split_triangles_at_vertices(std::span<const Point3> vertices, std::span<const TrianglePair> close,
                                 TriangleSet& triangles) {
  const std::vector<VertexOnTriangle> found = find_vertices_on_triangles(vertices, close, triangles);
  if (found.empty()) return false;

  TriangleSet result;
  std::vector<VertexId> inner;
  std::vector<VertexTriple> parts;
  auto next = found.begin();
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    inner.clear();
    parts.clear();
    for (; next != found.end() && next->first == t; ++next) inner.push_back(next->second);
    TriangleSplitter(vertices, triangles.corners[t]).split(triangles.corners[t], inner, parts);
    const std::uint32_t face = parts.size() == 1 ? triangles.faces[t] : no_face;
    for (const VertexTriple& part : parts) result.add(part, triangles.markers[t], triangles.numbers[t], face);
  }
  triangles = std::move(result);
  return true;
}

void split_segments_at_vertices(std::span<const Point3> vertices, SegmentSet& segments) {
  if (segments.ends.empty()) return;
  const BoxTree tree(segments.ends,
                     [&](const auto& ends) { return hull(box_of(vertices[ends[0]]), box_of(vertices[ends[1]])); });
  std::vector<std::pair<std::uint32_t, VertexId>> found;  // segment and a vertex on it
  for (std::uint32_t i = 0; i < vertices.size(); ++i)
    tree.for_each_meeting(box_of(vertices[i]), [&](std::uint32_t s) {
      const auto& [a, b] = segments.ends[s];
      if (a != b && is_within_segment(vertices[i], vertices[a], vertices[b])) found.emplace_back(s, VertexId(i));
    });
  std::sort(found.begin(), found.end());

  SegmentSet result;
  std::set<std::pair<VertexId, VertexId>> known;
  const auto add = [&](VertexId a, VertexId b, int marker) {
    if (a != b && known.insert(std::minmax(a, b)).second) result.add(a, b, marker);
  };
  std::vector<VertexId> chain;
  auto next = found.begin();
  for (std::uint32_t s = 0; s < segments.size(); ++s) {
    const auto [a, b] = segments.ends[s];
    chain.assign(1, a);
    for (; next != found.end() && next->first == s; ++next) chain.push_back(next->second);
    const Point3 along = vertices[b] - vertices[a];
    const int axis = dominant_axis(along);
    const double sense = as_array(along)[axis] < 0 ? -1 : 1;
    std::sort(chain.begin() + 1, chain.end(), [&](VertexId u, VertexId v) {
      return sense * as_array(vertices[u])[axis] < sense * as_array(vertices[v])[axis];
    });
    chain.push_back(b);
    for (std::size_t k = 0; k + 1 < chain.size(); ++k) add(chain[k], chain[k + 1], segments.markers[s]);
  }
  segments = std::move(result);
}

}  // namespace ccdt::plc
