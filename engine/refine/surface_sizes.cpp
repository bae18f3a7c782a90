#include "engine/refine/surface_sizes.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "engine/base/closest_on_triangle.h"
#include "engine/base/simplex_map.h"

namespace ccdt::refine {
namespace {

using Item = lattice::SizeTree::Item;
using Triangle = std::array<Point3, 3>;

/// Edges may be longer than what is between two segments or facets by these factors.
constexpr double of_strip = 1.3, of_wall = 1.2;

/// Samples are this near to each other, as a fraction of the length that was found between them.
constexpr double sample_spacing = 1;

/// Where walls are thin, the surface gets about that many triangles at most; then lengths fit the thinnest walls no
/// more.
constexpr double most_triangles_of_walls = 400000;

/// A strip has no more than that many edges beside each other where there might be one of the greatest length.
constexpr double narrowest_strip = 1.0 / 4096;

/// A place is not halved more often than this in search of short lengths.
constexpr int most_halvings = 14;

Point3 nearest_on_segment(const Point3& a, const Point3& b, const Point3& p) {
  if (a == b) return a;
  const Point3 along = b - a;
  const double t = std::clamp(dot(p - a, along) / squared_length(along), 0.0, 1.0);
  return a + t * along;
}

Point3 nearest_on_triangle(const Triangle& t, const Point3& p) {
  const std::array weights = closest_on_triangle(p, t);
  return t[0] + (weights[1] * (t[1] - t[0]) + weights[2] * (t[2] - t[0]));
}

/// The same triangle, with the longest edge between its first two corners.
Triangle longest_edge_first(const Triangle& t) {
  std::size_t longest = 0;
  for (std::size_t i = 1; i < 3; ++i)
    if (squared_length(t[(i + 1) % 3] - t[i]) > squared_length(t[(longest + 1) % 3] - t[longest])) longest = i;
  return {t[longest], t[(longest + 1) % 3], t[(longest + 2) % 3]};
}

/// The cube of a grid of cubes that a point is in, whose edges are the power of two that is not above a size.
using Cell = std::array<std::int64_t, 4>;

Cell cell_of(const Point3& p, double size) {
  int exponent = 0;
  std::frexp(size, &exponent);
  const auto place = [&](double x) { return static_cast<std::int64_t>(std::floor(std::ldexp(x, 1 - exponent))); };
  return {exponent, place(p.x), place(p.y), place(p.z)};
}

/// Of the sources of about one size that are near to each other for it, the least.
std::vector<Item> thinned(const std::vector<Item>& sources) {
  constexpr double nearness = 0.25;
  std::map<Cell, Item> least;
  for (const Item& source : sources) {
    const auto [known, is_new] = least.try_emplace(cell_of(source.box.low, nearness * source.size), source);
    if (!is_new && source.size < known->second.size) known->second = source;
  }
  std::vector<Item> result;
  for (const auto& [cell, source] : least) result.push_back(source);
  return result;
}

/// Finds the places where edges must be short.
class SourceFinder {
 public:
  SourceFinder(const plc::Plc& plc, double largest)
      : plc_(plc), largest_(largest), is_on_edge_(plc.vertices.size(), false) {
    std::vector<std::array<VertexId, 2>> edges;
    for (const plc::Segment& s : plc.segments) edges.push_back(s.ends);
    segment_of_edge_ = EdgeMap(edges, plc.vertices.size());
  }

  std::vector<Item> find() {
    take_short_segments();
    for (const plc::Facet& facet : plc_.facets) measure_strips(facet);
    measure_walls();
    return thinned(sources_);
  }

 private:
  const Point3& point(std::uint32_t v) const { return plc_.vertices[v]; }
  Triangle corners(const std::array<VertexId, 3>& t) const { return {point(t[0]), point(t[1]), point(t[2])}; }

  void add(const Point3& p, double size) {
    if (size < largest_) sources_.push_back({box_of(p), size, 0});
  }

  void take_short_segments() {
    for (const plc::Segment& s : plc_.segments) {
      const Point3 &a = point(s.ends[0]), &b = point(s.ends[1]);
      const double size = length(b - a);
      for (const double t : {0.0, 0.5, 1.0}) add(a + t * (b - a), size);
    }
  }

  // ---- Between two segments of a facet ----------------------------------------------------------------------------

