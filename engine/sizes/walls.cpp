#include "engine/sizes/walls.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/geometry/closest_point.h"

namespace ccdt::sizes {
namespace {}  // namespace

Walls::Walls(const plc::Plc& plc, WallRules rules)
    : plc_(plc), rules_(std::move(rules)), facets_of_vertex_(plc.vertices.size()), met_by_(plc.facets.size()) {
  for (std::size_t i = 0; i < plc.facets.size(); ++i) {
    const FacetId f(i);
    for (const auto& t : plc.triangles_of(plc.facets[f])) {
      const Triangle corners = {plc.vertices[t[0]], plc.vertices[t[1]], plc.vertices[t[2]]};
      take_pieces(corners, f);
      open_.push_back({corners, f, {none, none}});
      for (const VertexId v : t)
        if (facets_of_vertex_[v].empty() || facets_of_vertex_[v].back() != f) facets_of_vertex_[v].push_back(f);
    }
  }
  tree_ = BoxTree(triangles_, [](const FacetTriangle& t) { return bounding_box(t.corners); });
}

void Walls::measure(double least, std::vector<SizedPlace>& places) {
  const std::vector<Piece> pieces = std::exchange(open_, {});
  for (const Piece& piece : pieces) {
    if (met_by_[piece.facet] != piece.facet) mark_facets_around(piece.facet);
    measure(piece, least, places);
  }
  std::ranges::fill(met_by_, FacetId());
}

/// Cuts a triangle into pieces at most as long as the longest wanted edges, so that their boxes are small.
void Walls::take_pieces(const Triangle& t, FacetId facet) {
  const auto [a, b, c] = longest_edge_first(t);
  if (length(b - a) <= rules_.largest) {
    triangles_.push_back({t, normalized(area_vector(t)), facet});
    return;
  }
  const Point3 middle = 0.5 * (a + b);
  take_pieces({a, middle, c}, facet);
  take_pieces({middle, b, c}, facet);
}

void Walls::mark_facets_around(FacetId facet) {
  for (const auto& t : plc_.triangles_of(plc_.facets[facet]))
    for (const VertexId v : t)
      for (const FacetId g : facets_of_vertex_[v]) met_by_[g] = facet;
}

void Walls::measure(Piece piece, double least, std::vector<SizedPlace>& places) {
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
    if (sample->size < rules_.largest) places.push_back({box_of(center), sample->size});
  }
  if (size <= sample->size) return;
  piece.near = sample->near;
  const Point3 middle = 0.5 * (a + b);
  piece.corners = {a, middle, c};
  measure(piece, least, places);
  piece.corners = {middle, b, c};
  measure(piece, least, places);
}

Walls::Sample Walls::sample_at(const Point3& p, const Piece& piece) const {
  Sample sample{rules_.largest, piece.near};
  const Point3 normal = normalized(area_vector(piece.corners));
  for (const int side : {0, 1})
    if (rules_.ratios[piece.facet][side] > 0) look(piece.facet, normal, side, p, sample);
  sample.size = std::max(sample.size, rules_.least_size);
  return sample;
}

/// \param side  0: above
RegionId Walls::region_beside(FacetId facet, int side) const {
  return side == 0 ? plc_.facets[facet].above : plc_.facets[facet].below;
}

/// Looks from a point of a facet to one side for the nearest triangle that borders the same region. If that is near
/// enough, notes its number and the length of edges that fit.
void Walls::look(FacetId facet, const Point3& normal, int side, const Point3& p, Sample& sample) const {
  const Point3 direction = (side == 0 ? 1.0 : -1.0) * normal;
  const double ratio = rules_.ratios[facet][side];
  double nearest = sample.size / ratio;
  const auto try_triangle = [&](std::uint32_t number) {
    const FacetTriangle& t = triangles_[number];
    if (met_by_[t.facet] == facet || std::fabs(dot(t.normal, normal)) < rules_.least_cosine) return;
    const Point3 across = weighted_point(closest_on_triangle(p, t.corners), t.corners) - p;
    const double found = length(across);
    if (found >= nearest || dot(across, direction) <= 0.5 * found) return;
    if (region_beside(t.facet, dot(across, t.normal) > 0 ? 1 : 0) != region_beside(facet, side)) return;
    nearest = found;
    sample.near[side] = number;
  };
  if (sample.near[side] != none) try_triangle(sample.near[side]);
  const auto distance = [&](const Box& box, double) {
    const double height = dot(componentwise_max(direction, {}), box.high - p) +
                          dot(componentwise_min(direction, {}), box.low - p);  // of its highest corner
    const double least = std::sqrt(squared_distance(box, p));
    return height > 0 && least < 2 * height ? least : HUGE_VAL;
  };
  tree_.any_below(nearest, distance, [&](const BoxTree::Item& item) {
    try_triangle(item.number);
    return false;
  });
  if (nearest > rules_.least_distance) sample.size = std::min(sample.size, ratio * nearest);
}

}  // namespace ccdt::sizes
