#include "models/patch_points.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "models/revolve.h"

namespace ccdt {
namespace {

// In units of the wanted edge length there:
constexpr double least_gap = 0.72;          // between points
constexpr double least_gap_to_edge = 0.52;  // between a point and an edge of the outline
constexpr double triangle_height = 0.8660254037844386;

double gap(const Point2& a, const Point2& b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

Point2 middle(const Point2& a, const Point2& b) {
  return {(a.x + b.x) / 2, (a.y + b.y) / 2};
}

struct Box {
  Point2 low{1e300, 1e300}, high{-1e300, -1e300};
};

Box box_of(std::span<const Point2> points) {
  Box box;
  for (const Point2& p : points) {
    box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y)};
    box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y)};
  }
  return box;
}

/// Points in square buckets, to ask whether one is near a place.
class PointBuckets {
 public:
  PointBuckets(const Box& box, double size) : low_(box.low), size_(size) {
    columns_ = 1 + static_cast<int>((box.high.x - box.low.x) / size);
    rows_ = 1 + static_cast<int>((box.high.y - box.low.y) / size);
    buckets_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
  }

  void add(const Point2& p) { buckets_[slot(column(p.x), row(p.y))].push_back(p); }

  bool any_within(const Point2& p, double radius) const {
    for (int r = row(p.y - radius); r <= row(p.y + radius); ++r) {
      for (int c = column(p.x - radius); c <= column(p.x + radius); ++c) {
        for (const Point2& other : buckets_[slot(c, r)]) {
          if (gap(other, p) < radius) return true;
        }
      }
    }
    return false;
  }

 private:
  int column(double x) const { return std::clamp(static_cast<int>((x - low_.x) / size_), 0, columns_ - 1); }
  int row(double y) const { return std::clamp(static_cast<int>((y - low_.y) / size_), 0, rows_ - 1); }
  std::size_t slot(int c, int r) const {
    return static_cast<std::size_t>(r) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(c);
  }

  Point2 low_;
  double size_;
  int columns_, rows_;
  std::vector<std::vector<Point2>> buckets_;
};

/// The border's edges in horizontal bands, to ask whether a place is enclosed.
class Enclosure {
 public:
  Enclosure(const PatchOutline& outline, const Box& box, double band) : outline_(outline), box_(box), band_(band) {
    bands_.resize(static_cast<std::size_t>((box.high.y - box.low.y) / band) + 1);
    for (std::uint32_t e = 0; e < outline.border.size(); ++e) {
      const auto [low, high] =
          std::minmax(outline.vertices[outline.border[e][0]].y, outline.vertices[outline.border[e][1]].y);
      for (std::size_t b = band_of(low); b <= band_of(high); ++b) bands_[b].push_back(e);
    }
  }

  bool contains(const Point2& p) const {
    if (p.x < box_.low.x || p.x > box_.high.x || p.y < box_.low.y || p.y > box_.high.y) return false;
    bool inside = false;
    for (const std::uint32_t e : bands_[band_of(p.y)]) {
      const Point2& a = outline_.vertices[outline_.border[e][0]];
      const Point2& b = outline_.vertices[outline_.border[e][1]];
      if ((a.y > p.y) == (b.y > p.y)) continue;
      if (a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x) > p.x) inside = !inside;
    }
    return inside;
  }

 private:
  std::size_t band_of(double y) const {
    const auto band = static_cast<std::size_t>(std::max(0.0, (y - box_.low.y) / band_));
    return std::min(band, bands_.size() - 1);
  }

  const PatchOutline& outline_;
  Box box_;
  double band_;
  std::vector<std::vector<std::uint32_t>> bands_;
};