  /// An edge of a facet that belongs to a segment, or a vertex inside the facet.
  struct FacetEdge {
    std::array<VertexId, 2> ends;
    Point3 inward;  ///< of length one, in the plane of the facet; zero for a vertex
  };

  std::vector<FacetEdge> edges_of(const plc::Facet& facet) {
    std::vector<FacetEdge> edges;
    for (const auto& t : facet.triangles) {
      const Point3 normal = area_vector(corners(t));
      for (int i = 0; i < 3; ++i) {
        const VertexId a = t[i], b = t[(i + 1) % 3];
        if (segment_of_edge_.find(a, b) != EdgeMap::none)
          edges.push_back({{a, b}, normalized(cross(normal, point(b) - point(a)))});
      }
    }
    for (const FacetEdge& edge : edges)
      for (const VertexId v : edge.ends) is_on_edge_[v] = true;
    for (const auto& t : facet.triangles) {
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

  void measure_strips(const plc::Facet& facet) {
    const std::vector<FacetEdge> edges = edges_of(facet);
    if (edges.size() <= 3) return;  // of a triangle all edges meet
    std::vector<Item> items;
    for (std::uint32_t i = 0; i < edges.size(); ++i) {
      const auto [a, b] = edges[i].ends;
      items.push_back({hull(box_of(point(a)), box_of(point(b))), 0, i});
    }
    const lattice::SizeTree tree(items);
    for (const FacetEdge& edge : edges) {
      const auto width_at = [&](const Point3& p) { return strip_width(edges, tree, edge, p); };
      sample_segment(point(edge.ends[0]), point(edge.ends[1]), width_at, 0);
    }
  }

  /// The distance from a point of an edge to the nearest edge or vertex across the facet; if that is small.
  double strip_width(const std::vector<FacetEdge>& edges, const lattice::SizeTree& tree, const FacetEdge& edge,
                     const Point3& p) const {
    double width = largest_ / of_strip;
    const auto distance = [&](const Box& box, double) { return std::sqrt(squared_distance(box, p)); };
    tree.any(width, distance, [&](const Item& item) {
      const auto [a, b] = edges[item.number].ends;
      const auto [c, d] = edge.ends;
      if (a == c || a == d || b == c || b == d) return false;
      const Point3 across = nearest_on_segment(point(a), point(b), p) - p;
      const double found = length(across);
      const bool is_vertex = edge.inward == Point3{};
      if (found < width && (is_vertex || dot(across, edge.inward) > 0.3 * found)) width = found;
      return false;
    });
    return std::max(width, narrowest_strip * largest_);
  }

  template <class WidthAt>
  void sample_segment(const Point3& a, const Point3& b, const WidthAt& width_at, int halvings) {
    const Point3 middle = 0.5 * (a + b);
    const double width = width_at(middle);
    add(middle, of_strip * width);
    if (length(b - a) <= sample_spacing * width || halvings == most_halvings) return;
    sample_segment(a, middle, width_at, halvings + 1);
    sample_segment(middle, b, width_at, halvings + 1);
  }

  // ---- Between two facets -------------------------------------------------------------------------------------------

  void measure_walls() {
    std::vector<std::vector<std::uint32_t>> facets_of_vertex(plc_.vertices.size());
    for (std::uint32_t f = 0; f < plc_.facets.size(); ++f) {
      for (const auto& t : plc_.facets[f].triangles) {
        take_pieces(corners(t), f);
        for (const VertexId v : t)
          if (facets_of_vertex[v].empty() || facets_of_vertex[v].back() != f) facets_of_vertex[v].push_back(f);
      }
    }
    std::vector<Item> items;
    for (std::uint32_t i = 0; i < triangles_.size(); ++i) items.push_back({bounding_box(triangles_[i].corners), 0, i});
    triangle_tree_ = lattice::SizeTree(items);
    const std::vector<Item> others = std::move(sources_);
    for (least_width_ = largest_ / 4;; least_width_ /= 2) {
      sources_ = others;
      sample_walls(facets_of_vertex);
      if (!too_thin_ || 4 * triangles_of_walls_ > most_triangles_of_walls) return;
    }
  }

  void sample_walls(const std::vector<std::vector<std::uint32_t>>& facets_of_vertex) {
    too_thin_ = false;
    triangles_of_walls_ = 0;
    met_by_.assign(plc_.facets.size(), 0xFFFFFFFFu);
    for (std::uint32_t f = 0; f < plc_.facets.size(); ++f) {
      const plc::Facet& facet = plc_.facets[f];
      for (const auto& t : facet.triangles)
        for (const VertexId v : t)
          for (const std::uint32_t g : facets_of_vertex[v]) met_by_[g] = f;
      known_widths_.clear();
      for (const auto& t : facet.triangles) {
        const Point3 normal = normalized(area_vector(corners(t)));
        const auto width_at = [&](const Point3& p) {
          double width = largest_ / of_wall;
          if (plc_.regions[facet.above].inside) width = wall_width(f, normal, p);
          if (plc_.regions[facet.below].inside) width = std::min(width, wall_width(f, -1 * normal, p));
          too_thin_ = too_thin_ || width < least_width_;
          return std::max(width, least_width_);
        };
        sample_triangle(corners(t), width_at, 0);
      }
    }
  }

  struct FacetTriangle {
    Triangle corners;
    std::uint32_t facet;
  };

  /// A triangle in pieces that are not much longer than edges may be, so that their boxes are small.
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

  /// The distance from a point of a facet to the nearest facet that it does not meet, within a cone of 60 degrees
  /// around a direction; if that is small.
  double wall_width(std::uint32_t facet, const Point3& direction, const Point3& p) const {
    double width = largest_ / of_wall;
    const auto distance = [&](const Box& box, double) {
      const double height = dot(componentwise_max(direction, {}), box.high - p) +
                            dot(componentwise_min(direction, {}), box.low - p);  // of its highest corner
      const double least = std::sqrt(squared_distance(box, p));
      return height > 0 && least < 2 * height ? least : HUGE_VAL;
    };
    triangle_tree_.any(width, distance, [&](const Item& item) {
      const FacetTriangle& t = triangles_[item.number];
      if (met_by_[t.facet] == facet) return false;
      const Point3 across = nearest_on_triangle(t.corners, p) - p;
      const double found = length(across);
      if (found < width && dot(across, direction) > 0.5 * found) width = found;
      return false;
    });
    return width;
  }

  template <class WidthAt>
  void sample_triangle(const Triangle& t, const WidthAt& width_at, int halvings) {
    const Point3 center = (1.0 / 3) * (t[0] + t[1] + t[2]);
    const auto [a, b, c] = longest_edge_first(t);
    // Needles beside each other have one sample in common.
    const auto [known, is_new] = known_widths_.try_emplace(cell_of(center, 0.5 * length(b - a)));
    if (is_new) {
      known->second = width_at(center);
      add(center, of_wall * known->second);
    }
    const double width = known->second;
    if (length(b - a) <= sample_spacing * width || halvings == 2 * most_halvings) {
      const double size = of_wall * width;
      if (size < largest_) triangles_of_walls_ += length(area_vector(t)) / (0.87 * size * size);
      return;
    }
    const Point3 middle = 0.5 * (a + b);
    sample_triangle({a, middle, c}, width_at, halvings + 1);
    sample_triangle({middle, b, c}, width_at, halvings + 1);
  }

  const plc::Plc& plc_;
  const double largest_;
  EdgeMap segment_of_edge_;
  std::vector<bool> is_on_edge_;  // by vertex, in the facet at hand
  std::vector<Item> sources_;
  std::vector<FacetTriangle> triangles_;
  lattice::SizeTree triangle_tree_;
  double least_width_ = 0;               // of walls: thinner ones count as thick as this
  bool too_thin_ = false;                // is there any?
  double triangles_of_walls_ = 0;        // that thin walls will have
  std::map<Cell, double> known_widths_;  // in the facet at hand
  std::vector<std::uint32_t> met_by_;    // of each facet: the last one that asked and has a vertex with it in common
};

}  // namespace

SurfaceSizes::SurfaceSizes(const plc::Plc& plc, double edge_length, double grading)
    : largest_(edge_length), grading_(grading), sources_(SourceFinder(plc, edge_length).find()) {}

double SurfaceSizes::at(const Point3& p) const {
  double least = largest_;
  const auto size_in = [&](const Box& box, double size) {
    return size + grading_ * std::sqrt(squared_distance(box, p));
  };
  sources_.any(least, size_in, [&](const Item& item) {
    least = std::min(least, size_in(item.box, item.size));
    return false;
  });
  return least;
}

}  // namespace ccdt::refine
