#include "models/patch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <span>
#include <stdexcept>
#include <unordered_map>
#include <utility>

#include "engine/planar/triangulation.h"
#include "models/revolve.h"

namespace ccdt::models {
namespace {

constexpr int smoothing_rounds = 8;
// In units of the wanted edge length there:
constexpr double least_gap = 0.72;          // between points
constexpr double least_gap_to_edge = 0.52;  // between a point and an edge of the outline
constexpr double triangle_height = 0.8660254037844386;

double gap(const planar::Point2& a, const planar::Point2& b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

planar::Point2 middle(const planar::Point2& a, const planar::Point2& b) {
  return {(a.x + b.x) / 2, (a.y + b.y) / 2};
}

using PatchEdge = std::array<std::uint32_t, 2>;

/// The edges of a patch and their vertices, in the plane.
struct PatchOutline {
  std::vector<planar::Point2> vertices;
  std::vector<PatchEdge> border;  ///< closed loops that do not cross; a point within an odd number of them is inside
  std::vector<PatchEdge> cuts;    ///< further edges inside the border
};

/// The edge length wanted at a place of a patch. It is the target, but near the outline it is limited by the outline's
/// own edge length, plus the growth that the distance allows.
class PatchSpacing {
 public:
  PatchSpacing(const PatchOutline& outline, double edge_length);

  double operator()(const planar::Point2& point) const;
  double smallest() const { return smallest_; }
  bool is_uniform() const { return fine_.empty(); }

 private:
  struct Source {
    planar::Point2 point;
    double spacing;
  };
  std::vector<Source> fine_;  // the vertices whose edges are clearly shorter than the target
  double edge_length_;
  double smallest_;
};

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

double PatchSpacing::operator()(const planar::Point2& point) const {
  double result = edge_length_;
  for (const Source& s : fine_) result = std::min(result, s.spacing + edge_length_growth * gap(s.point, point));
  return result;
}

struct PlanarBox {
  planar::Point2 low{1e300, 1e300}, high{-1e300, -1e300};
};

PlanarBox bounds_of(std::span<const planar::Point2> points) {
  PlanarBox box;
  for (const planar::Point2& p : points) {
    box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y)};
    box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y)};
  }
  return box;
}

/// Points in square buckets, to find whether one is near a position.
class PointBuckets {
 public:
  PointBuckets(const PlanarBox& box, double size) : low_(box.low), size_(size) {
    columns_ = 1 + static_cast<int>((box.high.x - box.low.x) / size);
    rows_ = 1 + static_cast<int>((box.high.y - box.low.y) / size);
    buckets_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
  }

  void add(const planar::Point2& p) { buckets_[slot(column(p.x), row(p.y))].push_back(p); }

