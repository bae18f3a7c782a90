#include "engine/lattice/size_field.h"

#include <algorithm>
#include <cmath>

namespace ccdt {

namespace {

struct Mean {
  double sum = 0, count = 0;
  void add(double x) { sum += x, ++count; }
  double value() const { return sum / count; }
};

struct Weighted {
  double size, weight;
};

/// How many points ask for each size, up to a factor: those of a tetrahedron, or one a vertex.
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
  std::ranges::sort(sizes, {}, &Weighted::size);
  double rest = 0;
  for (const Weighted& s : sizes) rest += s.weight / 2;
  for (const Weighted& s : sizes) {
    rest -= s.weight;
    if (rest <= 0) return s.size;
  }
  return sizes.back().size;
}

}  // namespace

SizeField::SizeField(const Surface& surface, double edge_length, double grading, const BackgroundSizes* background)
    : grading_(grading) {
  if (background != nullptr && !background->empty()) {
    sample(*background, edge_length);
  } else {
    sample(surface, edge_length);
  }
}

void SizeField::sample(const Surface& surface, double edge_length) {
  std::vector<SizeTree::Item> samples;
  samples.reserve(surface.triangles.size() + surface.vertices.size());
  const auto add_sample = [&](const Point3& p, double size) { samples.push_back({{p, p}, size, 0}); };
  std::vector<Mean> at_vertex(surface.vertices.size());
  Mean everywhere;
  const auto add_edge = [&](VertexId a, VertexId b) {
    const double length = std::sqrt(squared_length(surface.vertices[b] - surface.vertices[a]));
    at_vertex[a].add(length);
    at_vertex[b].add(length);
    everywhere.add(length);
    return length;
  };
  for (std::uint32_t t = 0; t < surface.triangles.size(); ++t) {
    const auto& v = surface.triangles[t].vertices;
    const double mean = (add_edge(v[0], v[1]) + add_edge(v[1], v[2]) + add_edge(v[2], v[0])) / 3;
    const Corners corners = surface.corners(t);
    add_sample((1.0 / 3) * (corners[0] + corners[1] + corners[2]), mean);
  }
  for (const auto& s : surface.subsegments) add_edge(s[0], s[1]);
  for (std::size_t v = 0; v < at_vertex.size(); ++v) {
    if (at_vertex[v].count > 0) add_sample(surface.vertices[v], at_vertex[v].value());
  }
  reference_ = edge_length > 0 || everywhere.count == 0 ? edge_length : everywhere.value();
  largest_ = edge_length > 0 || grading_ == 0 ? reference_ : HUGE_VAL;
  if (grading_ > 0) samples_ = SizeTree(samples);
}

void SizeField::sample(const BackgroundSizes& background, double edge_length) {
  largest_ = edge_length > 0 ? edge_length : HUGE_VAL;
  reference_ = median(weigh_sizes(background, largest_));
  if (!background.tetrahedra.empty()) {
    largest_ = std::min(largest_, std::ranges::max(background.sizes));
    interpolated_.emplace(background);
    return;
  }
  std::vector<SizeTree::Item> samples;
  for (std::size_t v = 0; v < background.vertices.size(); ++v)
    samples.push_back({{background.vertices[v], background.vertices[v]}, background.sizes[v], 0});
  samples_ = SizeTree(samples);
}

bool SizeField::is_below(const Box& box, double bound) const {
  if (largest_ < bound) return true;
  if (interpolated_) return interpolated_->is_below(box, bound);
  const auto reach = [&](const Box& place, double size) {
    return size + grading_ * std::sqrt(squared_distance(place, box));
  };
  return samples_.any(bound, reach, [](const SizeTree::Item&) { return true; });
}

}  // namespace ccdt
