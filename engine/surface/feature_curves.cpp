#include "engine/surface/feature_curves.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "engine/base/point.h"
#include "engine/base/portable_math.h"

namespace ccdt::surface {
namespace {

class Chainer {
 public:
  Chainer(const OriginalSurface& surface, double sharp_angle)
      : surface_(surface), sharp_angle_(to_radians(sharp_angle + 1e-6)), features_at_(surface.points.size()) {
    for (std::uint32_t f = 0; f < surface.features.size(); ++f)
      for (const std::uint32_t p : surface.features[f].ends) features_at_[p].push_back(f);
    result_.piece_of.assign(surface.features.size(), {none, {}});
  }

  FeatureCurves chain() {
    find_corners();
    for (std::uint32_t p = 0; p < surface_.points.size(); ++p)
      if (result_.is_corner[p]) chain_from(p);
    for (std::uint32_t p = 0; p < surface_.points.size(); ++p) {
      if (features_at_[p].empty() || result_.piece_of[features_at_[p][0]].curve != none) continue;
      result_.is_corner[p] = 1;  // the only corner of its loop
      chain_from(p);
    }
    return std::move(result_);
  }

 private:
  void find_corners() {
    result_.is_corner = surface_.is_listed_alone;
    for (std::uint32_t w = 0; w < surface_.wedge_normals.size(); ++w)
      if (surface_.wedge_normals[w] == Point3{}) result_.is_corner[surface_.wedge_points[w]] = 1;  // a tip
    for (std::uint32_t p = 0; p < surface_.points.size(); ++p)
      if (features_at_[p].size() != 2 ? !features_at_[p].empty() : !runs_on(p)) result_.is_corner[p] = 1;
    find_points_of_other_wedges();
  }

  std::uint32_t other_end(std::uint32_t feature, std::uint32_t p) const {
    const auto& ends = surface_.features[feature].ends;
    return ends[0] == p ? ends[1] : ends[0];
  }

  bool runs_on(std::uint32_t p) const {
    const FeatureEdge &e = surface_.features[features_at_[p][0]], &f = surface_.features[features_at_[p][1]];
    if (e.is_segment != f.is_segment || e.marker != f.marker || e.triangles.size() != f.triangles.size()) return false;
    const double angle = angle_at(surface_.points[p], surface_.points[other_end(features_at_[p][0], p)],
                                  surface_.points[other_end(features_at_[p][1], p)]);
    return portable::pi - angle <= sharp_angle_;
  }

  // Every wedge at a movable point must reach from one feature to the other.
  void find_points_of_other_wedges() {
    std::vector<std::array<std::uint32_t, 2>> sides(surface_.wedge_points.size(), {none, none});
    for (std::uint32_t f = 0; f < surface_.features.size(); ++f)
      for (const std::uint32_t t : surface_.features[f].triangles)
        for (int k = 0; k < 3; ++k) {
          const std::uint32_t p = surface_.triangles[t][k];
          if (p != surface_.features[f].ends[0] && p != surface_.features[f].ends[1]) continue;
          auto& side = sides[surface_.wedges[t][k]];
          side[side[0] == none ? 0 : 1] = f;
        }
    std::vector<std::uint32_t> wedge_count(surface_.points.size(), 0);
    for (std::uint32_t w = 0; w < sides.size(); ++w) {
      const std::uint32_t p = surface_.wedge_points[w];
      ++wedge_count[p];
      const bool has_features = !features_at_[p].empty();
      if (has_features ? sides[w][1] == none || sides[w][0] == sides[w][1] : wedge_count[p] > 1)
        result_.is_corner[p] = 1;
    }
  }

  void chain_from(std::uint32_t corner) {
    for (const std::uint32_t first : features_at_[corner]) {
      if (result_.piece_of[first].curve != none) continue;
      const auto number = static_cast<std::uint32_t>(result_.curves.size());
      FeatureCurve curve;
      curve.is_segment = surface_.features[first].is_segment;
      curve.marker = surface_.features[first].marker;
      curve.points = {surface_.points[corner]};
      curve.arc = {0};
      std::uint32_t p = corner, f = first;
      while (true) {
        const std::uint32_t q = other_end(f, p);
        curve.points.push_back(surface_.points[q]);
        curve.arc.push_back(curve.arc.back() + length(surface_.points[q] - surface_.points[p]));
        const double before = curve.arc[curve.arc.size() - 2], after = curve.arc.back();
        result_.piece_of[f] = {
            number, surface_.features[f].ends[0] == p ? std::array{before, after} : std::array{after, before}};
        if (result_.is_corner[q]) break;
        f = features_at_[q][features_at_[q][0] == f ? 1 : 0];
        p = q;
      }
      result_.curves.push_back(std::move(curve));
    }
  }

  const OriginalSurface& surface_;
  double sharp_angle_;
  std::vector<std::vector<std::uint32_t>> features_at_;
  FeatureCurves result_;
};

}  // namespace

Point3 FeatureCurve::at(double arc_length) const {
  const auto after = std::upper_bound(arc.begin() + 1, arc.end() - 1, arc_length);
  const auto i = static_cast<std::size_t>(after - arc.begin());
  const double t = std::clamp((arc_length - arc[i - 1]) / (arc[i] - arc[i - 1]), 0.0, 1.0);
  return points[i - 1] + t * (points[i] - points[i - 1]);
}

double FeatureCurve::at_bend(double arc_length, double reach) const {
  constexpr double least_turn = 0.01;  // radians; less is rounding or irrelevant
  double best = arc_length;
  for (auto i = static_cast<std::size_t>(std::lower_bound(arc.begin(), arc.end(), arc_length - reach) - arc.begin());
       i < arc.size() && arc[i] <= arc_length + reach; ++i) {
    if (i == 0 || i + 1 == arc.size()) continue;
    if (portable::pi - angle_at(points[i], points[i - 1], points[i + 1]) < least_turn) continue;
    if (best == arc_length || std::fabs(arc[i] - arc_length) < std::fabs(best - arc_length)) best = arc[i];
  }
  return best;
}

double FeatureCurve::deviation(double from, double to) const {
  if (from > to) std::swap(from, to);
  const Point3 a = at(from), along = normalized(at(to) - a);
  double largest = 0;
  for (auto i = static_cast<std::size_t>(std::upper_bound(arc.begin(), arc.end(), from) - arc.begin());
       i < arc.size() && arc[i] < to; ++i)
    largest = std::max(largest, length(cross(points[i] - a, along)));
  return largest;
}

FeatureCurves chain_features(const OriginalSurface& surface, double sharp_angle) {
  return Chainer(surface, sharp_angle).chain();
}

}  // namespace ccdt::surface
