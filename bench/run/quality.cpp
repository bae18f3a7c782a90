#include "bench/run/quality.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <span>
#include <utility>

#include "bench/run/statistics.h"
#include "engine/base/box.h"
#include "engine/base/parallel.h"
#include "engine/base/raw_vector.h"
#include "engine/geometry/tetrahedron_shape.h"

namespace ccdt::bench {
namespace {

/// Growing steps for r and the aspect ratio: nearly all tetrahedra are near 1, and the bad ones are spread over
/// decades.
using MeasureEdges = std::array<double, 15>;
constexpr MeasureEdges r_edges = {1, 1.1, 1.2, 1.3, 1.4, 1.5, 1.75, 2, 2.5, 3, 4, 5, 10, 100, 1000};

/// From the value of the regular tetrahedron, which is the minimum; with TetGen's usual bounds 1.2, 1.414 and 2.
constexpr MeasureEdges radius_edge_edges = {0.6, 0.65, 0.7, 0.75, 0.8, 0.9, 1, 1.2, 1.414, 2, 3, 5, 10, 100, 1000};

constexpr int dihedral_step = 5;  ///< degrees
constexpr std::size_t dihedral_bins = 180 / dihedral_step;

/// Counts turns in bins of equal angles.
class DihedralBins {
 public:
  DihedralBins() {
    for (std::size_t bin = 0; bin < upper_.size(); ++bin) {
      const double angle = static_cast<double>(bin + 1) * dihedral_step / degrees;
      upper_[bin] = bin + 1 < dihedral_bins ? turn_of(std::sin(angle), std::cos(angle)) : 3;
    }
    for (std::size_t cell = 0, bin = 0; cell < first_.size(); ++cell) {
      while (upper_[bin] <= static_cast<double>(cell) / cells_per_turn) ++bin;
      first_[cell] = bin;
    }
  }

  std::size_t bin_of(double turn) const {
    const std::size_t bin = first_[static_cast<std::size_t>(turn * cells_per_turn)];
    return bin + (turn >= upper_[bin] ? 1 : 0);
  }

 private:
  /// A bin is at least 0.043 turns wide, so a cell meets at most two of them.
  static constexpr double cells_per_turn = 32;

  std::array<double, dihedral_bins> upper_;                                          ///< where each bin ends
  std::array<std::size_t, 2 * static_cast<std::size_t>(cells_per_turn) + 1> first_;  ///< the first bin in each cell
};

Histogram empty_histogram(std::vector<double> edges) {
  const std::size_t bins = edges.size() - 1;
  return {std::move(edges), std::vector<std::uint64_t>(bins, 0)};
}

std::vector<double> dihedral_edges() {
  std::vector<double> edges;
  for (int angle = 0; angle <= 180; angle += dihedral_step) edges.push_back(angle);
  return edges;
}

Histogram histogram_of(std::span<const double> values, const MeasureEdges& edges) {
  Histogram histogram = empty_histogram({edges.begin(), edges.end()});
  for (const double value : values) {
    // Compared with all inner edges at the same time: faster than a search, whose branches cannot be predicted.
    std::size_t bin = 0;
    for (std::size_t i = 1; i + 1 < edges.size(); ++i) bin += value >= edges[i] ? 1 : 0;
    ++histogram.counts[bin];
  }
  return histogram;
}

/// Changes the order of the values.
Quality::Measure measure_of(std::span<double> values, const MeasureEdges& edges) {
  Quality::Measure measure;
  measure.histogram = histogram_of(values, edges);
  if (values.empty()) return measure;
  measure.min = std::ranges::min(values);
  measure.mean = std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
  measure.max = std::ranges::max(values);
  measure.p99 = quantile_in_place(values, 0.99);
  measure.median = quantile_in_place(values, 0.5);
  return measure;
}

/// The angles of some tetrahedra.
struct DihedralTurns {
  double min = 2, max = 0;
  std::array<std::uint64_t, dihedral_bins> counts = {};

  void add(const TetrahedronShape& shape, const DihedralBins& bins) {
    for (const double turn : dihedral_turns(shape)) {
      min = std::min(min, turn);
      max = std::max(max, turn);
      ++counts[bins.bin_of(turn)];
    }
  }
};

Quality::Dihedral dihedral_of(std::span<const DihedralTurns> parts) {
  Quality::Dihedral dihedral;
  dihedral.histogram = empty_histogram(dihedral_edges());
  if (parts.empty()) return dihedral;
  dihedral.min = angle_of_turn(std::ranges::min(parts, {}, &DihedralTurns::min).min);
  dihedral.max = angle_of_turn(std::ranges::max(parts, {}, &DihedralTurns::max).max);
  for (const DihedralTurns& part : parts)
    for (std::size_t bin = 0; bin < dihedral_bins; ++bin) dihedral.histogram.counts[bin] += part.counts[bin];
  return dihedral;
}

}  // namespace

Quality measure_quality(const mesh::TetMesh& mesh) {
  constexpr std::size_t chunk_length = 8192;
  const std::size_t size = mesh.tetrahedra.size();
  const DihedralBins bins;
  // A power of two changes no digit, and products of lengths neither overflow nor vanish.
  const double extent = largest_extent(mesh.vertices);
  const int exponent = extent > 0 ? std::ilogb(extent) : 0;
  const double scale = std::ldexp(1, -exponent);
  RawVector<double> volumes(size), r(size), aspect(size), radius_edge(size);
  const auto turns_of_chunks = parallel_chunks(size, chunk_length, [&](std::size_t begin, std::size_t end) {
    DihedralTurns turns;
    for (std::size_t i = begin; i < end; ++i) {
      std::array<Point3, 4> t;
      for (std::size_t k = 0; k < 4; ++k) t[k] = scale * mesh.vertices[mesh.tetrahedra[i][k]];
      const TetrahedronShape shape(t);
      volumes[i] = shape.six_volumes / 6;
      r[i] = shape_measure(shape);
      aspect[i] = aspect_ratio(shape);
      radius_edge[i] = radius_edge_ratio(shape);
      turns.add(shape, bins);
    }
    return turns;
  });
  Quality quality;
  quality.dihedral_degrees = dihedral_of(turns_of_chunks);
  // In the order of the mesh, so that the rounding does not depend on the threads.
  quality.volume = std::ldexp(std::accumulate(volumes.begin(), volumes.end(), 0.0), 3 * exponent);
  const std::array<std::span<double>, 3> values = {r, aspect, radius_edge};
  const std::array<const MeasureEdges*, 3> edges = {&r_edges, &r_edges, &radius_edge_edges};
  const std::array<Quality::Measure*, 3> measures = {&quality.r, &quality.aspect_ratio, &quality.radius_edge_ratio};
  parallel_for(measures.size(), 1, [&](std::size_t i) { *measures[i] = measure_of(values[i], *edges[i]); });
  return quality;
}

}  // namespace ccdt::bench
