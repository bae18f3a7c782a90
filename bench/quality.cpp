#include "bench/quality.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <span>
#include <utility>

#include "bench/statistics.h"
#include "engine/base/parallel.h"

namespace ccdt::bench {
namespace {

constexpr double regular_factor = 8.485281374238570;  ///< 6 sqrt(2): makes the regular tetrahedron's r equal to 1
constexpr double degrees = 180 / std::numbers::pi;

/// Growing steps for r and the aspect ratio: nearly all tetrahedra are near 1, and the bad ones are spread over
/// decades.
const std::vector<double> r_edges = {1, 1.1, 1.2, 1.3, 1.4, 1.5, 1.75, 2, 2.5, 3, 4, 5, 10, 100, 1000};

/// From the value of the regular tetrahedron, which is the minimum; with TetGen's usual bounds 1.2, 1.414 and 2.
const std::vector<double> radius_edge_edges = {0.6, 0.65, 0.7, 0.75, 0.8, 0.9, 1, 1.2, 1.414, 2, 3, 5, 10, 100, 1000};

constexpr double dihedral_step = 5;

double volume(const std::array<Point3, 4>& t) {
  return dot(cross(t[1] - t[0], t[2] - t[0]), t[3] - t[0]) / 6;
}

void count(Histogram& histogram, double value) {
  const auto above = std::ranges::upper_bound(histogram.edges, value) - histogram.edges.begin();
  const auto last = static_cast<std::ptrdiff_t>(histogram.counts.size()) - 1;
  ++histogram.counts[static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(above - 1, 0, last))];
}

Histogram empty_histogram(std::vector<double> edges) {
  const std::size_t bins = edges.size() - 1;
  return {std::move(edges), std::vector<std::uint64_t>(bins, 0)};
}

std::vector<double> dihedral_edges() {
  std::vector<double> edges;
  for (double angle = 0; angle <= 180; angle += dihedral_step) edges.push_back(angle);
  return edges;
}

Quality::Measure measure_of(std::span<const double> values, const std::vector<double>& edges) {
  Quality::Measure measure;
  measure.histogram = empty_histogram(edges);
  if (values.empty()) return measure;
  double sum = 0;
  for (const double value : values) {
    sum += value;
    count(measure.histogram, value);
  }
  measure.min = std::ranges::min(values);
  measure.mean = sum / static_cast<double>(values.size());
  measure.median = median(values);
  measure.p99 = quantile(values, 0.99);
  measure.max = std::ranges::max(values);
  return measure;
}

Quality::Dihedral no_angles() {
  return {180, 0, empty_histogram(dihedral_edges())};
}

void add_dihedral_angles(const std::array<Point3, 4>& tetrahedron, Quality::Dihedral& dihedral) {
  for (const double angle : dihedral_angles(tetrahedron)) {
    dihedral.min = std::min(dihedral.min, angle);
    dihedral.max = std::max(dihedral.max, angle);
    count(dihedral.histogram, angle);
  }
}

void add(const Quality::Dihedral& some, Quality::Dihedral& all) {
  all.min = std::min(all.min, some.min);
  all.max = std::max(all.max, some.max);
  for (std::size_t i = 0; i < all.histogram.counts.size(); ++i) all.histogram.counts[i] += some.histogram.counts[i];
}

std::array<double, 6> squared_edges(const std::array<Point3, 4>& t) {
  return {squared_length(t[1] - t[0]), squared_length(t[2] - t[0]), squared_length(t[3] - t[0]),
          squared_length(t[2] - t[1]), squared_length(t[3] - t[1]), squared_length(t[3] - t[2])};
}

}  // namespace

double shape_measure(const std::array<Point3, 4>& t) {
  double sum = 0;
  for (const double squared : squared_edges(t)) sum += squared;
  const double v = std::abs(volume(t));
  return v > 0 ? std::pow(sum / 6, 1.5) / (regular_factor * v) : std::numeric_limits<double>::infinity();
}

