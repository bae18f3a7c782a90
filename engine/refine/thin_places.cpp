#include "engine/refine/thin_places.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "engine/base/hash_table.h"
#include "engine/base/simplex_map.h"
#include "engine/geometry/box_tree.h"
#include "engine/geometry/closest_point.h"

namespace ccdt::refine {

/// The cube that a point is in, in a grid of one facet whose edges are the greatest power of two that is not above a
/// size.
struct SampleCell {
  std::array<std::int64_t, 3> place;
  std::int32_t exponent;
  std::uint32_t facet;

  bool operator==(const SampleCell&) const = default;
};

}  // namespace ccdt::refine

template <>
struct ccdt::HashTraits<ccdt::refine::SampleCell> {
  static constexpr refine::SampleCell none() { return {{}, 0, 0xFFFFFFFFu}; }
  static std::size_t hash(const refine::SampleCell& cell) {
    std::uint64_t h = std::uint64_t{cell.facet} << 32 | static_cast<std::uint32_t>(cell.exponent);
    for (const std::int64_t x : cell.place)
      h = ((h ^ h >> 29) + static_cast<std::uint64_t>(x)) * std::uint64_t{0x9E3779B97F4A7C15};
    return h >> 20;
  }
};

namespace ccdt::refine {
namespace {

using Triangle = std::array<Point3, 3>;

constexpr std::uint32_t none = 0xFFFFFFFFu;

/// Edges may be this many times as long as a strip or a wall is wide.
constexpr double of_strip = 1.3, of_wall = 1.2;

/// The tried lengths are halved at most this many times.
constexpr int most_halvings = 14;

/// Thin places are covered by cubes whose edges double from the size of the place up to the largest length. Each cube
/// leads to about this many tetrahedra: many at a segment or a strip, where the edges inside the domain are short too,
/// but few at a wall, which has no inside.
constexpr double of_strip_cube = 60, of_wall_cube = 2;

/// At most this many pieces of walls are measured for one length. Two solids that nearly touch would need any number of
/// them.
constexpr std::size_t most_pieces = 200000;

/// The same triangle, with the longest edge between its first two corners.
Triangle longest_edge_first(const Triangle& t) {
  std::size_t longest = 0;
  for (std::size_t i = 1; i < 3; ++i)
    if (squared_length(t[(i + 1) % 3] - t[i]) > squared_length(t[(longest + 1) % 3] - t[longest])) longest = i;
  return {t[longest], t[(longest + 1) % 3], t[(longest + 2) % 3]};
}

SampleCell cell_of(const Point3& p, double size, std::uint32_t facet) {
  int exponent = 0;
  std::frexp(size, &exponent);
  const auto place = [&](double x) { return static_cast<std::int64_t>(std::floor(std::ldexp(x, 1 - exponent))); };
  return {{place(p.x), place(p.y), place(p.z)}, exponent, facet};
}

// ---- Between two segments of a facet --------------------------------------------------------------------------------

/// Measures the facets along their edges, piece by piece: a piece is halved if it is longer than the width of the facet
/// there.
class Strips {
 public:
  Strips(const plc::Plc& plc, double largest) : plc_(plc), largest_(largest), is_on_edge_(plc.vertices.size(), false) {
    std::vector<std::array<VertexId, 2>> edges;
    for (const plc::Segment& s : plc.segments) edges.push_back(s.ends);
    segment_of_edge_ = EdgeMap(edges, plc.vertices.size());
    for (const plc::Facet& facet : plc.facets) begin(edges_of(facet));
  }

  /// Measures the pieces that are longer than a length, which decreases from call to call.
  void measure(double least, std::vector<SizedPoint>& places) {
    const std::vector<Piece> pieces = std::exchange(open_, {});
    for (const Piece& piece : pieces) measure(piece, least, places);
  }

  bool are_measured() const { return open_.empty(); }

 private:
  /// An edge of a facet that belongs to a segment, or a vertex inside the facet.
  struct FacetEdge {
    std::array<VertexId, 2> ends;
    Point3 inward;  ///< of length one, in the plane of the facet; zero for a vertex
  };
  struct Edges {
    std::vector<FacetEdge> edges;
    BoxTree tree;
  };
  struct Piece {
    std::array<Point3, 2> ends;
    std::uint32_t facet, edge;  ///< of `facets_` and of its edges
    std::uint32_t near;         ///< an edge that may be near
  };

