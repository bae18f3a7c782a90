#include "engine/lattice/size_field.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "engine/base/morton.h"
#include "engine/base/parallel.h"

namespace ccdt::lattice {

namespace {

constexpr std::size_t grain = 4096;  ///< of loops on several threads

/// The part of a segment, from 0 to 1, where some linear functions are not negative.
struct Part {
  double from = 0, to = 1;

  /// \param a,b  the values of a linear function at the ends
  void clip(double a, double b) {
    if (a < 0 && b < 0) to = -1;
    if (a < 0 && b >= 0) from = std::max(from, a / (a - b));
    if (a >= 0 && b < 0) to = std::min(to, a / (a - b));
  }
  bool is_empty() const { return from > to; }
  double least(double a, double b) const { return std::min(a + from * (b - a), a + to * (b - a)); }
};

/// The distance of a point from the six planes of a box, positive inside.
std::array<double, 6> depths(const Box& box, const Point3& p) {
  return {p.x - box.low.x, p.y - box.low.y, p.z - box.low.z, box.high.x - p.x, box.high.y - p.y, box.high.z - p.z};
}

template <std::size_t Count>
Part common_part(const std::array<double, Count>& a, const std::array<double, Count>& b) {
  Part part;
  for (std::size_t i = 0; i < Count; ++i) part.clip(a[i], b[i]);
  return part;
}

/// Barycentric coordinates in one tetrahedron.
class Barycentric {
 public:
  explicit Barycentric(const std::array<Point3, 4>& corners) : origin_(corners[0]) {
    const Point3 b = corners[1] - origin_, c = corners[2] - origin_, d = corners[3] - origin_;
    sixfold_volume_ = dot(cross(b, c), d);
    if (is_flat()) return;
    normals_ = {(1 / sixfold_volume_) * cross(c, d), (1 / sixfold_volume_) * cross(d, b),
                (1 / sixfold_volume_) * cross(b, c)};
  }
  bool is_flat() const { return sixfold_volume_ == 0; }
  std::array<double, 4> at(const Point3& p) const {
    const Point3 q = p - origin_;
    const double b = dot(normals_[0], q), c = dot(normals_[1], q), d = dot(normals_[2], q);
    return {1 - b - c - d, b, c, d};
  }

