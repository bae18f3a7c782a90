#include "engine/refine/surface_sizes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "engine/base/count_work.h"
#include "engine/base/morton.h"

namespace ccdt::refine {
namespace {

/// A node with no more places than this is not split.
constexpr std::uint32_t most_in_leaf = 32;

/// A node smaller than this times the size there is not split either: its children would have nearly the same places.
constexpr double least_side = 0.5;

/// Thin places are found for up to this times the allowed tetrahedra, because their number is only an estimate then.
constexpr double excess_of_estimate = 4;

std::vector<SizedPoint> in_morton_order(const std::vector<SizedPoint>& places) {
  std::vector<Point3> points;
  points.reserve(places.size());
  for (const SizedPoint& place : places) points.push_back(place.point);
  std::vector<SizedPoint> sorted;
  sorted.reserve(places.size());
  for (const std::uint32_t i : morton_order(points)) sorted.push_back(places[i]);
  return sorted;
}

}  // namespace

SurfaceSizes::SurfaceSizes(const plc::Plc& plc, const RefineOptions& options)
    : largest_(options.edge_length),
      grading_(options.grading),
      box_(bounding_box(plc.vertices)),
      found_(find_thin_places(plc, options.edge_length, excess_of_estimate * options.most_tetrahedra)) {
  limit_from_below(0);
}

void SurfaceSizes::limit_from_below(double least) {
  least_ = least;
  places_ = found_;
  for (SizedPoint& place : places_) place.size = std::max(place.size, least);
  places_ = in_morton_order(thinned(places_));
  const std::array<double, 3> extent = as_array(box_.high - box_.low);
  Node root{box_.low, *std::ranges::max_element(extent)};
  listed_.resize(places_.size());
  std::iota(listed_.begin(), listed_.end(), 0u);
  root.is_listed = true;
  root.count = static_cast<std::uint32_t>(places_.size());
  nodes_.assign(1, root);
}

double SurfaceSizes::least_for(double share) const {
  // In a plane, edges of length l instead of s leave (s / l)^2 of the vertices.
  const auto left = [&](double least) {
    double sum = 0;
    for (const SizedPoint& place : found_) sum += std::min(1.0, place.size * place.size / (least * least));
    return sum;
  };
  const double most = share * left(least_);
  double low = least_, least = largest_;
  for (int i = 0; i < 20; ++i) {
    const double middle = 0.5 * (low + least);
    (left(middle) > most ? low : least) = middle;
  }
  return least;
}

double SurfaceSizes::at(const Point3& p) {
  std::uint32_t n = 0;
  while (has_children(n)) {
    const double half = 0.5 * nodes_[n].side;
    const Point3 offset = p - nodes_[n].low;
    const std::uint32_t parent = n;
    ++work_done.box_tree_nodes;
    n = nodes_[n].first_child + (offset.x >= half ? 1u : 0u) + (offset.y >= half ? 2u : 0u) +
        (offset.z >= half ? 4u : 0u);
    if (!nodes_[n].is_listed) list(parent, n);
  }
  ++work_done.box_tree_nodes;
  double least = largest_;
  for (std::uint32_t i = 0; i < nodes_[n].count; ++i) {
    const SizedPoint& place = places_[listed_[nodes_[n].first + i]];
    // The square root is taken only if it matters.
    const double rest = least - place.size, squared = grading_ * grading_ * squared_length(place.point - p);
    if (rest > 0 && squared < rest * rest) least = place.size + grading_ * std::sqrt(squared_length(place.point - p));
  }
  return least;
}

bool SurfaceSizes::has_children(std::uint32_t node) {
  const Node parent = nodes_[node];
  if (parent.first_child != 0) return true;
  if (parent.count <= most_in_leaf || parent.side < least_side * parent.least) return false;
  nodes_[node].first_child = static_cast<std::uint32_t>(nodes_.size());
  const double half = 0.5 * parent.side;
  for (unsigned c = 0; c < 8; ++c)
    nodes_.push_back({parent.low + Point3{c & 1 ? half : 0, c & 2 ? half : 0, c & 4 ? half : 0}, half});
  return true;
}

/// A place that decides anywhere in the child is, at the center, at most 2 * grading * reach above the least one.
void SurfaceSizes::list(std::uint32_t parent, std::uint32_t child) {
  const Node from = nodes_[parent];
  Node& to = nodes_[child];
  const double half = 0.5 * to.side, reach = std::sqrt(3.0) * half;
  const Point3 center = to.low + Point3{half, half, half};
  at_center_.resize(from.count);
  double least = largest_;
  for (std::uint32_t i = 0; i < from.count; ++i) {
    const SizedPoint& place = places_[listed_[from.first + i]];
    at_center_[i] = place.size + grading_ * length(place.point - center);
    least = std::min(least, at_center_[i]);
  }
  to.is_listed = true;
  to.first = static_cast<std::uint32_t>(listed_.size());
  to.least = largest_;
  for (std::uint32_t i = 0; i < from.count; ++i) {
    if (at_center_[i] > least + 2 * grading_ * reach) continue;
    const std::uint32_t number = listed_[from.first + i];
    listed_.push_back(number);
    to.least = std::min(to.least, places_[number].size);
  }
  to.count = static_cast<std::uint32_t>(listed_.size()) - to.first;
}

}  // namespace ccdt::refine