  const Point3& point(std::uint32_t v) const { return plc_.vertices[v]; }

  std::vector<FacetEdge> edges_of(const plc::Facet& facet) {
    std::vector<FacetEdge> edges;
    for (const auto& t : plc_.triangles_of(facet)) {
      const Point3 normal = area_vector({point(t[0]), point(t[1]), point(t[2])});
      for (int i = 0; i < 3; ++i) {
        const VertexId a = t[i], b = t[(i + 1) % 3];
        if (segment_of_edge_.find(a, b) != EdgeMap::none)
          edges.push_back({{a, b}, normalized(cross(normal, point(b) - point(a)))});
      }
    }
    for (const FacetEdge& edge : edges)
      for (const VertexId v : edge.ends) is_on_edge_[v] = true;
    for (const auto& t : plc_.triangles_of(facet)) {
      for (const VertexId v : t) {
        if (is_on_edge_[v]) continue;
        edges.push_back({{v, v}, {}});
        is_on_edge_[v] = true;
      }
    }
    for (const FacetEdge& edge : edges)
      for (const VertexId v : edge.ends) is_on_edge_[v] = false;
    return edges;
  }

  void begin(std::vector<FacetEdge> edges) {
    if (edges.size() <= 3) return;  // in a triangle, all edges meet
    const auto facet = static_cast<std::uint32_t>(facets_.size());
    RawVector<Box> boxes;
    for (std::uint32_t i = 0; i < edges.size(); ++i) {
      const auto [a, b] = edges[i].ends;
      boxes.push_back(hull(box_of(point(a)), box_of(point(b))));
      open_.push_back({{point(a), point(b)}, facet, i, i});
    }
    facets_.push_back({std::move(edges), BoxTree(std::move(boxes))});
  }

  void measure(Piece piece, double least, std::vector<SizedPoint>& places) {
    const auto [a, b] = piece.ends;
    const double size = length(b - a);
    if (size <= least && size > 0) {
      open_.push_back(piece);
      return;
    }
    const Point3 middle = 0.5 * (a + b);
    const double width = width_at(middle, piece);
    if (of_strip * width < largest_) places.push_back({middle, of_strip * width});
    if (size <= width) return;
    piece.ends = {a, middle};
    measure(piece, least, places);
    piece.ends = {middle, b};
    measure(piece, least, places);
  }

  /// The distance from a point of an edge to the nearest edge or vertex across the facet, but not more than matters.
  /// Stores what is near in the piece.
  double width_at(const Point3& p, Piece& piece) const {
    const Edges& facet = facets_[piece.facet];
    const FacetEdge& edge = facet.edges[piece.edge];
    double width = largest_ / of_strip;
    const auto try_edge = [&](std::uint32_t number) {
      const auto [a, b] = facet.edges[number].ends;
      const auto [c, d] = edge.ends;
      if (a == c || a == d || b == c || b == d) return;
      const Point3 across = closest_on_segment(p, point(a), point(b)) - p;
      const double found = length(across);
      const bool is_vertex = edge.inward == Point3{};
      if (found >= width || (!is_vertex && dot(across, edge.inward) <= 0.3 * found)) return;
      width = found;
      piece.near = number;
    };
    try_edge(piece.near);
    const auto distance = [&](const Box& box, double) { return std::sqrt(squared_distance(box, p)); };
    facet.tree.any_below(width, distance, [&](const BoxTree::Item& item) {
      try_edge(item.number);
      return false;
    });
    return width;
  }

  const plc::Plc& plc_;
  const double largest_;
  EdgeMap segment_of_edge_;
  std::vector<bool> is_on_edge_;  // by vertex, in the current facet
  std::vector<Edges> facets_;     // with more than three edges
  std::vector<Piece> open_;
};

// ---- Between two facets ---------------------------------------------------------------------------------------------

/// Measures the domain over and under the facets, piece by piece: a piece of a triangle is halved if it is longer than
/// the thickness of the domain there.
class Walls {
 public:
  Walls(const plc::Plc& plc, double largest)
      : plc_(plc), largest_(largest), facets_of_vertex_(plc.vertices.size()), met_by_(plc.facets.size(), none) {
    for (std::uint32_t f = 0; f < plc.facets.size(); ++f) {
      for (const auto& t : plc.triangles_of(plc.facets[f])) {
        const Triangle corners = {plc.vertices[t[0]], plc.vertices[t[1]], plc.vertices[t[2]]};
        take_pieces(corners, f);
        open_.push_back({corners, f, {none, none}});
        for (const VertexId v : t)
          if (facets_of_vertex_[v].empty() || facets_of_vertex_[v].back() != f) facets_of_vertex_[v].push_back(f);
      }
    }
    RawVector<Box> boxes;
    for (const FacetTriangle& t : triangles_) boxes.push_back(bounding_box(t.corners));
    tree_ = BoxTree(std::move(boxes));
  }