 private:
  Point3 origin_;
  double sixfold_volume_ = 0;
  std::array<Point3, 3> normals_;
};

Point3 corner(const Box& box, unsigned i) {
  return {i & 1 ? box.high.x : box.low.x, i & 2 ? box.high.y : box.low.y, i & 4 ? box.high.z : box.low.z};
}

struct Mean {
  double sum = 0, count = 0;
  void add(double x) { sum += x, ++count; }
  double value() const { return sum / count; }
};

struct Weighted {
  double size, weight;
};

/// The number of points that need each size, up to a factor: those of a tetrahedron, or one per vertex.
std::vector<Weighted> weigh_sizes(const BackgroundSizes& background, double largest) {
  std::vector<Weighted> sizes;
  for (const auto& [a, b, c, d] : background.tetrahedra) {
    const auto& v = background.vertices;
    const auto& s = background.sizes;
    const double size = std::min((s[a] + s[b] + s[c] + s[d]) / 4, largest);
    sizes.push_back({size, std::abs(dot(cross(v[b] - v[a], v[c] - v[a]), v[d] - v[a])) / (size * size * size)});
  }
  if (background.tetrahedra.empty())
    for (const double size : background.sizes) sizes.push_back({std::min(size, largest), 1});
  return sizes;
}

double median(std::vector<Weighted> sizes) {
  std::ranges::stable_sort(sizes, {}, &Weighted::size);
  double rest = 0;
  for (const Weighted& s : sizes) rest += s.weight / 2;
  for (const Weighted& s : sizes) {
    rest -= s.weight;
    if (rest <= 0) return s.size;
  }
  return sizes.back().size;
}

}  // namespace

// The least value is at a corner of the common part, and each of those is on an edge of the one or of the other.
double least_value(const std::array<Point3, 4>& corners, const std::array<double, 4>& values, const Box& box) {
  double least = HUGE_VAL;
  const Barycentric barycentric(corners);
  if (barycentric.is_flat()) return least;
  std::array<std::array<double, 6>, 4> depth;
  for (unsigned i = 0; i < 4; ++i) depth[i] = depths(box, corners[i]);
  for (unsigned i = 0; i < 4; ++i) {
    for (unsigned j = 0; j < i; ++j) {
      const Part part = common_part(depth[i], depth[j]);
      if (!part.is_empty()) least = std::min(least, part.least(values[i], values[j]));
    }
  }
  std::array<std::array<double, 4>, 8> weights;
  std::array<double, 8> value_at;
  for (unsigned i = 0; i < 8; ++i) {
    weights[i] = barycentric.at(corner(box, i));
    value_at[i] = 0;
    for (unsigned k = 0; k < 4; ++k) value_at[i] += weights[i][k] * values[k];
  }
  for (unsigned i = 0; i < 8; ++i) {
    for (unsigned axis = 1; axis < 8; axis *= 2) {
      const unsigned j = i | axis;
      if (j == i) continue;
      const Part part = common_part(weights[i], weights[j]);
      if (!part.is_empty()) least = std::min(least, part.least(value_at[i], value_at[j]));
    }
  }
  return least;
}

InterpolatedSizes::InterpolatedSizes(const BackgroundSizes& background) : background_(background) {
  RawVector<Box> tetrahedra, vertices;
  RawVector<double> least_sizes, sizes;
  for (const auto& v : background.tetrahedra) {
    std::array<Point3, 4> corners;
    double size = HUGE_VAL;
    for (unsigned i = 0; i < 4; ++i) {
      corners[i] = background.vertices[v[i]];
      size = std::min(size, background.sizes[v[i]]);
    }
    tetrahedra.push_back(bounding_box(corners));
    least_sizes.push_back(size);
  }
  for (const Point3& p : background.vertices) vertices.push_back(box_of(p));
  for (const double size : background.sizes) sizes.push_back(size);
  tetrahedra_ = BoxTree(std::move(tetrahedra), least_sizes);
  vertices_ = BoxTree(std::move(vertices), sizes);
}

double InterpolatedSizes::least_in(const Box& box, std::uint32_t tetrahedron) const {
  std::array<Point3, 4> corners;
  std::array<double, 4> sizes;
  for (unsigned i = 0; i < 4; ++i) {
    const std::uint32_t v = background_.tetrahedra[tetrahedron][i];
    corners[i] = background_.vertices[v];
    sizes[i] = background_.sizes[v];
  }
  return least_value(corners, sizes, box);
}

bool InterpolatedSizes::is_below(const Box& box, double bound) const {
  const auto least_if_meeting = [&](const Box& other, double size) { return other.meets(box) ? size : HUGE_VAL; };
  if (tetrahedra_.any_below(bound, least_if_meeting,
                            [&](const BoxTree::Item& item) { return least_in(box, item.number) < bound; }))
    return true;
  const bool meets = tetrahedra_.any_below(
      HUGE_VAL, least_if_meeting, [&](const BoxTree::Item& item) { return least_in(box, item.number) < HUGE_VAL; });
  return !meets && is_below_outside(box, bound);
}

/// A vertex whose least distance to the box exceeds the greatest distance of another is nearest to no point of the box.
bool InterpolatedSizes::is_below_outside(const Box& box, double bound) const {
  double farthest = HUGE_VAL;
  const auto distance = [&](const Box& other, double) { return squared_distance(other, box); };
  vertices_.any_below(farthest, distance, [&](const BoxTree::Item& item) {
    farthest = std::min(farthest, squared_farthest_distance(box, item.box.low));
    return false;
  });
  const auto size_if_near = [&](const Box& other, double size) {
    return distance(other, size) <= farthest ? size : HUGE_VAL;
  };
  return vertices_.any_below(bound, size_if_near, [](const BoxTree::Item&) { return true; });
}

SizeField::SizeField(const DomainSurface& surface, double edge_length, double grading,
                     const BackgroundSizes* background)
    : grading_(grading) {
  if (background != nullptr && !background->empty()) {
    sample(*background, edge_length);
  } else {
    sample(surface, edge_length);
  }
}

void SizeField::sample(const DomainSurface& surface, double edge_length) {
  const std::size_t triangles = surface.triangles.size();
  RawVector<Box> places(triangles);
  RawVector<double> sizes(triangles);
  places.reserve(triangles + surface.vertices.size()), sizes.reserve(triangles + surface.vertices.size());
  RawVector<std::array<double, 3>> lengths(triangles);
  parallel_for(triangles, grain, [&](std::size_t t) {
    const auto [a, b, c] = surface.corners(static_cast<std::uint32_t>(t));
    lengths[t] = {length(b - a), length(c - b), length(a - c)};
    places[t] = box_of((1.0 / 3) * (a + b + c));
    sizes[t] = (lengths[t][0] + lengths[t][1] + lengths[t][2]) / 3;
  });
  // The sums are rounded, so they are made in one order.
  std::vector<Mean> at_vertex(surface.vertices.size());
  Mean everywhere;
  const auto add_edge = [&](VertexId a, VertexId b, double its_length) {
    at_vertex[a].add(its_length);
    at_vertex[b].add(its_length);
    everywhere.add(its_length);
  };
  for (std::size_t t = 0; t < triangles; ++t) {
    const auto& v = surface.triangles[t].vertices;
    for (int i = 0; i < 3; ++i) add_edge(v[i], v[(i + 1) % 3], lengths[t][i]);
  }
  for (const auto& [a, b] : surface.subsegments) add_edge(a, b, length(surface.vertices[b] - surface.vertices[a]));
  reference_ = edge_length > 0 || everywhere.count == 0 ? edge_length : everywhere.value();
  largest_ = edge_length > 0 || grading_ == 0 ? reference_ : HUGE_VAL;
  if (grading_ <= 0) return;
  for (std::size_t v = 0; v < at_vertex.size(); ++v) {
    if (at_vertex[v].count == 0) continue;
    places.push_back(box_of(surface.vertices[v]));
    sizes.push_back(at_vertex[v].value());
  }
  samples_ = BoxTree(std::move(places), sizes);
}

void SizeField::sample(const BackgroundSizes& background, double edge_length) {
  largest_ = edge_length > 0 ? edge_length : HUGE_VAL;
  reference_ = median(weigh_sizes(background, largest_));
  if (!background.tetrahedra.empty()) {
    largest_ = std::min(largest_, std::ranges::max(background.sizes));
    interpolated_.emplace(background);
    return;
  }
  RawVector<Box> places;
  RawVector<double> sizes;
  for (const Point3& p : background.vertices) places.push_back(box_of(p));
  for (const double size : background.sizes) sizes.push_back(size);
  samples_ = BoxTree(std::move(places), sizes);
}

bool SizeField::is_below(const Box& box, double bound) const {
  if (largest_ < bound) return true;
  if (interpolated_) return interpolated_->is_below(box, bound);
  const auto reach = [&](const Box& place, double size) {
    return size + grading_ * std::sqrt(squared_distance(place, box));
  };
  return samples_.any_below(bound, reach, [](const BoxTree::Item&) { return true; });
}

}  // namespace ccdt::lattice
