#include "engine/surface/original_surface.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "engine/base/point.h"
#include "engine/base/portable_math.h"
#include "engine/base/simplex_map.h"
#include "engine/base/union_find.h"
#include "engine/geometry/closest_point.h"
#include "engine/plc/edge_table.h"
#include "engine/plc/gather_parts.h"
#include "engine/surface/sharp_angle.h"
#include "engine/surface/wide_bends.h"

namespace ccdt::surface {

namespace {

// At a tip, the normal of a triangle differs from the mean normal by more than this, in degrees. At an edge that is
// almost sharp, each normal differs from the mean by half of the sharp angle.
double turn_at_tip(double sharp_angle) {
  constexpr double least = 30;
  return std::max(least, sharp_angle / 2);
}

using SegmentMarkers = std::unordered_map<std::uint64_t, int>;  // by edge key

std::uint32_t corner_at(const plc::VertexTriple& corners, std::uint32_t point) {
  return corners[0] == point ? 0 : corners[1] == point ? 1 : 2;
}

// The segments that the input itself lists, including two-vertex polygons and slits within polygon facets. They are
// split at all vertices on them.
plc::SegmentSet declared_segments(const plc::InputPlc& input, const plc::Plc& plc, double tolerance) {
  plc::SegmentSet segments = plc::gather_segments(input, plc);
  plc::TriangleSet ignored;
  plc::triangulate_polygons(input, plc, tolerance, ignored, segments);
  plc::split_segments_at_vertices(plc.vertices, segments);
  return segments;
}

// For each vertex of the PLC: does the input list it although no facet or segment uses it?
std::vector<char> find_vertices_listed_alone(const plc::InputPlc& input, const plc::Plc& plc) {
  std::vector<char> alone(plc.vertices.size(), 0);
  for (const VertexId v : plc.vertex_of_input) alone[v] = 1;
  const auto use = [&](std::uint32_t input_vertex) { alone[plc.vertex_of_input[input_vertex]] = 0; };
  for (const auto& corners : input.triangles)
    for (const std::uint32_t v : corners) use(v);
  for (const auto& ends : input.segments)
    for (const std::uint32_t v : ends) use(v);
  for (const plc::PolygonFacet& facet : input.polygon_facets)
    for (const auto& polygon : facet.polygons)
      if (polygon.size() > 1)
        for (const std::uint32_t v : polygon) use(v);
  return alone;
}

class SurfaceCutter {
 public:
  SurfaceCutter(const plc::InputPlc& input, const plc::Plc& plc, const RemeshOptions& options)
      : plc_(plc),
        sharp_angle_(options.sharp_angle),
        cosine_at_tips_(portable::cosine(to_radians(turn_at_tip(options.sharp_angle)))) {
    surface_.points = plc.world;
    surface_.is_listed_alone = find_vertices_listed_alone(input, plc);
    segments_ = declared_segments(input, plc, plc::tolerance_of(plc, options.flatness));
    collect_triangles();
    if (options.deviation > 0) keep_wide_bends(options.deviation);
  }

  OriginalSurface cut() {
    do {
      edges_ = plc::make_edge_table(corners_);
      find_features();
      join_patches();
      join_wedges();
    } while (split_uncut_features());
    collect_features();
    measure_normals();
    return std::move(surface_);
  }

 private:
  void collect_triangles() {
    for (std::uint32_t f = 0; f < plc_.facets.size(); ++f) {
      Point3 area;
      for (const auto& [a, b, c] : plc_.triangles_of(plc_.facets[f]))
        area = area + area_vector({plc_.world[a], plc_.world[b], plc_.world[c]});
      for (const auto& t : plc_.triangles_of(plc_.facets[f])) {
        corners_.push_back(t);
        surface_.facet_of.push_back(f);
        surface_.triangle_normals.push_back(normalized(area));
      }
    }
  }

