#include "engine/sizes/thin_places.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "engine/base/count_work.h"
#include "engine/base/hash_table.h"
#include "engine/base/simplex_map.h"
#include "engine/geometry/closest_point.h"
#include "engine/sizes/budget.h"
#include "engine/sizes/repeat_places.h"
#include "engine/sizes/sample_cell.h"
#include "engine/sizes/walls.h"

namespace ccdt::sizes {

namespace {

/// Edges may be this many times as long as a strip or a wall is wide.
constexpr double of_strip = 1.3, of_wall = 1.2;

/// The tried length is halved at most this many times.
constexpr int most_halvings = 14;

/// At most this many pieces of strips, and of walls, are measured for one length. Two solids that nearly touch could
/// need any number of them.
constexpr std::size_t most_pieces = 200000;

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
  void measure(double least, std::vector<SizedPlace>& places) {
    const std::vector<Piece> pieces = std::exchange(open_, {});
    for (const Piece& piece : pieces) measure(piece, least, places);
  }

  /// The number of pieces that are not measured yet.
  std::size_t open() const { return open_.size(); }

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
        if (segment_of_edge_.find(a, b) != none)
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
    BoxTree tree(edges, [&](const FacetEdge& e) { return hull(box_of(point(e.ends[0])), box_of(point(e.ends[1]))); });
    for (std::uint32_t i = 0; i < edges.size(); ++i)
      open_.push_back({{point(edges[i].ends[0]), point(edges[i].ends[1])}, facet, i, i});
    facets_.push_back({std::move(edges), std::move(tree)});
  }

  void measure(Piece piece, double least, std::vector<SizedPlace>& places) {
    const auto [a, b] = piece.ends;
    const double size = length(b - a);
    if (size <= least && size > 0) {
      open_.push_back(piece);
      return;
    }
    const Point3 middle = 0.5 * (a + b);
    const double width = width_at(middle, piece);
    if (of_strip * width < largest_) places.push_back({box_of(middle), of_strip * width});
    if (size <= width) return;
    piece.ends = {a, middle};
    measure(piece, least, places);
    piece.ends = {middle, b};
    measure(piece, least, places);
  }

  /// The distance from a point of an edge to the nearest edge or vertex across the facet, capped at the largest that
  /// matters. Stores in the piece what is near.
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

/// Both ends and the middle of a segment that is shorter than a length.
void add_short_segment(const Point3& a, const Point3& b, double largest, std::vector<SizedPlace>& places) {
  const double size = length(b - a);
  if (size < largest)
    for (const double t : {0.0, 0.5, 1.0}) places.push_back({box_of(a + t * (b - a)), size});
}

void limit_from_below(std::vector<SizedPlace>& places, double least) {
  for (SizedPlace& p : places) p.size = std::max(p.size, least);
}

/// Keeps only the least of places that have about the same size and are near each other relative to it.
std::vector<SizedPlace> thinned(const std::vector<SizedPlace>& places) {
  constexpr double nearness = 0.25;
  HashTable<SampleCell, std::uint32_t> number_of_cell;
  std::vector<SizedPlace> least;
  for (const SizedPlace& place : places) {
    const auto [number, is_new] =
        number_of_cell.insert(cell_of(place.box.low, nearness * place.size), static_cast<std::uint32_t>(least.size()));
    if (is_new)
      least.push_back(place);
    else if (place.size < least[*number].size)
      least[*number] = place;
  }
  return least;
}

/// All places. Those too thin to be measured are treated as just thick enough.
std::vector<SizedPlace> measure_thin_places(const plc::Plc& plc, double largest) {
  std::vector<SizedPlace> places;
  Strips strips(plc, largest);
  WallRules rules{largest, {}};
  for (const plc::Facet& f : plc.facets)
    rules.ratios.push_back({plc.regions[f.above].inside ? of_wall : 0, plc.regions[f.below].inside ? of_wall : 0});
  Walls walls(plc, std::move(rules));
  double least = largest;
  const auto may_measure = [&] {
    return strips.open() + walls.open() > 0 && std::max(strips.open(), walls.open()) <= most_pieces;
  };
  for (int i = 0; i < most_halvings && may_measure(); ++i) {
    least /= 2;
    strips.measure(least, places);
    walls.measure(least, places);
  }
  if (strips.open() + walls.open() > 0) ++work_done.thin_places;
  limit_from_below(places, least);
  for (const plc::Segment& s : plc.segments)
    add_short_segment(plc.vertices[s.ends[0]], plc.vertices[s.ends[1]], largest, places);
  return places;
}

}  // namespace

SizeField find_thin_places(const plc::Plc& plc, double largest, double grading, const WantedSizes& wanted,
                           double most_triangles) {
  const std::vector<SizedPlace> places = measure_thin_places(plc, largest);
  const auto field_of = [&](double least) {
    std::vector<SizedPlace> limited = places;
    limit_from_below(limited, least);
    limited = thinned(limited);
    limited.insert(limited.end(), wanted.places.begin(), wanted.places.end());
    repeat_places(plc, largest, grading, limited);
    return SizeField(largest, grading, limited, &wanted.background);
  };
  const double even = count_triangles(plc, SizeField(largest, grading, wanted.places, &wanted.background));
  const double most = even + std::min(most_triangles, affordable_triangles(even));
  const auto is_affordable = [&](double least) { return count_triangles(plc, field_of(least), most) <= most; };
  double shortest = largest;
  for (const SizedPlace& place : places) shortest = std::min(shortest, place.size);
  return field_of(least_affordable(shortest, largest, is_affordable));
}

}  // namespace ccdt::sizes
