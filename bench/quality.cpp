#include "bench/quality.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

#include "bench/statistics.h"

namespace ccdt {
namespace {

constexpr double regular_factor = 8.485281374238570;  ///< 6 sqrt(2): makes the regular tetrahedron's r equal to 1
constexpr double degrees = 180 / std::numbers::pi;

/// Steps of r that grow, as nearly all tetrahedra are near 1 and the bad ones are spread over decades.
const std::vector<double> r_edges = {1, 1.1, 1.2, 1.3, 1.4, 1.5, 1.75, 2, 2.5, 3, 4, 5, 10, 100, 1000};

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

void summarize(std::span<const double> r, Quality::Shape& shape) {
  shape.min = quantile(r, 0);
  shape.median = median(r);
  shape.p99 = quantile(r, 0.99);
  shape.max = quantile(r, 1);
  double sum = 0;
  for (const double value : r) sum += value;
  shape.mean = sum / static_cast<double>(r.size());
}

}  // namespace

double shape_measure(const std::array<Point3, 4>& t) {
  double sum = 0;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = i + 1; j < 4; ++j) sum += squared_length(t[j] - t[i]);
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

Quality measure_quality(const TetMesh& mesh) {
  Quality quality;
  quality.r.histogram = empty_histogram(r_edges);
  quality.dihedral_degrees.histogram = empty_histogram(dihedral_edges());
  if (mesh.tetrahedra.empty()) return quality;

  std::vector<double> r;
  r.reserve(mesh.tetrahedra.size());
  quality.dihedral_degrees.min = 180;
  for (const auto& corners : mesh.tetrahedra) {
    std::array<Point3, 4> t;
    for (std::size_t i = 0; i < 4; ++i) t[i] = mesh.vertices[corners[i]];
    quality.volume += volume(t);
    r.push_back(shape_measure(t));
    count(quality.r.histogram, r.back());
    for (const double angle : dihedral_angles(t)) {
      quality.dihedral_degrees.min = std::min(quality.dihedral_degrees.min, angle);
      quality.dihedral_degrees.max = std::max(quality.dihedral_degrees.max, angle);
      count(quality.dihedral_degrees.histogram, angle);
    }
  }
  summarize(r, quality.r);
  return quality;
}

}  // namespace ccdt