  /// Keeps bends that are too wide for the deviation. Edges of which a part is kept are split.
  void keep_wide_bends(double deviation) {
    edges_ = plc::make_edge_table(corners_);
    find_features();
    const std::vector<double> turns = turns_of_wide_bends(bent_surface(), is_feature_, deviation);
    for (std::uint32_t e = 0; e < turns.size(); ++e)
      if (turns[e] > 0) is_feature_[e] = 1;
    join_patches();
    join_wedges();
    std::vector<WideBend> waiting =
        trim_in_narrow_wedges(bent_surface(), surface_.wedges, is_feature_, turns, deviation);
    while (!waiting.empty()) {
      edges_ = plc::make_edge_table(corners_);
      std::vector<char> is_split(corners_.size(), 0);
      std::vector<WideBend> next;
      for (const WideBend& bend : waiting) {
        const auto [a, b] = bend.ends;
        if (bend.from > bend.to) {
          round_off(bend);
          continue;
        }
        if (bend.from <= 0 && bend.to >= 1) {
          bends_.insert(edge_key(a, b));
          continue;
        }
        const std::uint32_t e = edges_.find(a, b);
        if (std::ranges::any_of(edges_.around(e), [&](std::uint32_t t) { return is_split[t] != 0; })) {
          next.push_back(bend);  // in the next round
          continue;
        }
        for (const std::uint32_t t : edges_.around(e)) is_split[t] = 1;
        const double share = bend.from > 0 ? bend.from : bend.to;
        const VertexId at = split_edge(e, edges_.ends[e][0] == a ? share : 1 - share);
        if (bend.from > 0) {
          round_off({{a, at}, 0, 0, bend.longest});
          next.push_back({{at, b}, 0, 1 - (1 - bend.to) / (1 - share), bend.longest});
        } else {
          round_off({{at, b}, 0, 0, bend.longest});
          next.push_back({{a, at}});
        }
      }
      waiting = std::move(next);
    }
  }

  void round_off(const WideBend& bend) {
    const Point3 a = surface_.points[bend.ends[0]], b = surface_.points[bend.ends[1]];
    constexpr double most_pieces = 1000;  // more would only cost memory
    const double pieces = std::min(most_pieces, std::ceil(length(b - a) / bend.longest));
    for (double i = 0; i < pieces; ++i)
      surface_.rounded.push_back(
          {hull(box_of(a + (i / pieces) * (b - a)), box_of(a + ((i + 1) / pieces) * (b - a))), bend.longest});
  }

  void turn(std::uint32_t t) {
    std::swap(corners_[t][1], corners_[t][2]);
    surface_.triangle_normals[t] = -1 * surface_.triangle_normals[t];
  }

  BentSurface bent_surface() const {
    return {surface_.points, corners_, surface_.triangle_normals, surface_.facet_of, edges_};
  }

  bool oriented_alike(std::uint32_t e) const { return surface::oriented_alike(bent_surface(), e); }

  bool is_sharp(std::uint32_t e) const {
    const auto around = edges_.around(e);
    return sharp_angle_.is_exceeded(surface_.triangle_normals[around[0]], surface_.triangle_normals[around[1]],
                                    oriented_alike(e));
  }

  void find_features() {
    segment_markers_.clear();
    for (std::uint32_t s = 0; s < segments_.size(); ++s)
      segment_markers_.emplace(edge_key(segments_.ends[s][0], segments_.ends[s][1]), segments_.markers[s]);
    is_feature_.assign(edges_.size(), 0);
    for (std::uint32_t e = 0; e < edges_.size(); ++e) {
      const auto around = edges_.around(e);
      is_feature_[e] = around.size() != 2 ||
                       segment_markers_.contains(edge_key(edges_.ends[e][0], edges_.ends[e][1])) ||
                       marker_of(around[0]) != marker_of(around[1]) || is_sharp(e) ||
                       bends_.contains(edge_key(edges_.ends[e][0], edges_.ends[e][1]));
    }
  }

  int marker_of(std::uint32_t t) const { return plc_.facets[surface_.facet_of[t]].marker; }

  // Orients each patch like its first triangle. Where that is impossible (a Moebius strip), the patch is cut.
  void join_patches() {
    const auto count = static_cast<std::uint32_t>(corners_.size());
    surface_.patch_of.assign(count, none);
    surface_.patch_markers.clear();
    surface_.patch_is_flat.clear();
    std::vector<std::uint32_t> stack;
    for (std::uint32_t seed = 0; seed < count; ++seed) {
      if (surface_.patch_of[seed] != none) continue;
      const auto patch = static_cast<std::uint32_t>(surface_.patch_markers.size());
      surface_.patch_markers.push_back(marker_of(seed));
      surface_.patch_is_flat.push_back(1);
      surface_.patch_of[seed] = patch;
      for (stack = {seed}; !stack.empty();) {
        const std::uint32_t t = stack.back();
        stack.pop_back();
        if (surface_.facet_of[t] != surface_.facet_of[seed]) surface_.patch_is_flat[patch] = 0;
        for (const std::uint32_t e : edges_.edges_of[t]) {
          if (is_feature_[e]) continue;
          const std::uint32_t other = edges_.around(e)[edges_.around(e)[0] == t ? 1 : 0];
          if (surface_.patch_of[other] == none) {
            if (!oriented_alike(e)) turn(other);
            surface_.patch_of[other] = patch;
            stack.push_back(other);
          } else if (!oriented_alike(e)) {
            is_feature_[e] = 1;
          }
        }
      }
    }
  }