  /// Measures the pieces that are longer than a length, which decreases from call to call.
  void measure(double least, std::vector<SizedPoint>& places) {
    const std::vector<Piece> pieces = std::exchange(open_, {});
    for (const Piece& piece : pieces) {
      if (met_by_[piece.facet] != piece.facet) mark_facets_around(piece.facet);
      measure(piece, least, places);
    }
    met_by_.assign(met_by_.size(), none);
  }

  /// The number of pieces that are not measured yet.
  std::size_t open() const { return open_.size(); }

 private:
  struct FacetTriangle {
    Triangle corners;
    std::uint32_t facet;
  };
  using Sides = std::array<std::uint32_t, 2>;
  struct Piece {
    Triangle corners;
    std::uint32_t facet;
    Sides near;  ///< triangles that may be near, over and under it
  };
  struct Sample {
    double width;
    Sides near;
  };

  /// Cuts a triangle into pieces that are not longer than the longest wanted edges, so that their boxes are small.
  void take_pieces(const Triangle& t, std::uint32_t facet) {
    const auto [a, b, c] = longest_edge_first(t);
    if (length(b - a) <= largest_) {
      triangles_.push_back({t, facet});
      return;
    }
    const Point3 middle = 0.5 * (a + b);
    take_pieces({a, middle, c}, facet);
    take_pieces({middle, b, c}, facet);
  }

  void mark_facets_around(std::uint32_t facet) {
    for (const auto& t : plc_.triangles_of(plc_.facets[facet]))
      for (const VertexId v : t)
        for (const std::uint32_t g : facets_of_vertex_[v]) met_by_[g] = facet;
  }

  void measure(Piece piece, double least, std::vector<SizedPoint>& places) {
    const auto [a, b, c] = longest_edge_first(piece.corners);
    const double size = length(b - a);
    if (size <= least) {
      open_.push_back(piece);
      return;
    }
    const Point3 center = (1.0 / 3) * (a + b + c);
    // Adjacent needles share one sample.
    const auto [sample, is_new] = known_.insert(cell_of(center, size, piece.facet), {});
    if (is_new) {
      *sample = sample_at(center, piece);
      if (of_wall * sample->width < largest_) places.push_back({center, of_wall * sample->width});
    }
    if (size <= sample->width) return;
    piece.near = sample->near;
    const Point3 middle = 0.5 * (a + b);
    piece.corners = {a, middle, c};
    measure(piece, least, places);
    piece.corners = {middle, b, c};
    measure(piece, least, places);
  }

  Sample sample_at(const Point3& p, const Piece& piece) const {
    Sample sample{largest_ / of_wall, piece.near};
    const plc::Facet& facet = plc_.facets[piece.facet];
    const Point3 normal = normalized(area_vector(piece.corners));
    if (plc_.regions[facet.above].inside) look(piece.facet, normal, p, sample.near[0], sample.width);
    if (plc_.regions[facet.below].inside) look(piece.facet, -1 * normal, p, sample.near[1], sample.width);
    return sample;
  }

  /// Looks from a point of a facet, up to 60 degrees away from a direction, for the nearest triangle of a facet that
  /// this one does not meet. If that is nearer than `width`, stores its number and distance.
  void look(std::uint32_t facet, const Point3& direction, const Point3& p, std::uint32_t& near, double& width) const {
    const auto try_triangle = [&](std::uint32_t number) {
      const FacetTriangle& t = triangles_[number];
      if (met_by_[t.facet] == facet) return;
      const Point3 across = weighted_point(closest_on_triangle(p, t.corners), t.corners) - p;
      const double found = length(across);
      if (found >= width || dot(across, direction) <= 0.5 * found) return;
      width = found;
      near = number;
    };
    if (near != none) try_triangle(near);
    const auto distance = [&](const Box& box, double) {
      const double height = dot(componentwise_max(direction, {}), box.high - p) +
                            dot(componentwise_min(direction, {}), box.low - p);  // of its highest corner
      const double least = std::sqrt(squared_distance(box, p));
      return height > 0 && least < 2 * height ? least : HUGE_VAL;
    };
    tree_.any_below(width, distance, [&](const BoxTree::Item& item) {
      try_triangle(item.number);
      return false;
    });
  }