/// The advancing layers of points.
class PointFront {
 public:
  PointFront(const PatchOutline& outline, const PatchSpacing& spacing)
      : spacing_(spacing),
        box_(box_of(outline.vertices)),
        enclosure_(outline, box_, 2 * spacing.smallest()),
        points_(box_, spacing.smallest()),
        edge_samples_(box_, spacing.smallest()) {
    for (const Point2& p : outline.vertices) points_.add(p);
    for (const auto* edges : {&outline.border, &outline.cuts}) {
      for (const auto& [a, b] : *edges) add_samples(outline.vertices[a], outline.vertices[b]);
    }
  }

  /// The tips of the equilateral triangles on both sides of an edge.
  void grow_from_edge(const Point2& a, const Point2& b) {
    const double angle = std::atan2(b.y - a.y, b.x - a.x) + std::numbers::pi / 2;
    const Point2 m = middle(a, b);
    // An edge of the new triangle is at 30 degrees from its height.
    for (const double side : {angle, angle + std::numbers::pi}) {
      try_point(m, side, triangle_height * spacing_(m), side + std::numbers::pi / 6);
    }
  }

  std::vector<Point2> run() {
    for (std::size_t next = 0; next < placed_.size(); ++next) {
      const Placed from = placed_[next];
      for (int k = 0; k < 6; ++k) {
        const double angle = from.angle + k * std::numbers::pi / 3;
        try_point(from.point, angle, spacing_(from.point), angle);
      }
    }
    std::vector<Point2> result;
    result.reserve(placed_.size());
    for (const Placed& placed : placed_) result.push_back(placed.point);
    return result;
  }

 private:
  struct Placed {
    Point2 point;
    double angle;  // of one of the six edges that it should have
  };

  /// Stands for an edge by its middle, and by more points where it is long beside the smallest spacing.
  void add_samples(const Point2& a, const Point2& b) {
    const int parts = std::max(2, static_cast<int>(std::ceil(gap(a, b) / spacing_.smallest())));
    for (int i = 1; i < parts; ++i) {
      const double t = static_cast<double>(i) / parts;
      edge_samples_.add({a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)});
    }
  }

  void try_point(const Point2& from, double angle, double step, double edge_angle) {
    const Point2 p{from.x + step * std::cos(angle), from.y + step * std::sin(angle)};
    const double wanted = spacing_(p);
    if (points_.any_within(p, least_gap * wanted) || edge_samples_.any_within(p, least_gap_to_edge * wanted)) return;
    if (!enclosure_.contains(p)) return;
    points_.add(p);
    placed_.push_back({p, edge_angle});
  }

  const PatchSpacing& spacing_;
  Box box_;
  Enclosure enclosure_;
  PointBuckets points_, edge_samples_;
  std::vector<Placed> placed_;
};

}  // namespace

PatchSpacing::PatchSpacing(const PatchOutline& outline, double edge_length)
    : edge_length_(edge_length), smallest_(edge_length) {
  std::vector<double> longest(outline.vertices.size(), 0.0);
  for (const auto* edges : {&outline.border, &outline.cuts}) {
    for (const auto& [a, b] : *edges) {
      const double length = gap(outline.vertices[a], outline.vertices[b]);
      longest[a] = std::max(longest[a], length);
      longest[b] = std::max(longest[b], length);
    }
  }
  for (std::size_t i = 0; i < longest.size(); ++i) {
    if (longest[i] < 0.8 * edge_length) fine_.push_back({outline.vertices[i], longest[i]});
    smallest_ = std::min(smallest_, longest[i]);
  }
}

double PatchSpacing::operator()(const Point2& point) const {
  double result = edge_length_;
  for (const Source& s : fine_) result = std::min(result, s.spacing + edge_length_growth * gap(s.point, point));
  return result;
}

std::vector<Point2> place_patch_points(const PatchOutline& outline, const PatchSpacing& spacing) {
  PointFront front(outline, spacing);
  for (const auto* edges : {&outline.border, &outline.cuts}) {
    for (const auto& [a, b] : *edges) front.grow_from_edge(outline.vertices[a], outline.vertices[b]);
  }
  return front.run();
}

}  // namespace ccdt