  void join_wedges() {
    UnionFind corners(3 * corners_.size());
    for (std::uint32_t e = 0; e < edges_.size(); ++e) {
      if (is_feature_[e]) continue;
      const std::uint32_t s = edges_.around(e)[0], t = edges_.around(e)[1];
      for (const VertexId v : edges_.ends[e])
        corners.join(3 * s + corner_at(corners_[s], v), 3 * t + corner_at(corners_[t], v));
    }
    surface_.wedge_points.clear();
    surface_.wedge_patches.clear();
    surface_.wedges.assign(corners_.size(), {});
    std::vector<std::uint32_t> number(3 * corners_.size(), none);
    for (std::uint32_t c = 0; c < number.size(); ++c) {
      std::uint32_t& n = number[corners.find(c)];
      if (n == none) {
        n = static_cast<std::uint32_t>(surface_.wedge_points.size());
        surface_.wedge_points.push_back(corners_[c / 3][c % 3]);
        surface_.wedge_patches.push_back(surface_.patch_of[c / 3]);
      }
      surface_.wedges[c / 3][c % 3] = n;
    }
  }

  // A feature that is a single edge within a patch does not cut it: both sides have the same wedges at its ends. So it
  // gets a vertex in the middle, which has two wedges.
  bool split_uncut_features() {
    std::vector<char> is_split(corners_.size(), 0);
    bool any = false;
    for (std::uint32_t e = 0; e < edges_.size(); ++e) {
      if (!is_feature_[e] || edges_.around(e).size() < 2) continue;
      const auto [a, b] = edges_.ends[e];
      std::vector<std::array<std::uint32_t, 2>> wedges;
      bool untouched = true;
      for (const std::uint32_t t : edges_.around(e)) {
        wedges.push_back(
            {surface_.wedges[t][corner_at(corners_[t], a)], surface_.wedges[t][corner_at(corners_[t], b)]});
        untouched = untouched && !is_split[t];
      }
      std::sort(wedges.begin(), wedges.end());
      if (std::adjacent_find(wedges.begin(), wedges.end()) == wedges.end()) continue;
      any = true;
      if (!untouched) continue;  // in the next round
      for (const std::uint32_t t : edges_.around(e)) is_split[t] = 1;
      split_edge(e, 0.5);
    }
    return any;
  }

  /// \return  the new vertex, at this share of the edge
  VertexId split_edge(std::uint32_t e, double share) {
    const auto [a, b] = edges_.ends[e];
    const VertexId middle(surface_.points.size());
    surface_.points.push_back(surface_.points[a] + share * (surface_.points[b] - surface_.points[a]));
    surface_.is_listed_alone.push_back(0);
    for (const std::uint32_t t : edges_.around(e)) {
      plc::VertexTriple half = corners_[t];
      half[corner_at(half, a)] = middle;
      corners_[t][corner_at(corners_[t], b)] = middle;
      corners_.push_back(half);
      surface_.facet_of.push_back(surface_.facet_of[t]);
      surface_.triangle_normals.push_back(surface_.triangle_normals[t]);
    }
    for (std::uint32_t s = 0; s < segments_.size(); ++s) {
      if (edge_key(segments_.ends[s][0], segments_.ends[s][1]) != edge_key(a, b)) continue;
      segments_.ends[s] = {a, middle};
      segments_.add(middle, b, segments_.markers[s]);
      break;
    }
    if (bends_.contains(edge_key(a, b))) bends_.insert({edge_key(a, middle), edge_key(middle, b)});
    return middle;
  }

  void collect_features() {
    for (std::uint32_t e = 0; e < edges_.size(); ++e) {
      if (!is_feature_[e]) continue;
      FeatureEdge feature;
      feature.ends = {edges_.ends[e][0], edges_.ends[e][1]};
      feature.triangles.assign(edges_.around(e).begin(), edges_.around(e).end());
      const auto segment = segment_markers_.find(edge_key(feature.ends[0], feature.ends[1]));
      feature.is_segment = segment != segment_markers_.end();
      if (feature.is_segment) feature.marker = segment->second;
      surface_.features.push_back(std::move(feature));
    }
    for (std::uint32_t s = 0; s < segments_.size(); ++s)
      if (edges_.find(segments_.ends[s][0], segments_.ends[s][1]) == none)
        surface_.features.push_back({{segments_.ends[s][0], segments_.ends[s][1]}, {}, true, segments_.markers[s]});
  }