std::array<double, 6> dihedral_angles(const std::array<Point3, 4>& t) {
  constexpr std::array<std::array<std::size_t, 4>, 6> edges = {
      {{0, 1, 2, 3}, {0, 2, 1, 3}, {0, 3, 1, 2}, {1, 2, 0, 3}, {1, 3, 0, 2}, {2, 3, 0, 1}}};
  std::array<double, 6> angles{};
  for (std::size_t e = 0; e < 6; ++e) {
    const auto [a, b, c, d] = edges[e];
    const Point3 axis = t[b] - t[a];
    const Point3 n1 = cross(axis, t[c] - t[a]), n2 = cross(axis, t[d] - t[a]);
    // The arctangent is accurate at flat and at sharp angles, where the arccosine loses half of the digits.
    angles[e] = degrees * std::atan2(std::sqrt(squared_length(cross(n1, n2))), dot(n1, n2));
  }
  return angles;
}

double aspect_ratio(const std::array<Point3, 4>& t) {
  double twice_area = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const Point3 &a = t[(i + 1) % 4], &b = t[(i + 2) % 4], &c = t[(i + 3) % 4];
    twice_area += length(cross(b - a, c - a));
  }
  const double inradius = 6 * std::abs(volume(t)) / twice_area;
  return inradius > 0 ? std::sqrt(std::ranges::max(squared_edges(t)) / 24) / inradius
                      : std::numeric_limits<double>::infinity();
}

double radius_edge_ratio(const std::array<Point3, 4>& t) {
  const Point3 a = t[1] - t[0], b = t[2] - t[0], c = t[3] - t[0];
  const double v = std::abs(volume(t));
  if (!(v > 0)) return std::numeric_limits<double>::infinity();
  // From t[0] to the center: (|a|^2 b x c + |b|^2 c x a + |c|^2 a x b) / (12 V).
  const Point3 sum =
      squared_length(a) * cross(b, c) + squared_length(b) * cross(c, a) + squared_length(c) * cross(a, b);
  return length(sum) / (12 * v) / std::sqrt(std::ranges::min(squared_edges(t)));
}

Quality measure_quality(const mesh::TetMesh& mesh) {
  constexpr std::size_t chunk_length = 8192;
  const std::size_t size = mesh.tetrahedra.size();
  std::vector<double> volumes(size), r(size), aspect(size), radius_edge(size);
  const auto dihedral_of_chunks = parallel_chunks(size, chunk_length, [&](std::size_t begin, std::size_t end) {
    Quality::Dihedral dihedral = no_angles();
    for (std::size_t i = begin; i < end; ++i) {
      std::array<Point3, 4> t;
      for (std::size_t k = 0; k < 4; ++k) t[k] = mesh.vertices[mesh.tetrahedra[i][k]];
      volumes[i] = volume(t);
      r[i] = shape_measure(t);
      aspect[i] = aspect_ratio(t);
      radius_edge[i] = radius_edge_ratio(t);
      add_dihedral_angles(t, dihedral);
    }
    return dihedral;
  });
  Quality quality;
  quality.dihedral_degrees = no_angles();
  if (size == 0) quality.dihedral_degrees.min = 0;
  for (const Quality::Dihedral& dihedral : dihedral_of_chunks) add(dihedral, quality.dihedral_degrees);
  // In the order of the mesh, so that the rounding does not depend on the threads.
  quality.volume = std::accumulate(volumes.begin(), volumes.end(), 0.0);
  const std::array<std::span<const double>, 3> values = {r, aspect, radius_edge};
  const std::array<const std::vector<double>*, 3> edges = {&r_edges, &r_edges, &radius_edge_edges};
  const std::array<Quality::Measure*, 3> measures = {&quality.r, &quality.aspect_ratio, &quality.radius_edge_ratio};
  parallel_for(measures.size(), 1, [&](std::size_t i) { *measures[i] = measure_of(values[i], *edges[i]); });
  return quality;
}

}  // namespace ccdt::bench