  const plc::Plc& plc_;
  const double largest_;
  std::vector<std::vector<std::uint32_t>> facets_of_vertex_;
  std::vector<std::uint32_t> met_by_;  // by facet: the last facet that searched and shares a vertex with it
  std::vector<FacetTriangle> triangles_;
  BoxTree tree_;
  HashTable<SampleCell, Sample> known_;
  std::vector<Piece> open_;
};

// ---- All ------------------------------------------------------------------------------------------------------------

/// The number of cubes of a grid that have a place whose size is below twice their edge.
std::size_t count_cubes(const std::vector<SizedPoint>& places, double edge) {
  HashSet<SampleCell> cubes;
  for (const SizedPoint& p : places)
    if (p.size < 2 * edge)
      cubes.insert({{static_cast<std::int64_t>(std::floor(p.point.x / edge)),
                     static_cast<std::int64_t>(std::floor(p.point.y / edge)),
                     static_cast<std::int64_t>(std::floor(p.point.z / edge))},
                    0,
                    0});
  return cubes.size();
}

/// Both ends and the middle of each segment that is shorter than a length.
std::vector<SizedPoint> find_short_segments(const plc::Plc& plc, double largest) {
  std::vector<SizedPoint> places;
  for (const plc::Segment& s : plc.segments) {
    const Point3 &a = plc.vertices[s.ends[0]], &b = plc.vertices[s.ends[1]];
    const double size = length(b - a);
    if (size < largest)
      for (const double t : {0.0, 0.5, 1.0}) places.push_back({a + t * (b - a), size});
  }
  return places;
}

std::vector<SizedPoint> joined(std::vector<SizedPoint> places, const std::vector<SizedPoint>& more) {
  places.insert(places.end(), more.begin(), more.end());
  return places;
}

void limit_from_below(std::vector<SizedPoint>& places, double least) {
  for (SizedPoint& p : places) p.size = std::max(p.size, least);
}

}  // namespace

std::vector<SizedPoint> thinned(const std::vector<SizedPoint>& places) {
  constexpr double nearness = 0.25;
  HashTable<SampleCell, std::uint32_t> number_of_cell;
  std::vector<SizedPoint> least;
  for (const SizedPoint& place : places) {
    const auto [number, is_new] =
        number_of_cell.insert(cell_of(place.point, nearness * place.size, 0), static_cast<std::uint32_t>(least.size()));
    if (is_new)
      least.push_back(place);
    else if (place.size < least[*number].size)
      least[*number] = place;
  }
  return least;
}

std::vector<SizedPoint> find_thin_places(const plc::Plc& plc, double largest, double most_tetrahedra) {
  std::vector<SizedPoint> of_segments = find_short_segments(plc, largest), of_strips, of_walls;
  Strips strips(plc, largest);
  Walls walls(plc, largest);
  double least = largest, least_measured = largest, least_affordable = 0, tetrahedra = 0;
  const auto may_measure = [&] { return (!strips.are_measured() || walls.open() != 0) && walls.open() <= most_pieces; };
  const auto are_shorter = [&] {
    return std::ranges::any_of(of_segments, [&](const SizedPoint& p) { return p.size < least; });
  };
  for (int i = 0; i < most_halvings && (may_measure() || are_shorter()); ++i) {
    const bool measures = may_measure();
    if (measures) {
      strips.measure(least / 2, of_strips);
      walls.measure(least / 2, of_walls);
    }
    tetrahedra += of_strip_cube * count_cubes(joined(of_strips, of_segments), least / 2) +
                  of_wall_cube * count_cubes(of_walls, least / 2);
    if (tetrahedra > most_tetrahedra) {
      least_affordable = least;
      break;
    }
    least /= 2;
    if (measures) least_measured = least;
  }
  limit_from_below(of_strips, least_measured);
  limit_from_below(of_walls, least_measured);
  limit_from_below(of_segments, least_affordable);
  return joined(joined(std::move(of_strips), of_walls), of_segments);
}

}  // namespace ccdt::refine