  void measure_normals() {
    surface_.wedge_normals.assign(surface_.wedge_points.size(), {});
    for (std::uint32_t t = 0; t < corners_.size(); ++t) {
      const auto [a, b, c] = corners_[t];
      surface_.triangles.push_back({a, b, c});
      for (std::uint32_t k = 0; k < 3; ++k) {
        const double angle = angle_at(surface_.points[corners_[t][k]], surface_.points[corners_[t][(k + 1) % 3]],
                                      surface_.points[corners_[t][(k + 2) % 3]]);
        Point3& normal = surface_.wedge_normals[surface_.wedges[t][k]];
        normal = normal + angle * surface_.triangle_normals[t];
      }
    }
    for (Point3& normal : surface_.wedge_normals) normal = normalized(normal);
    forget_normals_at_tips();
  }

  // Between a tip and the rim of a cone, the mean at the tip would turn the normals away from the surface.
  void forget_normals_at_tips() {
    std::vector<char> is_tip(surface_.wedge_normals.size(), 0);
    for (std::uint32_t t = 0; t < corners_.size(); ++t)
      for (const std::uint32_t w : surface_.wedges[t])
        if (dot(surface_.triangle_normals[t], surface_.wedge_normals[w]) < cosine_at_tips_) is_tip[w] = 1;
    for (std::uint32_t w = 0; w < is_tip.size(); ++w)
      if (is_tip[w]) surface_.wedge_normals[w] = {};
  }

  const plc::Plc& plc_;
  SharpAngle sharp_angle_;
  double cosine_at_tips_;
  std::unordered_set<std::uint64_t> bends_;  // by edge key: kept, although not sharp
  plc::SegmentSet segments_;
  SegmentMarkers segment_markers_;
  std::vector<plc::VertexTriple> corners_;
  plc::EdgeTable edges_;
  std::vector<char> is_feature_;
  OriginalSurface surface_;
};

}  // namespace

OriginalSurface cut_surface(const plc::InputPlc& input, const plc::Plc& plc, const RemeshOptions& options) {
  return SurfaceCutter(input, plc, options).cut();
}

ClosestPoint::ClosestPoint(const OriginalSurface& surface)
    : surface_(surface),
      triangles_(group_indices(surface.patch_markers.size(), surface.triangles.size(),
                               [&](std::size_t t) { return surface.patch_of[t]; })) {
  for (std::size_t patch = 0; patch < surface.patch_markers.size(); ++patch)
    trees_.emplace_back(triangles_.of(patch), [&](std::uint32_t t) { return bounding_box(surface.corners(t)); });
}

Foot ClosestPoint::foot_on(std::uint32_t triangle, const Point3& p) const {
  const std::array<Point3, 3> t = surface_.corners(triangle);
  const std::array<double, 3> weights = closest_on_triangle(p, t);
  const Point3 point = weighted_point(weights, t);
  return {triangle, weights, point, squared_length(p - point)};
}

// The nearest point, or the first one that is near enough.
Foot ClosestPoint::search(std::uint32_t patch, const Point3& p, std::uint32_t near, double squared_enough) const {
  Foot best = foot_on(near, p);
  const auto distance = [&](const Box& box, double) { return squared_distance(box, p); };
  const auto is_near_enough = [&] { return best.squared_distance <= squared_enough; };
  if (is_near_enough()) return best;
  trees_[patch].any_below(best.squared_distance, distance, [&](const BoxTree::Item& item) {
    const Foot foot = foot_on(triangles_.of(patch)[item.number], p);
    if (foot.squared_distance < best.squared_distance) best = foot;
    return is_near_enough();
  });
  return best;
}

bool ClosestPoint::is_within(double distance, std::uint32_t patch, const Point3& p, std::uint32_t near) const {
  const double enough = distance * distance;
  return search(patch, p, near, enough).squared_distance <= enough;
}

Point3 ClosestPoint::normal_at(const Foot& foot) const {
  Point3 normal;
  for (int k = 0; k < 3; ++k)
    normal = normal + foot.weights[k] * surface_.wedge_normals[surface_.wedges[foot.triangle][k]];
  const double l = length(normal);
  return l > 1e-3 ? (1 / l) * normal : surface_.triangle_normals[foot.triangle];
}

}  // namespace ccdt::surface
