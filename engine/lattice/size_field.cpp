#include "engine/lattice/size_field.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ccdt {

namespace {

struct Mean {
  double sum = 0, count = 0;
  void add(double x) { sum += x, ++count; }
  double value() const { return sum / count; }
};

/// Where half of the samples [begin, end) go to the first child: the same rule must hold for boxes and queries.
std::size_t middle(std::size_t begin, std::size_t end) {
  return begin + (end - begin) / 2;
}

}  // namespace

SizeField::SizeField(const Surface& surface, double edge_length, double grading) : grading_(grading) {
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
    samples_.push_back({(1.0 / 3) * (corners[0] + corners[1] + corners[2]), mean});
  }
  for (const auto& s : surface.subsegments) add_edge(s[0], s[1]);
  for (std::size_t v = 0; v < at_vertex.size(); ++v) {
    if (at_vertex[v].count > 0) samples_.push_back({surface.vertices[v], at_vertex[v].value()});
  }

  reference_ = edge_length > 0 || everywhere.count == 0 ? edge_length : everywhere.value();
  largest_ = edge_length > 0 || grading == 0 ? reference_ : HUGE_VAL;
  if (grading == 0) samples_.clear();
  if (samples_.empty()) return;

  constexpr std::size_t samples_a_leaf = 8;
  std::size_t leaves = 1;
  while (leaves * samples_a_leaf < samples_.size()) leaves *= 2;
  first_leaf_ = leaves - 1;
  groups_.resize(2 * leaves - 1);
  sort_samples(0, samples_.size(), 0);
}

void SizeField::sort_samples(std::size_t begin, std::size_t end, std::size_t group) {
  Box box{samples_[begin].place, samples_[begin].place};
  double shortest = HUGE_VAL;
  for (std::size_t i = begin; i < end; ++i) {
    const Box both = bounding_box(std::array{samples_[i].place, box.low, box.high});
    box = both;
    shortest = std::min(shortest, samples_[i].edge_length);
  }
  groups_[group] = {box, shortest};
  if (group >= first_leaf_) return;
  const auto extent = as_array(box.high - box.low);
  const auto axis = static_cast<std::size_t>(std::ranges::max_element(extent) - extent.begin());
  const std::size_t half = middle(begin, end);
  const auto at = [this](std::size_t i) { return samples_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(begin), at(half), at(end), [axis](const Sample& a, const Sample& b) {
    return as_array(a.place)[axis] < as_array(b.place)[axis];
  });
  sort_samples(begin, half, 2 * group + 1);
  sort_samples(half, end, 2 * group + 2);
}

/// A lower bound of the edge length that the samples of a group allow in the box.
double SizeField::reach(std::size_t group, const Box& box) const {
  return groups_[group].shortest + grading_ * std::sqrt(squared_distance(groups_[group].box, box));
}

bool SizeField::is_below(const Box& box, double bound) const {
  if (largest_ < bound) return true;
  if (samples_.empty() || reach(0, box) >= bound) return false;
  struct Visit {
    std::size_t group, begin, end;
  };
  std::array<Visit, 64> stack;  // two a level of the tree at most
  std::size_t height = 0;
  stack[height++] = {0, 0, samples_.size()};
  while (height > 0) {
    const auto [group, begin, end] = stack[--height];
    if (group >= first_leaf_) {
      for (std::size_t i = begin; i < end; ++i) {
        const double here = std::sqrt(squared_distance(box, samples_[i].place));
        if (samples_[i].edge_length + grading_ * here < bound) return true;
      }
      continue;
    }
    Visit near{2 * group + 1, begin, middle(begin, end)}, far{2 * group + 2, middle(begin, end), end};
    double near_reach = reach(near.group, box), far_reach = reach(far.group, box);
    if (far_reach < near_reach) std::swap(near, far), std::swap(near_reach, far_reach);
    if (far_reach < bound) stack[height++] = far;
    if (near_reach < bound) stack[height++] = near;
  }
  return false;
}

}  // namespace ccdt