  bool any_within(const planar::Point2& p, double radius) const {
    for (int r = row(p.y - radius); r <= row(p.y + radius); ++r) {
      for (int c = column(p.x - radius); c <= column(p.x + radius); ++c) {
        for (const planar::Point2& other : buckets_[slot(c, r)]) {
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

  planar::Point2 low_;
  double size_;
  int columns_, rows_;
  std::vector<std::vector<planar::Point2>> buckets_;
};

/// The border's edges in horizontal bands, to ask whether a place is enclosed.
class Enclosure {
 public:
  Enclosure(const PatchOutline& outline, const PlanarBox& box, double band)
      : outline_(outline), box_(box), band_(band) {
    bands_.resize(static_cast<std::size_t>((box.high.y - box.low.y) / band) + 1);
    for (std::uint32_t e = 0; e < outline.border.size(); ++e) {
      const auto [low, high] =
          std::minmax(outline.vertices[outline.border[e][0]].y, outline.vertices[outline.border[e][1]].y);
      for (std::size_t b = band_of(low); b <= band_of(high); ++b) bands_[b].push_back(e);
    }
  }

  bool contains(const planar::Point2& p) const {
    if (p.x < box_.low.x || p.x > box_.high.x || p.y < box_.low.y || p.y > box_.high.y) return false;
    bool inside = false;
    for (const std::uint32_t e : bands_[band_of(p.y)]) {
      const planar::Point2& a = outline_.vertices[outline_.border[e][0]];
      const planar::Point2& b = outline_.vertices[outline_.border[e][1]];
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
  PlanarBox box_;
  double band_;
  std::vector<std::vector<std::uint32_t>> bands_;
};

/// Places points in advancing layers.
class PointFront {
 public:
  PointFront(const PatchOutline& outline, const PatchSpacing& spacing)
      : spacing_(spacing),
        box_(bounds_of(outline.vertices)),
        enclosure_(outline, box_, 2 * spacing.smallest()),
        points_(box_, spacing.smallest()),
        edge_samples_(box_, spacing.smallest()) {
    for (const planar::Point2& p : outline.vertices) points_.add(p);
    for (const auto* edges : {&outline.border, &outline.cuts}) {
      for (const auto& [a, b] : *edges) add_samples(outline.vertices[a], outline.vertices[b]);
    }
  }

  /// Tries to place the tips of the equilateral triangles on both sides of an edge.
  void grow_from_edge(const planar::Point2& a, const planar::Point2& b) {
    const double angle = std::atan2(b.y - a.y, b.x - a.x) + std::numbers::pi / 2;
    const planar::Point2 m = middle(a, b);
    // An edge of the new triangle is at 30 degrees from its height.
    for (const double side : {angle, angle + std::numbers::pi}) {
      try_point(m, side, triangle_height * spacing_(m), side + std::numbers::pi / 6);
    }
  }

  std::vector<planar::Point2> run() {
    for (std::size_t next = 0; next < placed_.size(); ++next) {
      const Placed from = placed_[next];
      for (int k = 0; k < 6; ++k) {
        const double angle = from.angle + k * std::numbers::pi / 3;
        try_point(from.point, angle, spacing_(from.point), angle);
      }
    }
    std::vector<planar::Point2> result;
    result.reserve(placed_.size());
    for (const Placed& placed : placed_) result.push_back(placed.point);
    return result;
  }

 private:
  struct Placed {
    planar::Point2 point;
    double angle;  // direction of one of the six edges that the point should have
  };

  /// Represents an edge by its middle, or by more points if it is long compared with the smallest spacing.
  void add_samples(const planar::Point2& a, const planar::Point2& b) {
    const int parts = std::max(2, static_cast<int>(std::ceil(gap(a, b) / spacing_.smallest())));
    for (int i = 1; i < parts; ++i) {
      const double t = static_cast<double>(i) / parts;
      edge_samples_.add({a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)});
    }
  }

  void try_point(const planar::Point2& from, double angle, double step, double edge_angle) {
    const planar::Point2 p{from.x + step * std::cos(angle), from.y + step * std::sin(angle)};
    const double wanted = spacing_(p);
    if (points_.any_within(p, least_gap * wanted) || edge_samples_.any_within(p, least_gap_to_edge * wanted)) return;
    if (!enclosure_.contains(p)) return;
    points_.add(p);
    placed_.push_back({p, edge_angle});
  }

  const PatchSpacing& spacing_;
  PlanarBox box_;
  Enclosure enclosure_;
  PointBuckets points_, edge_samples_;
  std::vector<Placed> placed_;
};

/// Places points inside the outline layer by layer, from its edges inward. Each point makes an equilateral triangle
/// with existing points, and no two points are too close.
std::vector<planar::Point2> place_patch_points(const PatchOutline& outline, const PatchSpacing& spacing) {
  PointFront front(outline, spacing);
  for (const auto* edges : {&outline.border, &outline.cuts}) {
    for (const auto& [a, b] : *edges) front.grow_from_edge(outline.vertices[a], outline.vertices[b]);
  }
  return front.run();
}

struct LaidOutPatch {
  PatchOutline plane;
  std::vector<std::uint32_t> vertices;  // of the surface, for each vertex of the outline
};

LaidOutPatch lay_out(const ModelSurface& surface, const SurfacePatch& patch) {
  LaidOutPatch outline;
  std::unordered_map<std::uint32_t, std::uint32_t> known;
  const auto local = [&](std::uint32_t id) {
    const auto [at, is_new] = known.emplace(id, static_cast<std::uint32_t>(outline.vertices.size()));
    if (is_new) {
      outline.vertices.push_back(id);
      outline.plane.vertices.push_back(patch.chart.flatten(surface.vertices[id]));
    }
    return at->second;
  };
  for (const Chain& loop : patch.loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const std::uint32_t from = local(loop[i]);
      outline.plane.border.push_back({from, local(loop[(i + 1) % loop.size()])});
    }
  }
  for (const Chain& cut : patch.cuts) {
    for (std::size_t i = 0; i + 1 < cut.size(); ++i) {
      const std::uint32_t from = local(cut[i]);
      outline.plane.cuts.push_back({from, local(cut[i + 1])});
    }
  }
  return outline;
}

planar::Triangulation triangulate(const std::vector<planar::Point2>& points, const PatchOutline& outline) {
  std::vector<VertexId> vertices(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) vertices[i] = VertexId(i);
  std::vector<planar::Edge> edges;
  for (const auto* part : {&outline.border, &outline.cuts}) {
    for (const auto& [a, b] : *part) edges.push_back({VertexId(a), VertexId(b)});
  }
  planar::Carving carving;
  carving.nested = true;
  planar::TriangulationResult result = planar::triangulate(vertices, edges, planar::Points(points), carving);
  const auto is_kept = [&](const planar::Edge& e) {
    return planar::find_edge(result.triangulation, e[0], e[1]).has_value();
  };
  if (!result || !result.unused.empty() || !std::all_of(edges.begin(), edges.end(), is_kept)) {
    throw std::logic_error("the curves of a patch cross, or meet at points that are not shared vertices");
  }
  return std::move(result.triangulation);
}

double doubled_area(const planar::Point2& a, const planar::Point2& b, const planar::Point2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

planar::Point2 circumcenter(const planar::Point2& a, const planar::Point2& b, const planar::Point2& c) {
  const double bx = b.x - a.x, by = b.y - a.y, cx = c.x - a.x, cy = c.y - a.y;
  const double b2 = bx * bx + by * by, c2 = cx * cx + cy * cy, d = 2 * (bx * cy - by * cx);
  return {a.x + (cy * b2 - by * c2) / d, a.y + (bx * c2 - cx * b2) / d};
}

/// The triangles around each vertex, one list after the other.
struct Stars {
  std::vector<std::uint32_t> first, triangles;
};

Stars stars_of(const planar::Triangulation& mesh, std::size_t vertices) {
  Stars stars{std::vector<std::uint32_t>(vertices + 1, 0), std::vector<std::uint32_t>(3 * mesh.triangles.size())};
  for (const auto& t : mesh.triangles) {
    for (const VertexId v : t) ++stars.first[v + 1];
  }
  std::partial_sum(stars.first.begin(), stars.first.end(), stars.first.begin());
  std::vector<std::uint32_t> next(stars.first.begin(), stars.first.end() - 1);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const VertexId v : mesh.triangles[t]) stars.triangles[next[v]++] = t;
  }
  return stars;
}

/// Moves a vertex to the mean of the circumcenters around it, weighted by area and density, unless a triangle would
/// turn over or become much flatter than it is.
void smooth_vertex(std::uint32_t v, std::vector<planar::Point2>& points, const planar::Triangulation& mesh,
                   const Stars& stars, const PatchSpacing& spacing) {
  const auto corners_of = [&](std::uint32_t i) { return mesh.triangles[stars.triangles[i]]; };
  double weights = 0, x = 0, y = 0, flattest = 1e300;
  for (std::uint32_t i = stars.first[v]; i < stars.first[v + 1]; ++i) {
    const auto [a, b, c] = corners_of(i);
    const planar::Point2 centroid{(points[a].x + points[b].x + points[c].x) / 3,
                                  (points[a].y + points[b].y + points[c].y) / 3};
    const planar::Point2 center = circumcenter(points[a], points[b], points[c]);
    const double wanted = spacing(centroid);
    const double area = doubled_area(points[a], points[b], points[c]);
    const double weight = area / (wanted * wanted * wanted * wanted);
    flattest = std::min(flattest, area);
    weights += weight;
    x += weight * center.x;
    y += weight * center.y;
  }
  const planar::Point2 before = points[v];
  points[v] = {x / weights, y / weights};
  const double wanted = spacing(points[v]);
  const double least = std::min(flattest, 0.2 * wanted * wanted);
  for (std::uint32_t i = stars.first[v]; i < stars.first[v + 1]; ++i) {
    const auto [a, b, c] = corners_of(i);
    if (doubled_area(points[a], points[b], points[c]) < least) {
      points[v] = before;
      return;
    }
  }
}

}  // namespace

Chart plane_chart(const Point3& origin, const Point3& normal) {
  const Point3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  const Point3 u = normal.z == 0 ? z : normal.y == 0 ? y : x;
  if (dot(u, normal) != 0) throw std::logic_error("a plane of a model must be parallel to an axis");
  const Point3 v = cross(normal, u);
  return {[=](const Point3& p) {
            return planar::Point2{dot(p - origin, u), dot(p - origin, v)};
          },
          [=](const planar::Point2& q) { return origin + q.x * u + q.y * v; }};
}

Chart cylinder_chart(Axis axis, const Point3& center, double radius, double middle, OuterSide outer_side) {
  const double side = outer_side == OuterSide::away_from_axis ? 1 : -1;
  const Point3 origin = to_local(axis, center);
  const double cos_middle = cosine(middle), sin_middle = sine(middle);
  const auto flatten = [=](const Point3& model) {
    const Point3 p = to_local(axis, model) - origin;
    const double along = cos_middle * p.x + sin_middle * p.y;
    const double across = cos_middle * p.y - sin_middle * p.x;
    return planar::Point2{side * radius * std::atan2(across, along), p.z};
  };
  const auto lift = [=](const planar::Point2& q) {
    const double angle = middle * std::numbers::pi / 180 + side * q.x / radius;
    return to_model(axis, origin + Point3{radius * std::cos(angle), radius * std::sin(angle), q.y});
  };
  return {flatten, lift};
}

void add_patch(ModelSurface& surface, const SurfacePatch& patch) {
  const LaidOutPatch outline = lay_out(surface, patch);
  const PatchSpacing spacing(outline.plane, patch.edge_length);
  std::vector<planar::Point2> points = outline.plane.vertices;
  const std::vector<planar::Point2> inner = place_patch_points(outline.plane, spacing);
  points.insert(points.end(), inner.begin(), inner.end());

  planar::Triangulation mesh = triangulate(points, outline.plane);
  const auto border = static_cast<std::uint32_t>(outline.vertices.size());
  for (int round = 0; round < smoothing_rounds && !inner.empty(); ++round) {
    const Stars stars = stars_of(mesh, points.size());
    for (std::uint32_t v = border; v < points.size(); ++v) smooth_vertex(v, points, mesh, stars, spacing);
    planar::legalize(mesh, planar::Points(points));
  }

  std::vector<std::uint32_t> ids = outline.vertices;
  for (std::size_t i = border; i < points.size(); ++i) ids.push_back(add_vertex(surface, patch.chart.lift(points[i])));
  for (const auto& [a, b, c] : mesh.triangles) add_triangle(surface, ids[a], ids[b], ids[c], patch.marker);
}

}  // namespace ccdt::models
