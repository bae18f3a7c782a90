#include "engine/lattice/target_sizes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "engine/base/parallel.h"
#include "engine/base/raw_vector.h"

namespace ccdt::lattice {
namespace {

using sizes::BackgroundSizes, sizes::SizedPlace;

constexpr std::size_t sample_grain = 4096;  ///< of loops on several threads

struct Mean {
  double sum = 0, count = 0;
  void add(double x) { sum += x, ++count; }
  double value() const { return sum / count; }
};

struct Weighted {
  double size, weight;
};

/// How many points need each size, up to a factor: as many as a tetrahedron needs, or one per vertex.
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

TargetSizes sizes_of_surface(const DomainSurface& surface, double edge_length, double grading,
                             std::span<const SizedPlace> wanted, double surface_factor) {
  const std::size_t triangles = surface.triangles.size();
  RawVector<SizedPlace> samples;
  samples.reserve(triangles + surface.vertices.size());
  samples.resize(triangles);
  const auto sample_at = [](const Point3& p, double size) { return SizedPlace{box_of(p), size}; };
  RawVector<std::array<double, 3>> lengths(triangles);
  parallel_for(triangles, sample_grain, [&](std::size_t t) {
    const auto [a, b, c] = surface.corners(static_cast<std::uint32_t>(t));
    lengths[t] = {surface_factor * length(b - a), surface_factor * length(c - b), surface_factor * length(a - c)};
    const double mean = (lengths[t][0] + lengths[t][1] + lengths[t][2]) / 3;
    samples[t] = sample_at((1.0 / 3) * (a + b + c), mean);
  });
  // The sums are rounded, so they are always made in the same order.
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
  for (const auto& [a, b] : surface.subsegments)
    add_edge(a, b, surface_factor * length(surface.vertices[b] - surface.vertices[a]));
  const double reference = edge_length > 0 || everywhere.count == 0 ? edge_length : everywhere.value();
  const double largest = edge_length > 0 || grading == 0 ? reference : HUGE_VAL;
  if (grading <= 0) return {{largest, grading, wanted}, reference};
  const auto is_used = [](const Mean& mean) { return mean.count > 0; };
  parallel_pack(
      at_vertex.size(), sample_grain,
      [&](std::size_t v, std::size_t end) {
        return static_cast<std::size_t>(std::count_if(&at_vertex[v], at_vertex.data() + end, is_used));
      },
      [&](std::size_t size) { samples.resize(triangles + size); },
      [&](std::size_t v, std::size_t end, std::size_t place) {
        for (; v < end; ++v)
          if (is_used(at_vertex[v]))
            samples[triangles + place++] = sample_at(surface.vertices[v], at_vertex[v].value());
      });
  const std::size_t of_surface = samples.size();
  samples.resize(of_surface + wanted.size());
  std::ranges::copy(wanted, samples.begin() + static_cast<std::ptrdiff_t>(of_surface));
  return {{largest, grading, samples}, reference};
}

}  // namespace

TargetSizes target_sizes(const DomainSurface& surface, double edge_length, double grading,
                         const sizes::WantedSizes* wanted, double surface_factor) {
  if (wanted == nullptr) return sizes_of_surface(surface, edge_length, grading, {}, surface_factor);
  if (wanted->background.empty())
    return sizes_of_surface(surface, edge_length, grading, wanted->places, surface_factor);
  const double largest = edge_length > 0 ? edge_length : HUGE_VAL;
  return {{largest, grading, wanted->places, &wanted->background}, median(weigh_sizes(wanted->background, largest))};
}

}  // namespace ccdt::lattice
